// load(to_native_yaml(p)) == p.
#include <gmock/gmock.h>

#include "mamo/io/load.hpp"
#include "mamo/io/profile.hpp"
#include "support/bad_inputs.hpp"
#include "support/sample_problem.hpp"
#include "support/scratch_folder.hpp"

namespace mamo {
namespace {

/// Rotations pass through a quaternion of 17 digits: equal to a few ulp, and to the bit as the planners see them.
void expect_same_pose(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const std::string& what) {
  EXPECT_EQ(a.translation(), b.translation()) << what;
  EXPECT_LT((a.linear() - b.linear()).cwiseAbs().maxCoeff(), 1e-15) << what;
}

void expect_same_shape(const PlacedShape& a, const PlacedShape& b, const std::string& what) {
  expect_same_pose(a.X_BS, b.X_BS, what);
  ASSERT_EQ(a.shape.index(), b.shape.index()) << what;
  if (const Box* box = std::get_if<Box>(&a.shape)) {
    EXPECT_EQ(box->size, std::get<Box>(b.shape).size) << what;
  }
  if (const Cylinder* c = std::get_if<Cylinder>(&a.shape)) {
    EXPECT_EQ(c->radius, std::get<Cylinder>(b.shape).radius) << what;
    EXPECT_EQ(c->length, std::get<Cylinder>(b.shape).length) << what;
  }
  if (const Sphere* s = std::get_if<Sphere>(&a.shape)) {
    EXPECT_EQ(s->radius, std::get<Sphere>(b.shape).radius) << what;
  }
  if (const Mesh* m = std::get_if<Mesh>(&a.shape)) {
    EXPECT_EQ(m->hull->vertices, std::get<Mesh>(b.shape).hull->vertices) << what;
  }
}

void expect_same_object(const Object& a, const Object& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.kind, b.kind) << a.id;
  EXPECT_EQ(a.mass, b.mass) << a.id;
  EXPECT_EQ(a.friction, b.friction) << a.id;
  EXPECT_EQ(a.constraints.max_tilt, b.constraints.max_tilt) << a.id;
  EXPECT_EQ(a.constraints.max_speed, b.constraints.max_speed) << a.id;
  EXPECT_EQ(a.constraints.may_leave_support, b.constraints.may_leave_support) << a.id;
  EXPECT_EQ(a.constraints.max_displacement, b.constraints.max_displacement) << a.id;
  EXPECT_EQ(a.constraints.touch, b.constraints.touch) << a.id;
  expect_same_pose(a.X_WO, b.X_WO, a.id);
  ASSERT_EQ(a.shapes.size(), b.shapes.size()) << a.id;
  for (std::size_t i = 0; i < a.shapes.size(); ++i) expect_same_shape(a.shapes[i], b.shapes[i], a.id);
}

void expect_same_task(const Task& a, const Task& b) {
  ASSERT_EQ(a.index(), b.index());
  if (const ReachPose* p = std::get_if<ReachPose>(&a)) {
    const ReachPose& q = std::get<ReachPose>(b);
    expect_same_pose(p->X_WT, q.X_WT, "task");
    EXPECT_EQ(p->position_tolerance, q.position_tolerance);
    EXPECT_EQ(p->angle_tolerance, q.angle_tolerance);
    EXPECT_EQ(p->target, q.target);
  } else if (const ReachJoints* j = std::get_if<ReachJoints>(&a)) {
    EXPECT_EQ(j->q, std::get<ReachJoints>(b).q);
    EXPECT_EQ(j->tolerance, std::get<ReachJoints>(b).tolerance);
  } else {
    const Retrieve &r = std::get<Retrieve>(a), &s = std::get<Retrieve>(b);
    EXPECT_EQ(r.object, s.object);
    expect_same_pose(r.X_WT_pregrasp, s.X_WT_pregrasp, "task");
    EXPECT_EQ(r.home, s.home);
    EXPECT_EQ(r.home_tolerance, s.home_tolerance);
  }
}

void expect_same_problem(const Problem& a, const Problem& b) {
  EXPECT_EQ(a.profile, b.profile);
  EXPECT_EQ(a.generated, b.generated);
  EXPECT_EQ(a.scene.physics.step, b.scene.physics.step);
  EXPECT_EQ(a.scene.physics.iterations, b.scene.physics.iterations);
  EXPECT_EQ(a.scene.physics.robot_friction, b.scene.physics.robot_friction);
  EXPECT_EQ(a.scene.physics.settle_time, b.scene.physics.settle_time);
  ASSERT_EQ(a.scene.size(), b.scene.size());
  for (std::size_t i = 0; i < a.scene.size(); ++i) expect_same_object(a.scene.objects[i], b.scene.objects[i]);
  EXPECT_EQ(WorldState::start_of(a.scene), WorldState::start_of(b.scene)) << "the bits that planning starts from";
  EXPECT_EQ(a.robot.group.joints, b.robot.group.joints);
  EXPECT_EQ(a.robot.group.base, b.robot.group.base);
  EXPECT_EQ(a.robot.group.tip, b.robot.group.tip);
  EXPECT_EQ(a.robot.posture, b.robot.posture);
  EXPECT_EQ(a.robot.speed_scale, b.robot.speed_scale);
  EXPECT_EQ(a.robot_files.disabled, b.robot_files.disabled);
  expect_same_pose(a.robot.X_WB, b.robot.X_WB, "robot");
  EXPECT_EQ(a.q_start, b.q_start);
  expect_same_task(a.task, b.task);
}

class RoundTrip : public ::testing::Test {
 protected:
  Problem load(const std::string& text, const std::string& name = "p.yaml", const io::LoadOptions& options = {}) {
    Result<Problem> problem = io::load_problem(folder.write(name, text), options);
    if (!problem) throw std::runtime_error(problem.error().message);
    return std::move(*problem);
  }
  void expect_round_trip(const Problem& problem) {
    const Result<std::string> text = io::to_native_yaml(problem);
    ASSERT_TRUE(text) << text.error().message;
    SCOPED_TRACE(*text);
    const Problem again = load(*text, "elsewhere/again.yaml");
    expect_same_problem(problem, again);
    EXPECT_TRUE(again.warnings.empty()) << again.warnings.front();
  }
  test::ScratchFolder folder;
};

TEST_F(RoundTrip, OfTheExample) { expect_round_trip(load(test::good_problem())); }

TEST_F(RoundTrip, OfClutterWithEveryKindOfTask) {
  Problem p = load(test::good_problem());
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed, {0x726f756e64});
    p.profile = seed % 3 == 0 ? Profile::legacy : seed % 3 == 1 ? Profile::full : Profile::contact_only;
    p.scene = fixtures::cluttered_shelf(5, 3, seed);
    for (Object& o : p.scene.objects)
      if (o.movable()) o.constraints = io::default_constraints(p.profile, o.kind);
    p.scene.objects[5].constraints.max_tilt = random.uniform(0.1, 1);
    p.scene.objects[6].constraints.max_displacement = random.uniform(0.1, 1);
    p.scene.objects[7].constraints.touch = Touch::robot;
    p.scene.physics.step = random.uniform(0.001, 0.01);
    p.robot.X_WB = fixtures::at(random.uniform(-1, 1), random.uniform(-1, 1), 0.5, random.uniform(-3, 3));
    const Eigen::Isometry3d goal = fixtures::at(random.uniform(), random.uniform(), random.uniform(), random.uniform(-3, 3));
    if (seed % 3 == 0) p.task = ReachPose{goal, 0.02, 0.1, ObjectId{11}};
    if (seed % 3 == 1) p.task = ReachJoints{p.q_start, 0.03};
    if (seed % 3 == 2) p.task = Retrieve{ObjectId{10}, goal, p.q_start, 0.02};
    p.generated = {{"seed", std::to_string(seed)}, {"note", "a: b, 'c' \"d\""}, {"empty", ""}, {"looks", "true"}};
    expect_round_trip(p);
  }
}

