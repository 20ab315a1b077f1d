#include "mamo/lattice/edge_evaluator.hpp"

#include "support/reach_problem.hpp"

namespace mamo {
namespace {

using fixtures::LatticeKit;

// Motions that sweep the gripper through the shelf at the height of the objects.
struct Sweep {
  Eigen::VectorXd q0, q1;
};
std::vector<Sweep> sweeps(const Problem& problem, std::uint64_t seed, int count) {
  const ForwardKinematics kinematics(problem.robot);
  const InverseKinematics ik(kinematics);
  RandomStream random(seed, {0x737770});
  std::vector<Sweep> out;
  while (static_cast<int>(out.size()) < count) {
    const double yaw = random.uniform(-0.5, 0.5);
    const Eigen::Isometry3d A =
        fixtures::at(random.uniform(0.5, 0.75), random.uniform(-0.7, -0.3), random.uniform(0.82, 0.9), yaw);
    Eigen::Isometry3d B = A;
    B.translation() += Eigen::Vector3d(random.uniform(-0.1, 0.2), random.uniform(-0.15, 0.15), 0);
    const auto a = ik.solve(A, problem.q_start, random.next());
    if (!a) continue;
    const auto b = ik.solve(B, *a, random.next());
    if (b && (*b - *a).norm() < 1.0) out.push_back({*a, *b});
  }
  return out;
}

// Theorem 5.1 of the paper: valid with all objects and without second-order interactions => valid with a subset.
TEST(EdgeEvaluator, WhatIsValidWithAllObjectsIsValidInEveryProjection) {
  int simulated = 0, compared = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Problem problem = fixtures::reach_problem(8, 2, seed);
    LatticeKit kit(problem);
    const WorldState start = WorldState::start_of(problem.scene);
    RandomStream random(seed, {3});
    for (const Sweep& s : sweeps(problem, seed, 25)) {
      const EdgeResult full = kit.evaluator.evaluate(s.q0, s.q1, kit.all, start, nullptr, nullptr);
      if (!full.valid || full.second_order) continue;
      simulated += full.simulated;
      ObjectSet subset = ObjectSet::of_kind(problem.scene, ObjectKind::immovable);
      for (ObjectId id : kit.all.relevant.ids())
        if (random.below(2)) subset.insert(id);
      const EdgeResult projected =
          kit.evaluator.evaluate(s.q0, s.q1, make_relevant_bodies(problem, subset), start, nullptr, nullptr);
      ++compared;
      EXPECT_TRUE(projected.valid) << "seed " << seed << " "
                                   << (projected.violation ? to_string(projected.violation->kind) : "");
    }
  }
  RecordProperty("compared", compared);
  EXPECT_GE(simulated, 5);
}

// P_C is a subset of P_E, and an edge that the checker calls free makes no contact in physics.
TEST(EdgeEvaluator, CheckerAndSimulatorAgreeOnNoContact) {
  int missed = 0, free_edges = 0, contacts = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Problem problem = fixtures::reach_problem(10, 0, seed);
    LatticeKit kit(problem);
    const WorldState start = WorldState::start_of(problem.scene);
    Evaluator physics(kit.kinematics, problem.scene);
    const ObjectSet objects = ObjectSet::all(problem.scene);
    for (const Sweep& s : sweeps(problem, 100 + seed, 25)) {
      CollisionReport report;
      kit.evaluator.collision().set_state(start);
      kit.evaluator.collision().check_edge(s.q0, s.q1, ObjectSet(problem.scene.size()), objects, report);
      if (report.self) continue;
      const TimedPath motion = time_path(problem.robot, {s.q0, s.q1}, problem.scene.physics.step);
      EvaluationRequest request;
      request.present = &objects;
      request.from = &start;
      request.motion = &motion;
      const Evaluation e = physics.evaluate(request);
      if (report.touched.empty()) {
        ++free_edges;
        missed += !e.interactions.empty() || !(e.state == start);
      } else {
        contacts += !e.interactions.empty();
      }
    }
  }
  EXPECT_EQ(missed, 0);
  EXPECT_GE(free_edges, 5);
  EXPECT_GE(contacts, 20);
}

TEST(EdgeEvaluator, OutcomesDoNotDependOnThePastOfTheWorker) {
  const Problem problem = fixtures::reach_problem(8, 2, 2);
  LatticeKit kit(problem);
  const WorldState start = WorldState::start_of(problem.scene);
  const auto motions = sweeps(problem, 42, 12);
  std::vector<EdgeResult> fresh;
  for (const Sweep& s : motions) {
    EdgeEvaluator one(problem, kit.kinematics, {});
    fresh.push_back(one.evaluate(s.q0, s.q1, kit.all, start, nullptr, nullptr));
  }
  RandomStream random(1, {4});
  for (int k = 0; k < 60; ++k) {
    const std::size_t i = random.below(motions.size());
    const EdgeResult r = kit.evaluator.evaluate(motions[i].q0, motions[i].q1, kit.all, start, nullptr, nullptr);
    ASSERT_EQ(r.valid, fresh[i].valid);
    ASSERT_EQ(r.state, fresh[i].state);
    ASSERT_EQ(r.interactions, fresh[i].interactions);
  }
}

TEST(EdgeEvaluator, ForbiddenContactIsRefusedWithoutSimulation) {
  Problem problem = fixtures::reach_problem(0, 0, 1);
  problem.scene.objects.push_back(fixtures::standing_cylinder("vase", 0.75, -0.5, 0.05, 0.3, ObjectKind::immovable));
  LatticeKit kit(problem);
  const InverseKinematics ik(*kit.kinematics);
  const auto a = ik.solve(fixtures::at(0.5, -0.5, 0.9), problem.q_start, 1);
  ASSERT_TRUE(a);
  const auto b = ik.solve(fixtures::at(0.75, -0.5, 0.9), *a, 1);
  ASSERT_TRUE(b);
  const EdgeResult r = kit.evaluator.evaluate(*a, *b, kit.all, WorldState::start_of(problem.scene), nullptr, nullptr);
  EXPECT_FALSE(r.valid);
  EXPECT_FALSE(r.simulated);
  ASSERT_TRUE(r.violation);
  EXPECT_EQ(r.violation->kind, ViolationKind::robot_touch);
  EXPECT_EQ(r.violation->object, problem.scene.find("vase"));
}

}  // namespace
}  // namespace mamo
