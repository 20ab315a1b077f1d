// mamo view: a page that plays a plan, or a picture of one moment.
#include "checks.hpp"
#include "exit_codes.hpp"
#include "file_options.hpp"
#include "interrupts.hpp"
#include "output_files.hpp"
#include "session.hpp"

#include "mamo/verify/verifier.hpp"
#include "mamo/view/playback.hpp"

namespace mamo::tool {
namespace {

struct ViewCommand {
  FileOptions files;
  std::string plan, out, image;
  view::ImageOptions picture;
};

/// Everything that is shown; what there is depends on what was given and on how the run went.
struct Shown {
  Problem problem;
  std::optional<PlanResult> result;
  Recording recording;
  std::optional<Verdict> verdict;

  view::Playback playback() const {
    return {&problem, result ? &*result : nullptr, recording.empty() ? nullptr : &recording,
            verdict ? &*verdict : nullptr};
  }
};

Result<Shown> collect(const ViewCommand& command, StopSource& stop, Console& console) {
  Shown shown;
  Result<Problem> problem = load(command.files, console);
  if (!problem.ok()) return problem.error();
  shown.problem = std::move(*problem);
  if (command.plan.empty()) return shown;
  Result<PlanResult> result = io::load_result(command.plan, shown.problem);
  if (!result.ok()) return result.error();
  shown.result = std::move(*result);
  if (!shown.result->plan.empty())
    shown.verdict = Verifier().judge(shown.problem, shown.result->plan, stop, shown.recording);
  return shown;
}

std::string what_is_shown(const Shown& shown) {
  const std::string name = shown.problem.name;
  if (!shown.result) return name + ", without a plan";
  if (shown.result->plan.empty()) return name + ", no plan: " + one_line(shown.result->reason);
  const std::string length = format(", %.1f s", shown.recording.duration_s());
  if (shown.verdict->ok) return name + length + ", holds";
  return name + length + ", does not hold: " + one_line(shown.verdict->findings.front().text);
}

int run(const ViewCommand& command, Console& console) {
  if (command.out.empty() && command.image.empty())
    return fail(console, {"say --out FILE.html for a page or --image FILE.png for a picture", ErrorKind::usage});
  if (const Status status = check_outputs({command.out, command.image}, {command.files.problem, command.plan});
      !status.ok())
    return fail(console, status.error());
  StopSource stop;
  const SignalGuard signals(stop);
  const Result<Shown> shown = collect(command, stop, console);
  if (!shown.ok()) return fail(console, shown.error());
  if (shown->verdict && shown->verdict->stopped) {
    console.error("mamo: interrupted, nothing written");
    return kNoPlan;
  }
  const auto write = [&](const std::string& path, const Result<std::string>& content) -> Status {
    if (!content.ok()) return content.error();
    return io::write_file(path, *content);
  };
  if (!command.out.empty())
    if (const Status status = write(command.out, view::playback_page(shown->playback())); !status.ok())
      return fail(console, status.error());
  if (!command.image.empty())
    if (const Status status = write(command.image, view::playback_image(shown->playback(), command.picture));
        !status.ok())
      return fail(console, status.error());
  std::printf("%s\n", what_is_shown(*shown).c_str());
  for (const std::string& path : {command.out, command.image})
    if (!path.empty()) std::printf("  %-12s %s\n", "written", path.c_str());
  return kSolved;
}

}  // namespace

void add_view(CLI::App& app, Session& session) {
  CLI::App* sub = app.add_subcommand("view", "A page that plays a plan in three dimensions, or a picture of it");
  auto command = std::make_shared<ViewCommand>();
  add_problem(*sub, command->files);
  sub->add_option("PLAN", command->plan, "Result object of `mamo plan`, of a failed run too, or a bare plan")
      ->check(file_name());
  sub->add_option("--out", command->out, "Write a self-contained page")->type_name("FILE.html")->check(file_name());
  sub->add_option("--image", command->image, "Write a picture")->type_name("FILE.png")->check(file_name());
  view::ImageOptions& picture = command->picture;
  sub->add_option("--at", picture.time_s, "Time of the picture (s)")->check(number_at_least(0))->capture_default_str();
  sub->add_option("--width", picture.width, "Of the picture (px)")
      ->check(whole_number(16, 8192))
      ->capture_default_str();
  sub->add_option("--height", picture.height, "Of the picture (px)")
      ->check(whole_number(16, 8192))
      ->capture_default_str();
  sub->add_option("--turn", picture.yaw_deg, "Turn the camera of the picture about the vertical (degrees)");
  sub->add_option("--raise", picture.pitch_deg, "Raise the camera of the picture (degrees)");
  sub->add_option("--zoom", picture.zoom, "Of the picture")->check(number_above(0))->capture_default_str();
  sub->add_flag("--dark", picture.dark, "A dark picture (pages follow the system)");
  add_console_options(*sub, session);
  sub->footer(
      "The plan is verified again, and the replay is what is shown.\n"
      "Example:\n  mamo view problem.yaml plan.json --out plan.html\n"
      "  mamo view problem.yaml plan.json --image plan.png --at 4.5");
  sub->callback([command, &session] { session.run = [command, &session] { return run(*command, session.console); }; });
}

}  // namespace mamo::tool
