#include "summary.hpp"

#include "mamo/common/hash.hpp"
#include "mamo/io/result_json.hpp"

namespace mamo::tool {
namespace {

std::string line(const char* name, const std::string& text) { return format("  %-12s %s\n", name, text.c_str()); }

std::string headline(const PlanResult& result, const Problem& problem, const Console& console) {
  const bool solved = result.status == PlanStatus::solved;
  std::string status(to_string(result.status));
  if (result.status == PlanStatus::proven) status = "proven: no plan exists";
  if (!solved && result.status != PlanStatus::proven) status = "no plan (" + status + ")";
  return console.coloured(status, solved) + ": " + task_name(problem) + " in " + problem.name + " with " +
         result.planner + "\n";
}

std::string relevant_objects(const PlanStats& stats, const Scene& scene) {
  std::string text;
  for (ObjectId id : stats.relevant_objects) text += (text.empty() ? "" : ", ") + io::object_name(scene, id);
  return text.empty() ? "none" : text;
}

std::string cost_line(const PlanResult& result) {
  std::string text = format("%.3f rad", static_cast<double>(result.cost) / 1000);
  if (result.suboptimality_bound > 0)
    text += format(", at most %g x the cheapest path of this lattice", result.suboptimality_bound);
  return text;
}

std::string failures(const PlanStats& stats) {
  std::string text;
  for (const auto& [cause, count] : stats.failures)
    if (count > 0) text += format("%s%s %lld", text.empty() ? "" : ", ", cause.c_str(), static_cast<long long>(count));
  return text;
}

/// Planners that search rearrangements count other things than those that search a lattice of motions.
bool rearranges(const PlanResult& result, const Problem& problem) {
  return std::holds_alternative<Retrieve>(problem.task) && result.stats.planning_iterations == 0;
}

std::string rearrangement_effort(const PlanStats& stats) {
  const auto whole = [](std::int64_t n) { return static_cast<long long>(n); };
  return line("time", format("%.2f s (loading %.2f, search %.2f, verification %.2f)", stats.wall_s, stats.load_s,
                             stats.search_s, stats.verification_s)) +
         line("search", format("%lld expansions, %lld pushes tried, %lld of them simulated, %lld known from before",
                               whole(stats.expansions), whole(stats.push_attempts), whole(stats.simulations_used),
                               whole(stats.cache_hits)));
}

std::string lattice_effort(const PlanStats& stats, const Scene& scene) {
  return line("time", format("%.2f s (loading %.2f, search %.2f, tracking %.2f, verification %.2f)", stats.wall_s,
                             stats.load_s, stats.search_s, stats.tracking_s, stats.verification_s)) +
         line("simulations",
              format("%lld run, %lld used by the search, %lld for tracking", static_cast<long long>(stats.simulations),
                     static_cast<long long>(stats.simulations_used),
                     static_cast<long long>(stats.tracking_simulations))) +
         line("search", format("%lld expansions, %d planning iteration%s", static_cast<long long>(stats.expansions),
                               stats.planning_iterations, stats.planning_iterations == 1 ? "" : "s")) +
         line("relevant", relevant_objects(stats, scene));
}

}  // namespace

std::string task_name(const Problem& problem) {
  if (std::holds_alternative<ReachPose>(problem.task)) return "reach pose";
  if (std::holds_alternative<ReachJoints>(problem.task)) return "reach joints";
  return "retrieve " + io::object_name(problem.scene, std::get<Retrieve>(problem.task).object);
}

std::string why_no_plan(const PlanResult& result, const PlanOptions& options, double time_limit_s,
                        std::int64_t memory_limit_mb) {
  if (result.reason.find("--") != std::string::npos) return result.reason;
  const std::string more = result.reason.empty() ? "" : " (" + result.reason + ")";
  switch (result.status) {
    case PlanStatus::timeout:
      return format("no plan within %g s; --time-limit raises the limit", time_limit_s) + more;
    case PlanStatus::memory:
      return format("more than %lld MB in use; --memory-limit raises the limit",
                    static_cast<long long>(memory_limit_mb)) +
             more;
    case PlanStatus::interrupted:
      return "stopped by a signal" + more;
    case PlanStatus::limit:
      if (result.stats.simulations_used >= options.max_simulations)
        return format("no plan within %lld simulations; --max-simulations raises the limit",
                      static_cast<long long>(options.max_simulations)) +
               more;
      if (result.stats.expansions >= options.max_expansions)
        return format("no plan within %lld expansions; --max-expansions raises the limit",
                      static_cast<long long>(options.max_expansions)) +
               more;
      return result.reason;
    default:
      return result.reason;
  }
}

std::string proven_assumptions() {
  return "  assumptions\n"
         "    - the plan is sought among the paths of this planner's motion lattice (its joint steps, its goal "
         "configurations)\n"
         "    - A1: whatever a set of objects forbids to a motion, every larger set of objects forbids too\n"
         "    - the physics settings of the problem, and the poses of the objects, are exact\n"
         "    - nothing was cut short: no budget ran out and no motion was banned by the replay\n";
}

std::string plan_line(const Plan& plan, const Scene& scene) {
  std::size_t points = 0;
  double duration = 0;
  std::string kinds;
  for (const Segment& segment : plan.segments) {
    points += segment.motion.q.size();
    duration += segment.motion.duration();
    kinds += (kinds.empty() ? "" : ", ") + std::string(to_string(segment.kind));
    if (segment.object.valid()) kinds += " " + io::object_name(scene, segment.object);
  }
  return format("%zu segment%s, %zu points, %.1f s: %s", plan.segments.size(), plan.segments.size() == 1 ? "" : "s",
                points, duration, kinds.c_str());
}

std::string summary(const PlanResult& result, const Problem& problem, const Console& console) {
  const PlanStats& stats = result.stats;
  std::string text = headline(result, problem, console);
  if (!result.reason.empty()) text += line("reason", result.reason);
  if (result.status == PlanStatus::proven) text += proven_assumptions();
  if (!result.plan.empty()) {
    if (result.cost > 0) text += line("cost", cost_line(result));
    text += line("plan", plan_line(result.plan, problem.scene));
  }
  text += rearranges(result, problem) ? rearrangement_effort(stats) : lattice_effort(stats, problem.scene);
  if (!stats.failures.empty() && !failures(stats).empty()) text += line("failures", failures(stats));
  if (result.found) {
    std::string verified = result.verified ? "yes: replayed in full physics with every object" : "no";
    if (result.rejected_by_verification > 0)
      verified += format("; %d plans rejected before", result.rejected_by_verification);
    text += line("verified", verified);
    text += line("contacts", result.second_order_contacts ? "objects touched by pushed objects too"
                                                          : "no object touched by a pushed object");
  }
  text += line("signature", to_hex(result.signature));
  return text;
}

std::string progress_line(const Progress& progress) {
  return format("%6.1f s  expansions %lld  simulations %lld  bound %.2f rad  relevant %d  iteration %d",
                progress.elapsed_s, static_cast<long long>(progress.expansions),
                static_cast<long long>(progress.simulations), progress.best_bound / 1000, progress.relevant_objects,
                progress.planning_iterations);
}

}  // namespace mamo::tool
