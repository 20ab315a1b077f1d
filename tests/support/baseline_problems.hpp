// Retrievals that every planner should solve, and one that none can.
#pragma once

#include <map>
#include <string>

#include "support/push_problem.hpp"
#include "support/retrieve_problem.hpp"

#include "mamo/verify/verifier.hpp"

namespace mamo::fixtures {

/// The target in the open, two cans far from its way out.
inline Problem nobody_in_the_way() {
  Scene scene = shelf();
  scene.objects.push_back(standing_cylinder("left", 0.95, -0.2, 0.04, 0.15));
  scene.objects.push_back(standing_cylinder("right", 0.95, -0.8, 0.04, 0.15));
  Problem problem = retrieve_problem(std::move(scene), target_can(), 0.0);
  for (Object& object : problem.scene.objects) constrain(object);
  return problem;
}

/// With this option the pre-grasp of the problem is the only one: what stands before it has to go.
inline const std::map<std::string, std::string> kOneGrasp = {{"grasps", "1"}};

/// A can just before the target, where the gripper comes in along the given pre-grasp, and room on both sides.
inline Problem light_can_in_the_way(double mass = 0.2) {
  Scene scene = shelf();
  Object can = standing_cylinder("can", 0.61, -0.5, 0.035, 0.15);
  can.mass = mass;
  scene.objects.push_back(can);
  Problem problem = retrieve_problem(std::move(scene), target_can(0.75, -0.5), 0.0);
  for (Object& object : problem.scene.objects) constrain(object);
  return problem;
}

/// Two cans before the target, one behind the other, and clutter on both sides.
inline Problem several_in_the_way(std::uint64_t seed) {
  Scene scene = cluttered_shelf(7, 2, seed);
  std::erase_if(scene.objects, [](const Object& o) {
    return !o.fixture() && std::abs(o.X_WO.translation().y() + 0.5) < 0.17 && o.X_WO.translation().x() < 0.85;
  });
  scene.objects.push_back(standing_cylinder("near", 0.54, -0.52, 0.035, 0.15));
  scene.objects.push_back(standing_cylinder("far", 0.63, -0.48, 0.035, 0.15));
  Problem problem = retrieve_problem(std::move(scene), target_can(0.75, -0.5), 0.0);
  for (Object& object : problem.scene.objects) constrain(object);
  return problem;
}

/// light_can_in_the_way(), but whoever moves the can violates its constraints.
inline Problem wedged_can_in_the_way() {
  Problem problem = light_can_in_the_way();
  problem.scene.objects[problem.scene.find("can").index()].constraints.max_displacement = 0.002;
  return problem;
}

/// Refuses the first plan at a segment of the given kind, whatever it does; then as the verifier.
class RefusesTheFirst : public PlanJudge {
 public:
  explicit RefusesTheFirst(SegmentKind kind) : kind_(kind) {}
  Verdict judge(const Problem& problem, const Plan& plan, StopSource& stop) const override {
    Verdict verdict = Verifier().judge(problem, plan, stop);
    if (judged_++ > 0 || !verdict.ok) return verdict;
    verdict.ok = false;
    Verdict::Finding finding;
    while (plan.segments[static_cast<std::size_t>(finding.segment)].kind != kind_) ++finding.segment;
    verdict.findings = {finding};
    verdict.objects_after.resize(static_cast<std::size_t>(finding.segment));
    return verdict;
  }
  int judged() const { return judged_; }

 private:
  const SegmentKind kind_;
  mutable int judged_ = 0;
};

}  // namespace mamo::fixtures
