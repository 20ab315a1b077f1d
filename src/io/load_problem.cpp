// Any problem file: recognised by its content, read, and checked as far as no collision checker is needed.
#include <filesystem>

#include "io/native_problem.hpp"
#include "io/object_reader.hpp"
#include "io/recognise.hpp"
#include "io/scene_checks.hpp"
#include "io/sha256.hpp"
#include "io/shelf_scene.hpp"
#include "io/task_reader.hpp"
#include "io/text.hpp"

#include "mamo/io/load.hpp"
#include "mamo/io/profile.hpp"

namespace mamo::io {
namespace {

constexpr std::size_t kMaxProblemBytes = 16u << 20;

Status check_options(const LoadOptions& options) {
  const auto wrong = [](const std::string& message) { return Error{message, ErrorKind::usage}; };
  if (!options.constraints.empty() && !parse_profile(options.constraints))
    return wrong("the constraints profile is " + in_quotes(options.constraints) +
                 ", expected contact-only, full or legacy");
  if (options.default_mass && !(*options.default_mass >= kMass.least && *options.default_mass <= kMass.most))
    return wrong("--default-mass is " + shortest_number(*options.default_mass) + ", must be " +
                 std::string(kMass.words));
  if (options.default_friction && !(*options.default_friction >= 0 && *options.default_friction <= kFriction.most))
    return wrong("--default-friction is " + shortest_number(*options.default_friction) + ", must be " +
                 std::string(kFriction.words));
  if (!options.task.empty() && options.task != "reach" && options.task != "retrieve")
    return wrong("--task is " + in_quotes(options.task) + ", expected reach or retrieve");
  return {};
}

/// A glob that matches nothing is most likely a slip.
Status check_globs(const LoadOptions& options, const Scene& scene) {
  for (const std::string& glob : options.movable) {
    LoadOptions only_this;
    only_this.movable = {glob};
    bool matches = false;
    for (const Object& o : scene.objects) matches = matches || (!o.fixture() && made_movable(o.id, only_this));
    if (!matches) return Error{"--movable " + in_quotes(glob) + " matches no object of the problem", ErrorKind::usage};
  }
  return {};
}

/// YAML of other programs that a person may well try.
Status refuse_foreign_yaml(const YamlValue& root, const std::string& path) {
  const auto refuse = [&](const std::string& what) { return Error{one_line(path) + ": " + what}; };
  const auto has = [&](const char* key) { return root.find(key) != nullptr; };
  if (!root.is_map())
    return error_at(path, root.line, root.column, "a problem file is a map that starts with 'format: mamo-problem/1'");
  if (has("format")) return {};
  if ((has("world") && (has("robot_state") || has("robot_model_name") || has("fixed_frame_transforms"))) ||
      has("allowed_collision_matrix") || has("collision_objects"))
    return refuse("looks like a MotionBenchMaker scene, which is not supported yet");
  if (has("goal_constraints") || has("start_state"))
    return refuse("looks like a MotionBenchMaker request, which is not supported yet (and goes with its scene)");
  if (has("joint_trajectory") || (has("joint_names") && has("points")))
    return refuse("looks like a JointTrajectory, a problem was expected");
  if (has("problems") && has("planners")) return refuse("looks like a suite for 'mamo bench', a problem was expected");
  return {};
}

}  // namespace

Result<Problem> load_problem(const std::string& path, const LoadOptions& options) {
  if (Status s = check_options(options); !s) return s.error();
  Result<std::string> text = read_file(path, kMaxProblemBytes);
  if (!text) return text.error();
  if (Status s = check_is_text(*text, path); !s) return s.error();

  Problem problem;
  problem.path = path;
  problem.name = std::filesystem::path(path).filename().string();
  problem.sha256 = sha256_hex(*text);
  Complaints complaints(path);
  const bool shelf = looks_like_shelf_scene(*text);
  std::vector<Place> places;
  if (shelf) {
    read_shelf_scene(*text, options, problem, complaints);
  } else {
    if (Status s = refuse_foreign(*text, path); !s) return s.error();
    Result<YamlValue> root = parse_yaml(*text, path);
    if (!root) return root.error();
    if (Status s = refuse_foreign_yaml(*root, path); !s) return s.error();
    read_native_problem(*root, options, problem, complaints);
    if (const YamlValue* objects = root->find("objects"))
      for (const YamlValue& object : objects->items) places.push_back({object.line, object.column});
  }
  if (complaints.any()) return complaints.first();
  if (!options.request.empty())
    return Error{"--request goes with a MotionBenchMaker scene, " + one_line(path) + " is none", ErrorKind::usage};
  if (Status s = check_globs(options, problem.scene); !s) return s.error();
  if (Status s = change_task(options.task, problem); !s) return s.error();
  protect_target(problem);
  // A published scene that is odd is reported and used all the same.
  check_floating(problem.scene, places, /*only_warn=*/shelf, complaints);
  if (complaints.any()) return complaints.first();
  problem.warnings.insert(problem.warnings.end(), complaints.warnings().begin(), complaints.warnings().end());
  return problem;
}

}  // namespace mamo::io
