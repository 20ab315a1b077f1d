#include "mamo/experiments/tabletop.hpp"

#include <gmock/gmock.h>

#include <set>

#include "experiments/footprint.hpp"
#include "support/scratch_folder.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/common/random.hpp"
#include "mamo/experiments/household.hpp"
#include "mamo/io/load.hpp"
#include "mamo/kinematics/inverse_kinematics.hpp"
#include "mamo/planners/validate.hpp"

namespace mamo {
namespace {

using testing::HasSubstr;

Problem tabletop(int movable, int immovable, int index, std::uint64_t seed = 1) {
  Result<Problem> problem = generate_tabletop({movable, immovable, seed, index, Profile::contact_only});
  EXPECT_TRUE(problem.ok()) << problem.error().message;
  return std::move(*problem);
}

std::vector<Problem> tabletops(int count) {
  std::vector<Problem> problems;
  for (int i = 0; i < count; ++i) problems.push_back(tabletop(10, 2, i));
  return problems;
}

std::string yaml(const Problem& problem) {
  const Result<std::string> text = io::to_native_yaml(problem);
  EXPECT_TRUE(text.ok()) << text.error().message;
  return *text;
}

TEST(Tabletop, ProblemsAreSoundAndHoldWhatWasAskedFor) {
  for (const Problem& p : tabletops(20)) {
    SCOPED_TRACE(p.name);
    const Status sound = validate(p);
    EXPECT_TRUE(sound.ok()) << sound.error().message;
    EXPECT_EQ(ObjectSet::of_kind(p.scene, ObjectKind::movable).ids().size(), 10u);
    EXPECT_EQ(ObjectSet::of_kind(p.scene, ObjectKind::immovable).ids().size(), 2u);
    EXPECT_EQ(ObjectSet::of_kind(p.scene, ObjectKind::fixture).ids().size(), 1u);
    std::set<std::string> ids;
    for (const Object& o : p.scene.objects) {
      EXPECT_TRUE(ids.insert(o.id).second) << o.id;
      EXPECT_EQ(o.constraints.may_leave_support, true);
      EXPECT_NEAR(o.X_WO.linear()(2, 2), 1, 1e-12) << o.id << " does not stand upright";
    }
  }
}

TEST(Tabletop, AFileDependsOnSeedAndIndexOnly) {
  const std::string third = yaml(tabletop(6, 2, 3));
  for (int i = 0; i < 3; ++i) tabletop(6, 2, i);
  EXPECT_EQ(yaml(tabletop(6, 2, 3)), third);
  EXPECT_NE(yaml(tabletop(6, 2, 4)), third);
  EXPECT_NE(yaml(tabletop(6, 2, 3, 2)), third);
}

TEST(Tabletop, WrittenProblemsAreReadBackAsTheyWere) {
  const test::ScratchFolder folder;
  const Problem made = tabletop(10, 2, 0);
  const std::string path = folder.write(made.name, yaml(made));
  const Result<Problem> read = io::load_problem(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->profile, Profile::contact_only);
  EXPECT_EQ(read->q_start, made.q_start);
  EXPECT_EQ(read->robot.posture, made.robot.posture);
  EXPECT_EQ(read->generated.at("seed"), "1");
  EXPECT_TRUE(WorldState::start_of(read->scene) == WorldState::start_of(made.scene));
  EXPECT_TRUE(std::get<ReachPose>(read->task).X_WT.isApprox(std::get<ReachPose>(made.task).X_WT, 1e-6));
}

TEST(Tabletop, TheFullProfileConstrainsMovables) {
  const Result<Problem> p = generate_tabletop({3, 1, 1, 0, Profile::full});
  ASSERT_TRUE(p.ok()) << p.error().message;
  for (const Object& o : p->scene.objects)
    EXPECT_EQ(std::isfinite(o.constraints.max_tilt), o.kind == ObjectKind::movable) << o.id;
}

// No toys: in most problems something stands in the goal, whatever the arm does.
TEST(Tabletop, AtLeastHalfOfTheGoalsNeedContact) {
  const ContactFreeCount count = count_contact_free(tabletops(60), {});
  EXPECT_GE(count.certainly_not, 30);
  EXPECT_LT(count.certainly_not, 60) << "no variety";
  EXPECT_THAT(count.text(), HasSubstr("of 60 problems at most"));
}

TEST(Tabletop, TheHookIsAskedOnlyWhereContactIsNotCertain) {
  int asked = 0;
  const auto hook = [&](const Problem& p) {
    EXPECT_FALSE(goal_needs_contact(p));
    return ++asked % 2 == 0;
  };
  const ContactFreeCount count = count_contact_free(tabletops(12), hook);
  EXPECT_EQ(asked, 12 - count.certainly_not);
  EXPECT_GT(asked, 0);
  EXPECT_EQ(count.solved, asked / 2);
  EXPECT_EQ(count.not_solved + count.solved, asked);
  EXPECT_THAT(count.text(),
              HasSubstr("of 12 problems " + std::to_string(asked / 2) + " are solvable touching nothing"));
}

// What is called certain is never refuted by a configuration: 40 poses at the edge of each goal's tolerances.
TEST(Tabletop, CertainContactHoldsThroughoutTheTolerances) {
  int tried = 0;
  for (const Problem& p : tabletops(8)) {
    if (p.generated.at("goal_needs_contact") != "yes") continue;
    SCOPED_TRACE(p.name);
    const ReachPose& goal = std::get<ReachPose>(p.task);
    auto kinematics = std::make_shared<ForwardKinematics>(p.robot);
    CollisionChecker checker(kinematics, p.scene);
    CollisionReport report;
    RandomStream random(7, {1});
    const auto direction = [&] {
      return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    };
    for (int k = 0; k < 40; ++k) {
      Eigen::Isometry3d X_WT = goal.X_WT;
      X_WT.translation() += goal.position_tolerance * direction();
      X_WT.linear() = Eigen::AngleAxisd(goal.angle_tolerance, direction()) * X_WT.linear();
      const auto q = InverseKinematics(*kinematics).solve(X_WT, p.q_start, 1);
      if (!q) continue;
      ++tried;
      checker.check(*q, ObjectSet::of_kind(p.scene, ObjectKind::movable), true, report);
      EXPECT_FALSE(report.touched.empty());
    }
  }
  EXPECT_GT(tried, 50);
}

TEST(Tabletop, ImpossibleCountsAreUsageErrors) {
  const TabletopSpec impossible[] = {
      {-1, 0, 1, 0, {}}, {0, -1, 1, 0, {}}, {100, 0, 1, 0, {}}, {1, 1, 1, -1, {}}, {60, 0, 1, 0, {}}};
  for (const TabletopSpec& spec : impossible) {
    const Result<Problem> p = generate_tabletop(spec);
    ASSERT_FALSE(p.ok()) << spec.movable << " " << spec.immovable;
    EXPECT_EQ(p.error().kind, ErrorKind::usage);
  }
  EXPECT_TRUE(generate_tabletop({0, 0, 1, 0, Profile::contact_only}).ok());
}

TEST(Household, ItemsAreOfHouseholdSizeAndMass) {
  for (const HouseholdItem& item : household_items()) {
    SCOPED_TRACE(std::string(item.name));
    const double density = item.mass / volume(item.shape);
    EXPECT_GT(density, 150);  // kg/m^3: a full can 1000, a box of crackers 200
    EXPECT_LT(density, 1200);
    EXPECT_LE(height(item.shape), 0.25);
    EXPECT_LE(footprint_radius(item.shape), 0.09);
  }
}

TEST(Footprints, OverlapIsFoundAndDistanceIsKept) {
  const Shape box = Box{{0.2, 0.1, 0.3}}, can = Cylinder{0.05, 0.1};
  EXPECT_TRUE(closer_than(footprint(box, 0, 0, 0), footprint(can, 0.149, 0, 0), 0));
  EXPECT_FALSE(closer_than(footprint(box, 0, 0, 0), footprint(can, 0.152, 0, 0), 0));
  EXPECT_TRUE(closer_than(footprint(box, 0, 0, 0), footprint(can, 0.152, 0, 0), 0.01));
  EXPECT_FALSE(closer_than(footprint(box, 0, 0, 0), footprint(can, 0.165, 0, 0), 0.01));
  // Turned by a right angle the box is 0.1 deep.
  EXPECT_FALSE(closer_than(footprint(box, 0, 0, 1.5707963), footprint(can, 0.102, 0, 0), 0));
}

}  // namespace
}  // namespace mamo
