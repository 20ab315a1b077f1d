// Selective simulation end to end, on problems that ship and on problems made to have a known answer.
#include "support/reach_problem.hpp"

#include "mamo/io/load.hpp"
#include "mamo/planners/registry.hpp"
#include "mamo/verify/verifier.hpp"

namespace mamo {
namespace {

struct Query {
  explicit Query(const Problem& problem, const std::string& planner = "selsim", PlanOptions options = {},
                 bool with_judge = true) {
    StopSource stop(60);
    PlanContext context;
    context.stop = &stop;
    context.judge = with_judge ? &judge : nullptr;
    result = make_planner(planner)->plan(problem, options, context);
  }
  Verifier judge;
  PlanResult result;
};

Problem shipped(const std::string& name) {
  auto problem = io::load_problem(std::string(MAMO_SOURCE_DIR) + "/bench/data/problems/" + name);
  if (!problem) throw std::runtime_error(problem.error().message);
  choose_self_pairs(problem->robot, problem->robot_files.disabled, !problem->robot_files.srdf.empty(), 1);
  return *problem;
}

TEST(SelectiveSimulation, SolvesAndVerifiesTheShippedProblems) {
  for (const char* name : {"demo.yaml", "cupboard.yaml", "tabletop_1.yaml", "tabletop_3.yaml", "tabletop_16.yaml"}) {
    const Problem problem = shipped(name);
    const PlanResult r = Query(problem).result;
    ASSERT_EQ(r.status, PlanStatus::solved) << name << ": " << r.reason;
    EXPECT_TRUE(r.found && r.verified) << name;
    StopSource stop;
    EXPECT_TRUE(Verifier().judge(problem, r.plan, stop).ok) << name;
  }
}

TEST(SelectiveSimulation, TheDemoNeedsRelevantObjectsAndPushesThem) {
  const Problem problem = shipped("demo.yaml");
  const PlanResult r = Query(problem).result;
  EXPECT_GE(r.stats.planning_iterations, 2);
  EXPECT_FALSE(r.stats.relevant_objects.empty());
  double moved = 0;
  for (const auto& [id, X] : r.plan.segments.back().objects_after)
    moved = std::max(moved, (X.translation() - problem.scene[id].X_WO.translation()).norm());
  EXPECT_GT(moved, 0.02);
}

TEST(SelectiveSimulation, TheSignatureRepeatsAfterAHundredOtherPlans) {
  const Problem problem = shipped("demo.yaml");
  const PlanResult first = Query(problem).result;
  const Problem others[2] = {shipped("cupboard.yaml"), shipped("tabletop_1.yaml")};
  for (int k = 0; k < 100; ++k) {
    PlanOptions options;
    options.seed = static_cast<std::uint64_t>(k);
    options.max_simulations = 20;
    options.max_expansions = 20;
    Query(others[k % 2], "selsim", options, false);
  }
  const PlanResult again = Query(problem).result;
  EXPECT_EQ(first.signature, again.signature);
  EXPECT_EQ(first.stats.expansions, again.stats.expansions);
  EXPECT_EQ(first.stats.simulations_used, again.stats.simulations_used);
  EXPECT_EQ(first.stats.failures, again.stats.failures);
  PlanOptions other;
  other.seed = 2;
  EXPECT_NE(Query(problem, "selsim", other).result.signature, first.signature);
}

TEST(SelectiveSimulation, ThreadsSchedulesAndBatchesDoNotShowInTheResult) {
  for (const char* name : {"demo.yaml", "cupboard.yaml", "tabletop_3.yaml"}) {
    const Problem problem = shipped(name);
    for (const char* planner : {"selsim", "selsim-wastar"}) {
      const PlanResult serial = Query(problem, planner).result;
      for (int threads : {1, 2, 3, 8})
        for (const char* schedule : {"runahead", "window", "batch"})
          for (int batch : {0, 1, 4, 16}) {
            if (batch > 0 && threads != 3) continue;
            PlanOptions options;
            options.threads = threads;
            options.schedule = schedule;
            options.batch = batch;
            const PlanResult r = Query(problem, planner, options).result;
            ASSERT_EQ(r.signature, serial.signature)
                << name << " " << planner << " " << threads << " " << schedule << " " << batch;
            ASSERT_EQ(r.stats.simulations_used, serial.stats.simulations_used);
            ASSERT_EQ(r.stats.expansions, serial.stats.expansions);
            ASSERT_EQ(r.stats.collision_checks, serial.stats.collision_checks);
            ASSERT_EQ(r.stats.failures, serial.stats.failures);
          }
    }
  }
}

TEST(SelectiveSimulation, AllFourVariantsSolveTheCupboardAndVerify) {
  const Problem problem = shipped("cupboard.yaml");
  for (const char* name : {"selsim", "selsim-wastar", "fullsim", "fullsim-wastar"}) {
    const PlanResult r = Query(problem, name).result;
    EXPECT_EQ(r.status, PlanStatus::solved) << name << ": " << r.reason;
    EXPECT_EQ(r.planner, name);
  }
}

TEST(SelectiveSimulation, DiscoveredImmovablesBecomeRelevant) {
  PlanOptions options;
  options.set = {{"immovables", "discovered"}};
  const Problem problem = shipped("cupboard.yaml");
  const PlanResult r = Query(problem, "selsim", options).result;
  EXPECT_EQ(r.status, PlanStatus::solved) << r.reason;
}

// A start that is boxed in on all sides: every edge out of it hits the box.
TEST(SelectiveSimulation, ABoxedInStartIsProvenToHaveNoPlan) {
  Problem problem = fixtures::reach_problem(0, 0, 1);
  ReachJoints task;
  task.q = problem.q_start;
  task.q[3] += 1.0;
  problem.task = task;
  const ForwardKinematics kinematics(problem.robot);
  const Eigen::Isometry3d X_WT = kinematics.link_pose(problem.q_start, problem.robot.model->find_link("palm"));
  // Plates around the hand in its own frame, 5 to 10 mm away; the palm is too wide for the gap that the wrist fills.
  const struct {
    Eigen::Vector3d centre, size;
  } plates[] = {{{0.187, 0, 0}, {0.01, 0.14, 0.08}},     {{0.11, 0.061, 0}, {0.15, 0.01, 0.08}},
                {{0.11, -0.061, 0}, {0.15, 0.01, 0.08}}, {{0.11, 0, 0.036}, {0.15, 0.13, 0.01}},
                {{0.11, 0, -0.036}, {0.15, 0.13, 0.01}}, {{0.017, 0.065, 0}, {0.01, 0.04, 0.08}},
                {{0.017, -0.065, 0}, {0.01, 0.04, 0.08}}};
  for (const auto& plate : plates) {
    problem.scene.objects.push_back(
        fixtures::fixture_box("plate" + std::to_string(problem.scene.size()), {0, 0, 0}, plate.size, Touch::forbidden));
    problem.scene.objects.back().X_WO = X_WT * Eigen::Translation3d(plate.centre);
  }
  PlanOptions options;
  options.max_expansions = 50000;
  const PlanResult doubtful = Query(problem, "selsim", options).result;
  EXPECT_EQ(doubtful.status, PlanStatus::limit) << "the chains' budget was used up";
  EXPECT_NE(doubtful.reason.find("chain_nodes"), std::string::npos) << doubtful.reason;
  options.set = {{"chains", "0"}};
  const PlanResult r = Query(problem, "selsim", options).result;
  EXPECT_EQ(r.status, PlanStatus::proven) << r.reason << " after " << r.stats.expansions << " expansions";
  EXPECT_EQ(exit_code(r.status), 2);
}

TEST(SelectiveSimulation, TheCostIsTheLengthOfThePlanThatIsReturned) {
  const Problem problem = shipped("demo.yaml");
  for (const bool smooth : {true, false}) {
    PlanOptions options;
    options.smooth = smooth;
    const PlanResult r = Query(problem, "selsim", options).result;
    ASSERT_EQ(r.status, PlanStatus::solved);
    double length = 0;
    const std::vector<Eigen::VectorXd>& q = r.plan.segments.front().motion.q;
    for (std::size_t k = 1; k < q.size(); ++k) length += (q[k] - q[k - 1]).norm();
    EXPECT_NEAR(static_cast<double>(r.cost), 1000 * length, 1.0) << smooth;
  }
}

/// A goal in joint space makes the heuristic good enough for weight 1, whose plan costs the least.
TEST(SelectiveSimulation, PlansCostAtMostTheirBoundTimesTheCheapest) {
  int compared = 0;
  for (int index = 0; index < 8; ++index) {
    Problem problem = fixtures::reach_problem(4, 1, static_cast<std::uint64_t>(index) + 1);
    const auto& pose = std::get<ReachPose>(problem.task);
    const ForwardKinematics kinematics(problem.robot);
    const auto q = InverseKinematics(kinematics).solve(pose.X_WT, problem.q_start, 1, {});
    if (!q) continue;
    ReachJoints task;
    task.q = *q;
    problem.task = task;
    PlanOptions options;
    options.smooth = false;
    options.max_expansions = 300;
    options.set = {{"long_step_deg", "30"}, {"short_distance", "0"}, {"tip_step", "0"}, {"exact_objects", "true"}};
    options.weight = 1;
    const PlanResult cheapest = Query(problem, "fullsim", options).result;
    if (cheapest.status != PlanStatus::solved) continue;
    for (const double weight : {1.0, 2.0, 10.0, 100.0}) {
      options.weight = weight;
      const PlanResult r = Query(problem, "selsim", options).result;
      if (r.status != PlanStatus::solved) continue;
      ++compared;
      EXPECT_LE(static_cast<double>(r.cost), r.suboptimality_bound * static_cast<double>(cheapest.cost))
          << "seed " << index + 1 << " weight " << weight;
      EXPECT_LE(r.suboptimality_bound, weight);
    }
  }
  EXPECT_GE(compared, 8);
}

TEST(SelectiveSimulation, LimitsEndTheSearchAndNameTheirOption) {
  const Problem problem = shipped("demo.yaml");
  PlanOptions options;
  options.max_simulations = 1;
  const PlanResult r = Query(problem, "selsim", options).result;
  EXPECT_EQ(r.status, PlanStatus::limit);
  EXPECT_NE(r.reason.find("--max-simulations"), std::string::npos);
  EXPECT_TRUE(r.plan.empty());
}

TEST(SelectiveSimulation, APlanNeverUsesMoreSimulationsThanItsBudget) {
  const Problem problem = shipped("demo.yaml");
  const std::int64_t needed = Query(problem).result.stats.simulations_used;
  for (std::int64_t budget = 1; budget <= needed; ++budget) {
    PlanOptions options;
    options.max_simulations = budget;
    const PlanResult r = Query(problem, "selsim", options).result;
    EXPECT_EQ(r.status, budget < needed ? PlanStatus::limit : PlanStatus::solved) << budget << " of " << needed;
  }
}

TEST(SelectiveSimulation, UnknownOptionsAreMisuseNamedWithTheNearest) {
  const Problem problem = shipped("demo.yaml");
  PlanOptions options;
  options.set = {{"snap", "3"}};
  try {
    Query query(problem, "selsim", options);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("snaps"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace mamo
