#include "mamo/experiments/refrigerator.hpp"

#include <algorithm>

#include "experiments/footprint.hpp"
#include "experiments/retrieve_task.hpp"
#include "experiments/shelf_room.hpp"
#include "experiments/shipped_robot.hpp"

#include "mamo/common/random.hpp"
#include "mamo/experiments/difficulty.hpp"
#include "mamo/experiments/household.hpp"
#include "mamo/io/profile.hpp"
#include "mamo/planners/validate.hpp"

namespace mamo {
namespace {

// Seen from above (m):
//
//      y -0.20 +--------------------+
//              |       mustard      |
//              | coffee     soup    |     floor at z = 0.77
//   robot      | meat               |
//              |          sugar     |
//        -0.80 +--------------------+
//            0.48                 0.93 x
constexpr Compartment kCompartment{{0.48, 0.93}, {-0.80, -0.20}, 0.77, 0.32};
struct Place {
  const char* item;
  double x, y, yaw;
};
constexpr Place kPlaces[] = {{"tomato_soup_can", 0.72, -0.44, 0},
                             {"master_chef_can", 0.60, -0.43, 0},
                             {"potted_meat_can", 0.58, -0.55, 0.3},
                             {"mustard_bottle", 0.70, -0.29, 0.2},
                             {"sugar_box", 0.78, -0.64, 0.5}};
constexpr double kShift = 0.03, kTurn = 0.4, kShare = 0.1;  // m, rad, of mass and friction; to each side
constexpr double kGap = 0.004;                              // m
constexpr int kDraws = 200;
constexpr std::uint64_t kStreamKey = 0x667269646765;  // "fridge"

/// One perturbation; false when two objects would overlap or one would touch a wall.
bool draw(const RefrigeratorSpec& spec, int attempt, Problem& problem) {
  problem.scene.objects = shelf_fixtures(kCompartment, spec.profile);
  const std::size_t fixtures = problem.scene.size();
  std::vector<Footprint> taken;
  RandomStream random(spec.seed,
                      {kStreamKey, static_cast<std::uint64_t>(spec.index), static_cast<std::uint64_t>(attempt)});
  for (const Place& place : kPlaces) {
    const auto items = household_items();
    const HouseholdItem& item =
        *std::find_if(items.begin(), items.end(), [&](const HouseholdItem& i) { return i.name == place.item; });
    const double x = place.x + random.uniform(-kShift, kShift), y = place.y + random.uniform(-kShift, kShift);
    const double yaw = place.yaw + random.uniform(-kTurn, kTurn);
    Object o;
    o.id = place.item;
    o.kind = taken.empty() ? ObjectKind::immovable : ObjectKind::movable;
    o.shapes = {{item.shape, Eigen::Isometry3d::Identity()}};
    o.X_WO.translation() = Eigen::Vector3d(x, y, kCompartment.floor + height(item.shape) / 2);
    o.X_WO.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    o.mass = item.mass * random.uniform(1 - kShare, 1 + kShare);
    o.friction = item.friction * random.uniform(1 - kShare, 1 + kShare);
    o.constraints = io::default_constraints(spec.profile, o.kind);
    taken.push_back(footprint(item.shape, x, y, yaw));
    for (std::size_t k = 0; k + 1 < taken.size(); ++k)
      if (closer_than(taken[k], taken.back(), kGap)) return false;
    for (const Eigen::Vector2d& p : taken.back())
      if (p.x() < kCompartment.x[0] || p.x() > kCompartment.x[1] - kGap || p.y() < kCompartment.y[0] + kGap ||
          p.y() > kCompartment.y[1] - kGap)
        return false;
    problem.scene.objects.push_back(std::move(o));
  }
  problem.task = retrieve_task(problem, ObjectId(fixtures), 0);
  return validate(problem).ok();
}

}  // namespace

Result<Problem> generate_refrigerator(const RefrigeratorSpec& spec) {
  if (spec.index < 0) return Error{"refrigerator: the index is negative", ErrorKind::usage};
  Problem problem;
  problem.name = "refrigerator-" + std::to_string(spec.seed) + "-" + std::to_string(spec.index) + ".yaml";
  problem.path = problem.name;
  problem.profile = spec.profile;
  if (Status s = install_shipped_pr2(problem, "r_gripper_finger_dummy_planning_link"); !s) return s.error();
  for (int attempt = 0; attempt < kDraws; ++attempt) {
    if (!draw(spec, attempt, problem)) continue;
    const std::optional<VoxelVolume> region = retrieval_region(problem);
    const int in_the_way = region ? movables_in(*region, problem) : 0;
    if (in_the_way == 0) continue;
    problem.generated = {{"generator", "refrigerator"},
                         {"seed", std::to_string(spec.seed)},
                         {"index", std::to_string(spec.index)},
                         {"difficulty", std::string(to_string(difficulty_of(in_the_way)))},
                         {"movables_in_the_way", std::to_string(in_the_way)},
                         {"scene_redraws", std::to_string(attempt)}};
    return problem;
  }
  return Error{"refrigerator: nothing to fetch in " + std::to_string(kDraws) + " perturbations", ErrorKind::internal};
}

}  // namespace mamo
