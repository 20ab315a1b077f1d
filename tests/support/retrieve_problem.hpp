// Retrieve something from the published shelf, built in code: the PR2-like arm, its home, a pre-grasp as the published
// scenes choose it.
//
//      y    -0.1 +-------------+ left wall, back at x = 1.1
//                |             |
//   robot at     |      o      |  the object of interest stands at (0.72, -0.5); the arm comes in
//   the origin   |    o   o    |  along a yaw that a test chooses
//           -0.9 +-------------+
#pragma once

#include "support/fixtures.hpp"
#include "support/table_world.hpp"

#include "mamo/retrieval/retrieval_planner.hpp"

namespace mamo::fixtures {

/// `ahead` m in front of the object's centre along `yaw`, at the height of its centre.
inline Eigen::Isometry3d pregrasp_of(const Object& object, double yaw, double ahead) {
  const Eigen::Vector3d c = object.X_WO.translation();
  return at(c.x() - ahead * std::cos(yaw), c.y() - ahead * std::sin(yaw), c.z(), yaw);
}

/// The scene's objects and one more, "target", to be brought home. What stood in its place is gone.
inline Problem retrieve_problem(Scene scene, const Object& target, double yaw = 0.5) {
  Problem problem;
  problem.name = "retrieve";
  problem.robot = pr2_like_arm();
  problem.q_start = problem.robot.posture;
  problem.scene = std::move(scene);
  std::erase_if(problem.scene.objects, [&](const Object& o) {
    return !o.fixture() && (o.X_WO.translation() - target.X_WO.translation()).head<2>().norm() < 0.092;
  });
  problem.scene.objects.push_back(target);
  problem.profile = Profile::full;
  Retrieve task;
  task.object = problem.scene.find(target.id);
  task.X_WT_pregrasp = pregrasp_of(target, yaw, 0.04 + 0.045);
  task.home = problem.q_start;
  problem.task = task;
  return problem;
}

inline Object target_can(double x = 0.72, double y = -0.5) {
  return standing_cylinder("target", x, y, 0.04, 0.16, ObjectKind::immovable);
}

/// Movable cans in a ring about the target, so close that no gripper comes between.
inline Scene walled_in(const Object& target) {
  Scene scene = shelf();
  for (int k = 0; k < 7; ++k) {
    const double angle = 2 * std::numbers::pi * k / 7;
    scene.objects.push_back(standing_cylinder("wall_" + std::to_string(k),
                                              target.X_WO.translation().x() + 0.095 * std::cos(angle),
                                              target.X_WO.translation().y() + 0.095 * std::sin(angle), 0.04, 0.2));
  }
  return scene;
}

/// The planner of a problem with all that it needs.
struct RetrievalSetup {
  explicit RetrievalSetup(Problem problem_in, const RetrievalOptions& options = {}, std::uint64_t seed = 1)
      : problem(std::move(problem_in)),
        kinematics(std::make_shared<const ForwardKinematics>(problem.robot)),
        checker(kinematics, problem.scene),
        state(WorldState::start_of(problem.scene)),
        movables(ObjectSet::of_kind(problem.scene, ObjectKind::movable)),
        planner(problem, kinematics, options, seed, checker) {}

  RetrievalOutcome plan(const ObjectSet& obstacles, int first = 0) {
    return planner.plan(checker, state, obstacles, first, nullptr);
  }
  const GraspCandidate& grasp_of(const RetrievalPath& path) const {
    return planner.candidates()[static_cast<std::size_t>(path.grasp)];
  }

  Problem problem;
  std::shared_ptr<const ForwardKinematics> kinematics;
  CollisionChecker checker;
  WorldState state;
  ObjectSet movables, nothing;
  RetrievalPlanner planner;
};

/// The path as a plan: approach, grasp, extract.
inline Plan plan_of(const Problem& problem, const RetrievalPath& path) {
  Plan plan;
  plan.segments = {motion(problem, path.approach, SegmentKind::approach),
                   motion(problem, path.reach, SegmentKind::grasp),
                   motion(problem, path.extract, SegmentKind::extract)};
  for (Segment& segment : plan.segments) segment.object = std::get<Retrieve>(problem.task).object;
  return plan;
}

/// The same problem without its movable objects; the target stays.
inline Problem without_movables(Problem problem) {
  Retrieve& task = std::get<Retrieve>(problem.task);
  const std::string target = problem.scene[task.object].id;
  std::vector<Object>& objects = problem.scene.objects;
  std::erase_if(objects, [&](const Object& o) { return o.movable() && o.id != target; });
  task.object = problem.scene.find(target);
  return problem;
}

}  // namespace mamo::fixtures
