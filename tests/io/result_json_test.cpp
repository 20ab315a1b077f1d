#include "mamo/io/result_json.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <limits>

#include "support/sample_problem.hpp"

namespace mamo {
namespace {

class ResultJson : public ::testing::Test {
 protected:
  ResultJson() {
    result.status = PlanStatus::solved;
    result.planner = "selsim";
    result.plan = fixtures::sample_plan(problem);
    result.signature = 0xabcull;
    result.cost = 1234567890123;
    result.suboptimality_bound = 10.0 / 3.0;
    result.found = result.verified = true;
    result.stats.relevant_objects = {ObjectId{6}, ObjectId{5}};
    result.stats.failures["robot_touch"] = 3;
    result.stats.search_s = 0.1;
  }
  Problem problem = fixtures::sample_problem();
  PlanResult result;
};

TEST_F(ResultJson, HasEveryKeyOfTheInterfaceInItsOrder) {
  const auto json = nlohmann::ordered_json::parse(io::result_json(result, problem));
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  EXPECT_THAT(keys,
              ::testing::ElementsAre("schema", "status", "exit_code", "reason", "planner", "problem", "problem_sha256",
                                     "version", "seed", "threads", "signature", "cost", "suboptimality_bound", "found",
                                     "verified", "rejected_by_verification", "second_order_contacts", "stats", "plan"));
  keys.clear();
  for (const auto& item : json["stats"].items()) keys.push_back(item.key());
  EXPECT_THAT(keys, ::testing::ElementsAre("wall_s", "found_s", "load_s", "search_s", "tracking_s", "verification_s",
                                           "simulations", "simulations_used", "tracking_simulations", "simulation_s",
                                           "collision_checks", "expansions", "planning_iterations", "relevant_objects",
                                           "mapf_calls", "mapf_s", "push_attempts", "push_planning_s", "cache_hits",
                                           "peak_memory_mb", "failures"));
}

TEST_F(ResultJson, ValuesReadBackExactly) {
  const auto json = nlohmann::json::parse(io::result_json(result, problem));
  EXPECT_EQ(json["schema"], "mamo-result/1");
  EXPECT_EQ(json["status"], "solved");
  EXPECT_EQ(json["exit_code"], 0);
  EXPECT_EQ(json["signature"], "0000000000000abc");
  EXPECT_EQ(json["cost"], 1234567890123);
  EXPECT_EQ(json["suboptimality_bound"].get<double>(), 10.0 / 3.0);
  EXPECT_EQ(json["stats"]["relevant_objects"], (std::vector<std::string>{"object_1", "object_0"}));
  EXPECT_EQ(json["stats"]["failures"]["robot_touch"], 3);
  const auto& segments = json["plan"]["segments"];
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0]["kind"], "approach");
  EXPECT_TRUE(segments[0]["object"].is_null());
  EXPECT_EQ(segments[1]["object"], "object_0");
  EXPECT_EQ(segments[1]["points"][1]["t"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(segments[1]["points"][1]["q"][0].get<double>(), problem.q_start[0] + 1.0 / 3.0);
  ASSERT_EQ(segments[1]["objects_after"]["object_0"].size(), 7u);
  EXPECT_EQ(segments[1]["objects_after"]["object_0"][6].get<double>(), 1.0);
  EXPECT_EQ(segments[1]["objects_after"].size(), 4u) << "every object that is no fixture";
}

TEST_F(ResultJson, WhatIsNotFiniteIsNullAndTheObjectStaysValid) {
  result.suboptimality_bound = std::numeric_limits<double>::infinity();
  result.stats.wall_s = std::numeric_limits<double>::quiet_NaN();
  const auto json = nlohmann::json::parse(io::result_json(result, problem));
  EXPECT_TRUE(json["suboptimality_bound"].is_null());
  EXPECT_TRUE(json["stats"]["wall_s"].is_null());
}

TEST_F(ResultJson, TextThatIsNoUtf8DoesNotThrow) {
  problem.name = "caf\xe9.yaml";
  EXPECT_NO_THROW(nlohmann::json::parse(io::result_json(result, problem)));
}

TEST_F(ResultJson, IsOneLineUnlessIndented) {
  EXPECT_EQ(io::result_json(result, problem).find('\n'), std::string::npos);
  EXPECT_NE(io::result_json(result, problem, 1).find('\n'), std::string::npos);
}

TEST_F(ResultJson, VerdictNamesSegmentTimeKindObjectsValueAndLimit) {
  Verdict verdict;
  Violation v{ViolationKind::object_touch, ObjectId{8}, kRobot, 0.25, std::numeric_limits<double>::infinity(), 1.5};
  verdict.findings.push_back({1, v, "object_3 was touched"});
  v.other = kFloor;
  verdict.findings.push_back({1, v, ""});
  const auto json = nlohmann::json::parse(io::verdict_json(verdict, problem.scene));
  EXPECT_EQ(json["schema"], "mamo-verdict/1");
  EXPECT_EQ(json["ok"], false);
  const auto& first = json["violations"][0];
  EXPECT_EQ(first["segment"], 1);
  EXPECT_EQ(first["time_s"], 1.5);
  EXPECT_EQ(first["kind"], "object_touch");
  EXPECT_EQ(first["object"], "object_3");
  EXPECT_EQ(first["other"], "robot");
  EXPECT_EQ(first["value"], 0.25);
  EXPECT_TRUE(first["limit"].is_null());
  EXPECT_EQ(json["violations"][1]["other"], "floor");
  EXPECT_EQ(json["robust"]["n"], 0);
}

TEST_F(ResultJson, VerdictCarriesTheRobustReport) {
  io::RobustReport robust;
  robust.n = 20;
  robust.survived = 19;
  robust.rate = 0.95;
  robust.ci95 = {0.76, 0.99};
  robust.causes["tilt"] = 1;
  const auto json = nlohmann::json::parse(io::verdict_json(Verdict{}, problem.scene, &robust));
  EXPECT_EQ(json["robust"]["survived"], 19);
  EXPECT_EQ(json["robust"]["ci95"][1], 0.99);
  EXPECT_EQ(json["robust"]["causes"]["tilt"], 1);
}

}  // namespace
}  // namespace mamo
