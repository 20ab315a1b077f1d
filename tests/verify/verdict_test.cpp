// Changed numbers are found where they are; the same plan gets the same verdict, bit for bit; a stop is obeyed.
#include <atomic>
#include <thread>

#include "support/table_world.hpp"
#include "support/verdicts.hpp"

namespace mamo {
namespace {

using namespace fixtures;

/// Three pushes of one can, with the poses that the replay saw written into the plan.
class ThreePushes : public testing::Test {
 protected:
  ThreePushes() {
    problem.scene.objects.push_back(can_at("can", -0.3));
    problem.scene.objects.push_back(can_at("bystander", 0.5));
    plan = sweep(problem, {-0.2, 0.0, 0.2});
    const Verdict verdict = judge(problem, plan);
    EXPECT_TRUE(holds(verdict));
    for (std::size_t s = 0; s < plan.segments.size(); ++s) plan.segments[s].objects_after = verdict.objects_after[s];
  }
  Problem problem = table_problem(0.2);
  Plan plan;
  const ObjectId can{1}, bystander{2};
};

TEST_F(ThreePushes, HoldWithThePosesTheReplaySaw) { EXPECT_TRUE(holds(judge(problem, plan, {0.004, 1e-9}))); }

TEST_F(ThreePushes, AMovedPredictionIsFoundInItsSegment) {
  for (int s = 0; s < 3; ++s) {
    for (const ObjectId id : {can, bystander}) {
      Plan changed = plan;
      changed.segments[static_cast<std::size_t>(s)].objects_after[id].translation().y() += 0.025;
      const Verdict verdict = judge(problem, changed);
      ASSERT_TRUE(rejects(verdict, ViolationKind::objects_mismatch, s));
      EXPECT_EQ(verdict.findings.size(), 1u);
      EXPECT_EQ(verdict.findings[0].violation.object, id);
      EXPECT_NEAR(verdict.findings[0].violation.value, 0.025, 1e-6);
      EXPECT_DOUBLE_EQ(verdict.findings[0].violation.limit, 0.02);
    }
  }
}

TEST_F(ThreePushes, ATurnedPredictionIsFound) {
  plan.segments[1].objects_after[bystander].rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::objects_mismatch, 1));
}

TEST_F(ThreePushes, SegmentsThatPredictNothingAreNotCompared) {
  for (Segment& segment : plan.segments) segment.objects_after.clear();
  EXPECT_TRUE(holds(judge(problem, plan)));
}

TEST_F(ThreePushes, AChangedPointIsAJumpOrAMissedGoal) {
  Plan changed = plan;
  changed.segments[1].motion.q[1][0] += 0.001;
  EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::joint_velocity, 1));
  changed = plan;
  changed.segments[1].motion.q[1][0] -= 0.001;  // slower: the jump shows where the next segment begins
  EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::discontinuity, 2));
  changed = plan;
  changed.segments[2].motion.q[1][0] -= 0.02;
  EXPECT_TRUE(rejects(judge(problem, changed), ViolationKind::task_not_done, 2));
}

TEST_F(ThreePushes, ASwappedSegmentIsAJump) {
  std::swap(plan.segments[1], plan.segments[2]);
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::discontinuity, 1));
}

TEST_F(ThreePushes, ADroppedSegmentIsAJump) {
  plan.segments.erase(plan.segments.begin() + 1);
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::discontinuity, 1));
}

TEST_F(ThreePushes, AnObjectInAnotherPlaceIsAMismatch) {
  problem.scene.objects[bystander.index()].X_WO = can_at("bystander", 0.45).X_WO;
  EXPECT_TRUE(rejects(judge(problem, plan), ViolationKind::objects_mismatch, 0));
}

TEST_F(ThreePushes, TheSameVerdictEveryTimeWhateverWasJudgedBefore) {
  const auto bits = [](const Verdict& verdict) {
    std::vector<double> all;
    for (const Interaction& i : verdict.interactions) all.push_back(i.first_time_s);
    for (const auto& poses : verdict.objects_after)
      for (const auto& [id, X] : poses) all.insert(all.end(), X.data(), X.data() + 16);
    return all;
  };
  const Verifier verifier;
  StopSource stop;
  const Verdict first = verifier.judge(problem, plan, stop);
  Problem other = problem;
  other.scene.objects.push_back(can_at("wall", -0.1, ObjectKind::immovable));
  EXPECT_FALSE(verifier.judge(other, plan, stop).ok);
  const Verdict second = verifier.judge(problem, plan, stop);
  EXPECT_EQ(bits(first), bits(second));
  EXPECT_EQ(report(first), report(second));
}

TEST_F(ThreePushes, OneVerifierServesTwoThreads) {
  const Verifier verifier;
  std::vector<Verdict> verdicts(2);
  std::vector<std::jthread> threads;
  for (Verdict& verdict : verdicts)
    threads.emplace_back([&] {
      StopSource stop;
      verdict = verifier.judge(problem, plan, stop);
    });
  threads.clear();
  EXPECT_TRUE(holds(verdicts[0]));
  EXPECT_EQ(verdicts[0].objects_after[2].at(can).matrix(), verdicts[1].objects_after[2].at(can).matrix());
}

TEST_F(ThreePushes, AStopGivesNoVerdict) {
  StopSource stop;
  stop.request(StopReason::interrupted);
  const Verdict verdict = Verifier().judge(problem, plan, stop);
  EXPECT_TRUE(verdict.stopped);
  EXPECT_FALSE(verdict.ok);
  EXPECT_TRUE(verdict.findings.empty());
}

TEST_F(ThreePushes, AStopInTheMiddleEndsAtOnce) {
  // Longer than any test may take: an hour's wait, judged step by step.
  plan.segments[0].motion.t.back() += 36000;
  plan.segments[0].objects_after.clear();
  StopSource stop(0.2);
  const Verdict verdict = Verifier().judge(problem, plan, stop);
  EXPECT_TRUE(verdict.stopped);
}

TEST_F(ThreePushes, AFindingIsOneLineWithSegmentObjectConstraintValueLimitAndTime) {
  plan.segments[1].object = can;
  plan.segments[1].kind = SegmentKind::push;
  problem.scene.objects[can.index()].constraints.max_displacement = 0.24;
  const Verdict verdict = judge(problem, plan);
  ASSERT_TRUE(rejects(verdict, ViolationKind::displacement, 1));
  const std::string& text = verdict.findings[0].text;
  EXPECT_THAT(text, testing::StartsWith("segment 1 (push of can), "));
  EXPECT_THAT(text, testing::ContainsRegex("[0-9]+\\.[0-9]{3} s: displacement of can, 0\\.24[0-9]* m, limit 0\\.24 m"));
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace mamo
