// Plans written by mamo read back as they were.
#include <gmock/gmock.h>

#include "mamo/io/load.hpp"
#include "mamo/io/result_json.hpp"
#include "support/sample_problem.hpp"
#include "support/scratch_folder.hpp"

namespace mamo {
namespace {

class PlanReader : public ::testing::Test {
 protected:
  void expect_reads_back(const std::string& json) {
    const test::ScratchFolder folder;
    const Result<Plan> loaded = io::load_plan(folder.write("plan.json", json), problem);
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->segments.size(), plan.segments.size());
    for (std::size_t i = 0; i < plan.segments.size(); ++i) {
      const Segment &a = plan.segments[i], &b = loaded->segments[i];
      EXPECT_EQ(a.kind, b.kind);
      EXPECT_EQ(a.object, b.object);
      EXPECT_EQ(a.joint_names, b.joint_names);
      EXPECT_EQ(a.motion.t, b.motion.t) << "to the bit";
      EXPECT_EQ(a.motion.q, b.motion.q) << "to the bit";
      ASSERT_EQ(a.objects_after.size(), b.objects_after.size());
      for (const auto& [id, X] : a.objects_after) {
        ASSERT_TRUE(b.objects_after.count(id));
        EXPECT_EQ(X.translation(), b.objects_after.at(id).translation());
        EXPECT_TRUE(X.linear().isApprox(b.objects_after.at(id).linear(), 1e-15));
      }
    }
  }
  Problem problem = fixtures::sample_problem();
  Plan plan = fixtures::sample_plan(problem);
};

TEST_F(PlanReader, ABarePlanReadsBackExactly) { expect_reads_back(io::plan_json(plan, problem.scene)); }

TEST_F(PlanReader, AResultReadsBackExactlyIndentedOrNot) {
  PlanResult result;
  result.status = PlanStatus::solved;
  result.plan = plan;
  expect_reads_back(io::result_json(result, problem));
  expect_reads_back(io::result_json(result, problem, 2));
}

TEST_F(PlanReader, ManyRandomNumbersSurvive) {
  RandomStream random(7, {0x706c616e});
  for (Segment& segment : plan.segments)
    for (Eigen::VectorXd& q : segment.motion.q)
      for (double& v : q) v = random.normal() * std::pow(10.0, random.uniform(-12, 6));
  expect_reads_back(io::plan_json(plan, problem.scene));
}

TEST_F(PlanReader, WhatOnlyVerificationCanJudgeIsRead) {
  plan.segments[0].motion.t = {0.5, 0.2, 0.1};  // backwards in time, and not from 0
  plan.segments[1].joint_names[0] = "no_such_joint";
  expect_reads_back(io::plan_json(plan, problem.scene));
}

}  // namespace
}  // namespace mamo
