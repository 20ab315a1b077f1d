#include "mamo/experiments/difficulty.hpp"

#include <memory>

#include "mamo/collision/collision_checker.hpp"
#include "mamo/model/world_state.hpp"
#include "mamo/retrieval/retrieval_planner.hpp"

namespace mamo {
namespace {

constexpr std::uint64_t kSeed = 1;  // of the retrieval's searches

}  // namespace

std::string_view to_string(Difficulty difficulty) {
  switch (difficulty) {
    case Difficulty::none:
      return "none";
    case Difficulty::easy:
      return "easy";
    case Difficulty::medium:
      return "medium";
    case Difficulty::hard:
      return "hard";
  }
  return "unknown";
}

std::optional<Difficulty> parse_difficulty(std::string_view name) {
  for (Difficulty d : {Difficulty::none, Difficulty::easy, Difficulty::medium, Difficulty::hard})
    if (to_string(d) == name) return d;
  return std::nullopt;
}

Difficulty difficulty_of(int movables_in_the_way) {
  if (movables_in_the_way <= 0) return Difficulty::none;
  return movables_in_the_way == 1 ? Difficulty::easy : movables_in_the_way == 2 ? Difficulty::medium : Difficulty::hard;
}

std::optional<VoxelVolume> retrieval_region(const Problem& problem) {
  const RetrievalOptions options;
  const auto kinematics = std::make_shared<ForwardKinematics>(problem.robot);
  CollisionChecker checker(kinematics, problem.scene);
  const RetrievalPlanner planner(problem, kinematics, options, kSeed, checker);
  if (planner.candidates().empty()) return std::nullopt;
  const WorldState start = WorldState::start_of(problem.scene);
  StopSource stop;
  const RetrievalOutcome outcome = planner.plan(checker, start, ObjectSet(problem.scene.size()), 0, &stop);
  if (!outcome.path) return std::nullopt;
  return swept_volume(problem, *kinematics, *outcome.path,
                      planner.candidates()[static_cast<std::size_t>(outcome.path->grasp)], start,
                      object_space(problem.scene), options.cell);
}

int movables_in(const VoxelVolume& region, const Problem& problem) {
  const auto* retrieve = std::get_if<Retrieve>(&problem.task);
  int count = 0;
  for (ObjectId id : ObjectSet::of_kind(problem.scene, ObjectKind::movable).ids())
    if (!retrieve || retrieve->object != id)
      count += region.overlap(problem.scene[id], problem.scene[id].X_WO).common_cells > 0;
  return count;
}

std::optional<Difficulty> difficulty(const Problem& problem) {
  if (!std::holds_alternative<Retrieve>(problem.task)) return std::nullopt;
  if (const auto noted = problem.generated.find("difficulty"); noted != problem.generated.end())
    if (const auto parsed = parse_difficulty(noted->second)) return parsed;
  const std::optional<VoxelVolume> region = retrieval_region(problem);
  if (!region) return std::nullopt;
  return difficulty_of(movables_in(*region, problem));
}

}  // namespace mamo
