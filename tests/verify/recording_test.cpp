// What the replay writes down for people to look at.
#include "support/table_world.hpp"
#include "support/verdicts.hpp"

namespace mamo {
namespace {

using namespace fixtures;

class Recorded : public testing::Test {
 protected:
  Recorded() {
    problem.scene.objects.push_back(can_at("can", -0.2));
    problem.scene.objects.push_back(can_at("far", 0.6));
  }
  Verdict record(const Plan& plan) {
    StopSource stop;
    return Verifier().judge(problem, plan, stop, recording);
  }

  Problem problem = table_problem();
  const ObjectId can{1}, far{2};
  Recording recording;
};

TEST_F(Recorded, TheVerdictIsThatOfAnUnrecordedReplay) {
  const Plan plan = sweep(problem, {-0.3, 0.2});
  const Verdict with = record(plan), without = judge(problem, plan);
  ASSERT_TRUE(holds(with));
  EXPECT_EQ(with.interactions, without.interactions);
  for (const auto& [id, X_WO] : without.objects_after.back())
    EXPECT_EQ(with.objects_after.back().at(id).matrix(), X_WO.matrix());
}

TEST_F(Recorded, SamplesRunFromTheStartToRestAndEndWhereTheObjectsEnded) {
  const Plan plan = sweep(problem, {0.2});
  const Verdict verdict = record(plan);
  ASSERT_FALSE(recording.empty());
  EXPECT_EQ(recording.t.front(), 0);
  EXPECT_GE(recording.duration_s(), plan.segments[0].motion.duration());
  EXPECT_EQ(recording.q.size(), recording.t.size());
  EXPECT_EQ(recording.q.front(), problem.q_start);
  EXPECT_LT((recording.q.back() - over_table(0.2)).norm(), 1e-9);
  for (std::size_t k = 1; k < recording.t.size(); ++k) {
    EXPECT_GT(recording.t[k], recording.t[k - 1]);
    EXPECT_LT(recording.t[k] - recording.t[k - 1], kRecordingStep + 1e-9);
  }
  const Recording::Track& track = recording.tracks.at(can);
  ASSERT_EQ(track.X_WO.size(), recording.t.size());
  EXPECT_EQ(track.X_WO.back().matrix(), verdict.objects_after.back().at(can).matrix());
}

TEST_F(Recorded, WhatNeverMovesHasNoTrack) {
  record(sweep(problem, {0.2}));
  EXPECT_TRUE(recording.tracks.contains(can));
  EXPECT_FALSE(recording.tracks.contains(far));
}

TEST_F(Recorded, ContactsHaveATimeAndAPlaceBetweenTheTwo) {
  const Verdict verdict = record(sweep(problem, {0.2}));
  ASSERT_FALSE(recording.contacts.empty());
  const Recording::Contact& first = recording.contacts.front();
  EXPECT_EQ(first.a, kRobot);
  EXPECT_EQ(first.b, can);
  EXPECT_EQ(first.begin_s, verdict.interactions.front().first_time_s);
  EXPECT_GT(first.end_s, first.begin_s);
  // On the can's side, within the fingers' height.
  const Eigen::Vector3d from_axis = first.p_W - problem.scene[can].X_WO.translation();
  EXPECT_NEAR(from_axis.head<2>().norm(), 0.035, 0.004);
  EXPECT_LT(std::abs(from_axis.z()), 0.06);
}

TEST_F(Recorded, APlanThatFailsIsRecordedUpToTheFailure) {
  problem.scene.objects[1].constraints.max_displacement = 0.05;
  const Verdict verdict = record(sweep(problem, {0.2}));
  ASSERT_FALSE(verdict.ok);
  EXPECT_NEAR(recording.duration_s(), verdict.findings.front().violation.time_s, 1e-9);
  const Recording::Track& track = recording.tracks.at(can);
  EXPECT_GT(*std::max_element(track.speed.begin(), track.speed.end()), 0.01);
}

TEST_F(Recorded, AMalformedPlanLeavesNothing) {
  record(sweep(problem, {0.2}));
  Plan plan = sweep(problem, {0.2});
  plan.segments[0].joint_names[0] = "nobody";
  EXPECT_FALSE(record(plan).ok);
  EXPECT_TRUE(recording.empty());
}

}  // namespace
}  // namespace mamo
