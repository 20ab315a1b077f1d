// Edges: how densely they are looked at, and that the answer is a function of the question.
#include <thread>

#include "support/brute_force.hpp"
#include "support/robots.hpp"

#include "mamo/collision/collision_checker.hpp"

namespace mamo {
namespace {

constexpr std::uint64_t kSeed = 41;

struct Edge {
  Eigen::VectorXd q0, q1;
};

Edge random_edge(const Robot& robot, RandomStream& random) {
  const Eigen::VectorXd q0 = fixtures::random_configuration(robot, random);
  const double length = std::pow(10.0, random.uniform(-2.5, 0.0));
  Eigen::VectorXd d = length * (fixtures::random_configuration(robot, random) - q0);
  if (random.below(2) == 0) {  // one joint only
    const int joint = static_cast<int>(random.below(static_cast<std::uint64_t>(robot.dof())));
    for (int i = 0; i < robot.dof(); ++i)
      if (i != joint) d[i] = 0;
  }
  return {q0, q0 + d};
}

struct Point {
  std::size_t link;
  Eigen::Vector3d p_L;
};

TEST(Edge, NoPointOfTheArmMovesFurtherThanTheStepBetweenSamples) {
  for (const Robot& robot : {fixtures::pr2_like_arm(), fixtures::made_up_robot()}) {
    const auto kinematics = std::make_shared<ForwardKinematics>(robot);
    CollisionChecker checker(kinematics, Scene{});
    RandomStream random(kSeed, {1});
    const std::vector<bool> moves = robot.moving_links();
    std::vector<Point> points;
    for (std::size_t l = 0; l < moves.size(); ++l)
      for (const PlacedShape& s : robot.model->links[l].collision)
        for (int k = 0; moves[l] && k < 12; ++k)
          points.push_back({l, s.X_BS * support(s.shape, {random.normal(), random.normal(), random.normal()})});
    std::vector<Eigen::Isometry3d> before, after;
    double widest_of_all = 0, used = 0, samples = 0;
    for (int k = 0; k < 300; ++k) {
      const Edge e = random_edge(robot, random);
      const std::vector<double> s = checker.edge_samples(e.q0, e.q1);
      ASSERT_EQ(s.front(), 0.0);
      ASSERT_EQ(s.back(), 1.0);
      kinematics->link_poses(e.q0, after);
      double length = 0;  // of the path of the point that moves most
      for (std::size_t i = 1; i < s.size(); ++i) {
        ASSERT_LT(s[i - 1], s[i]);
        before = after;
        kinematics->link_poses((1.0 - s[i]) * e.q0 + s[i] * e.q1, after);
        double widest = 0;
        for (const Point& p : points)
          widest = std::max(widest, (before[p.link] * p.p_L - after[p.link] * p.p_L).norm());
        ASSERT_LE(widest, checker.options().edge_step + 1e-12)
            << robot.model->name << ", seed " << kSeed << ", edge " << k;
        widest_of_all = std::max(widest_of_all, widest);
        length += widest;
      }
      used += length / checker.options().edge_step;
      samples += static_cast<double>(s.size() - 1);
    }
    std::printf("%s: %.2f of the step used on average, at most %.2f\n", robot.model->name.c_str(), used / samples,
                widest_of_all / checker.options().edge_step);
    EXPECT_GT(used / samples, 0.4) << "the bound is wasteful";
  }
}

TEST(Edge, AnEdgeOfNoLengthIsItsConfiguration) {
  const Robot robot = fixtures::pr2_like_arm();
  const Scene scene = fixtures::cluttered_shelf(10, 5, 3);
  const ObjectSet all = ObjectSet::all(scene);
  CollisionChecker checker(std::make_shared<ForwardKinematics>(robot), scene, {0.01, 0.0});
  RandomStream random(kSeed, {2});
  CollisionReport edge, single;
  for (int k = 0; k < 200; ++k) {
    const Eigen::VectorXd q = fixtures::random_configuration(robot, random);
    checker.check(q, all, false, single);
    const bool passes = checker.check_edge(q, q, {}, all, edge);
    ASSERT_EQ(passes, !single.self);
    if (!passes) continue;
    ASSERT_EQ(edge.touched, single.touched);
  }
}

TEST(Edge, PaddingHoldsABandOfHalfAStepAroundEveryObject) {
  // What the plain checker finds anywhere along the edge, the padded one finds at its samples.
  const Robot robot = fixtures::pr2_like_arm();
  const Scene scene = fixtures::cluttered_shelf(10, 5, 3);
  const ObjectSet all = ObjectSet::all(scene);
  CollisionChecker checker(std::make_shared<ForwardKinematics>(robot), scene, {0.01, 0.005});
  RandomStream random(kSeed, {3});
  CollisionReport edge, single;
  int touching = 0;
  for (int k = 0; k < 300; ++k) {
    const Edge e = random_edge(robot, random);
    if (!checker.check_edge(e.q0, e.q1, {}, all, edge)) continue;
    for (int i = 0; i <= 50; ++i) {
      const double s = random.uniform();
      checker.check((1.0 - s) * e.q0 + s * e.q1, all, false, single);
      for (ObjectId id : single.touched) {
        ASSERT_TRUE(std::binary_search(edge.touched.begin(), edge.touched.end(), id))
            << "seed " << kSeed << ", edge " << k;
        ++touching;
      }
    }
  }
  EXPECT_GT(touching, 100);
}

struct Question {
  Edge edge;
  WorldState state;
  ObjectSet forbidden, watched;
  bool hold;
};

struct Answer {
  bool passes;
  CollisionReport edge, single;
  bool operator==(const Answer& o) const {
    const auto same = [](const CollisionReport& a, const CollisionReport& b) {
      return a.self == b.self && a.touched == b.touched && a.first_touch == b.first_touch &&
             (!a.self || a.first_self == b.first_self);
    };
    return passes == o.passes && same(edge, o.edge) && same(single, o.single);
  }
};

Answer ask(CollisionChecker& checker, const Question& question, LinkId palm) {
  checker.set_state(question.state);
  if (question.hold) checker.attach(ObjectId{6}, palm, fixtures::at(0.2, 0, 0));
  Answer answer{};
  answer.passes =
      checker.check_edge(question.edge.q0, question.edge.q1, question.forbidden, question.watched, answer.edge);
  checker.check(question.edge.q1, question.watched, false, answer.single);
  if (question.hold) checker.detach();
  return answer;
}

std::vector<Question> questions(const Robot& robot, const Scene& scene, int count) {
  RandomStream random(kSeed, {4});
  std::vector<Question> out;
  for (int k = 0; k < count; ++k) {
    Question q{random_edge(robot, random), WorldState::start_of(scene), ObjectSet(scene.size()),
               ObjectSet(scene.size()), random.below(4) == 0};
    for (std::size_t i = 0; i < scene.size(); ++i) {
      (random.below(6) == 0 ? q.forbidden : q.watched).insert(ObjectId(i));
      if (!scene.objects[i].fixture() && random.below(3) == 0)
        q.state.poses[i].p[0] += 1000 * static_cast<int>(random.below(100));
    }
    out.push_back(q);
  }
  return out;
}

TEST(Edge, AnswersDoNotDependOnWhatWasAskedBefore) {
  const Robot robot = fixtures::pr2_like_arm();
  const Scene scene = fixtures::cluttered_shelf(10, 5, 3);
  const auto kinematics = std::make_shared<ForwardKinematics>(robot);
  const LinkId palm = robot.model->find_link("palm");
  const std::vector<Question> all = questions(robot, scene, 40);
  std::vector<Answer> fresh;
  for (const Question& q : all) {
    CollisionChecker checker(kinematics, scene);
    fresh.push_back(ask(checker, q, palm));
  }
  CollisionChecker used(kinematics, scene);
  RandomStream random(kSeed, {5});
  for (int k = 0; k < 1000; ++k) {
    const std::size_t i = random.below(all.size());
    ASSERT_EQ(ask(used, all[i], palm), fresh[i]) << "seed " << kSeed << ", interleaving " << k << ", question " << i;
  }
}

TEST(Edge, TwoThreadsWithTheirOwnCheckersAgreeWithOne) {
  const Robot robot = fixtures::pr2_like_arm();
  const Scene scene = fixtures::cluttered_shelf(10, 5, 3);
  const auto kinematics = std::make_shared<ForwardKinematics>(robot);
  const LinkId palm = robot.model->find_link("palm");
  const std::vector<Question> all = questions(robot, scene, 400);
  std::vector<std::vector<Answer>> answers(3, std::vector<Answer>(all.size()));
  const auto work = [&](std::size_t slot) {
    CollisionChecker checker(kinematics, scene);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t k = slot == 1 ? all.size() - 1 - i : i;  // one of them backwards
      answers[slot][k] = ask(checker, all[k], palm);
    }
  };
  work(0);
  std::thread first(work, 1), second(work, 2);
  first.join();
  second.join();
  EXPECT_EQ(answers[1], answers[0]);
  EXPECT_EQ(answers[2], answers[0]);
}

TEST(Edge, AHeldObjectIsRobotAndNoLongerObstacle) {
  const Robot robot = fixtures::pr2_like_arm();
  Scene scene = fixtures::cluttered_shelf(10, 5, 3);
  scene.objects[6].shapes.push_back({Sphere{0.05}, fixtures::at(0, 0, 0.12)});  // a body of two shapes
  const CollisionOptions options{0.01, 0.0055};
  CollisionChecker checker(std::make_shared<ForwardKinematics>(robot), scene, options);
  fixtures::BruteForce plain(robot, scene, 0), padded(robot, scene, options.padding);
  const LinkId palm = robot.model->find_link("palm");
  const Eigen::Isometry3d X_LO = fixtures::at(0.22, 0.01, 0.02, 0.3);
  checker.attach(ObjectId{6}, palm, X_LO);
  for (auto* reference : {&plain, &padded}) {
    reference->held = ObjectId{6};
    reference->held_by = palm;
    reference->X_LHeld = X_LO;
  }
  ObjectSet all(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) all.insert(ObjectId(i));
  RandomStream random(kSeed, {6});
  CollisionReport report;
  int passed = 0;
  for (int k = 0; k < 300; ++k) {
    const Edge e = random_edge(robot, random);
    checker.check(e.q0, all, false, report);
    ASSERT_EQ(report.touched, plain.touched(e.q0)) << "seed " << kSeed << ", k " << k;
    ASSERT_EQ(report.self, plain.self(e.q0)) << "seed " << kSeed << ", k " << k;
    bool self = false;
    std::vector<std::uint8_t> seen(scene.size(), 0);
    for (double s : checker.edge_samples(e.q0, e.q1)) {
      const Eigen::VectorXd q = (1.0 - s) * e.q0 + s * e.q1;
      self = self || plain.self(q);
      for (ObjectId id : padded.touched(q)) seen[id.index()] = 1;
    }
    const bool passes = checker.check_edge(e.q0, e.q1, {}, all, report);
    ASSERT_EQ(passes, !self) << "seed " << kSeed << ", k " << k;
    if (!passes) continue;
    ++passed;
    for (std::size_t i = 0; i < scene.size(); ++i)
      ASSERT_EQ(seen[i] != 0, std::binary_search(report.touched.begin(), report.touched.end(), ObjectId(i)));
  }
  EXPECT_GT(passed, 50);
}

TEST(Edge, AConfigurationThatIsNotFiniteIsAMisuse) {
  const Robot robot = fixtures::pr2_like_arm();
  CollisionChecker checker(std::make_shared<ForwardKinematics>(robot), fixtures::shelf());
  Eigen::VectorXd q = robot.group_part(robot.posture), bad = q;
  bad[2] = std::numeric_limits<double>::quiet_NaN();
  CollisionReport report;
  EXPECT_THROW(checker.check(bad, {}, false, report), std::invalid_argument);
  EXPECT_THROW(checker.check_edge(q, bad, {}, {}, report), std::invalid_argument);
}

}  // namespace
}  // namespace mamo