TEST_F(RoundTrip, OfAShelfScene) {
  expect_round_trip(load(test::good_shelf_scene(), "scene.txt"));
  io::LoadOptions options;
  options.constraints = "legacy";
  options.task = "reach";
  expect_round_trip(load(test::good_shelf_scene(), "scene.txt", options));
}

TEST_F(RoundTrip, OfAMeshFromAnywhere) {
  folder.write("tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  expect_round_trip(load(test::problem_with("{sphere: {radius: 0.04}}, pose: {position: [0.8, -0.4, 0.81]}",
                                            "{mesh: {file: tetra.obj, scale: 0.1}}, pose: {position: [0.8, -0.4, 0.77]}")));
}

TEST_F(RoundTrip, AwkwardIdsSurvive) {
  for (const char* id : {"true", "007", "1e5", "null", "~", "a b", "it's", "x:y", "-", "[", "# no comment", "\xc3\xa9"}) {
    Problem p = load(test::good_problem());
    p.scene.objects[1].id = id;
    expect_round_trip(p);
  }
}

TEST_F(RoundTrip, ARobotFromNoFileCannotBeWritten) {
  const Result<std::string> text = io::to_native_yaml(fixtures::sample_problem());
  ASSERT_FALSE(text);
  EXPECT_THAT(text.error().message, ::testing::HasSubstr("no URDF"));
}

}  // namespace
}  // namespace mamo
