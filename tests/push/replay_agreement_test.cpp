// The continuous replay of several pushes ends where planning said, push by push.
#include <gtest/gtest.h>

#include "support/push_chain.hpp"
#include "support/push_problem.hpp"

namespace mamo {
namespace {

using namespace fixtures;

constexpr std::uint64_t kSeed = 11;

TEST(ReplayAgreement, APushOnItsOwnAndAsAPartOfALongerMotionGivesTheSameBits) {
  const Problem problem = push_problem(cluttered_shelf(8, 3, 5));
  const auto kinematics = std::make_shared<ForwardKinematics>(problem.robot);
  PushPlanner planner(problem, kinematics, {}, kSeed);
  Evaluator evaluator(kinematics, problem.scene);
  const ObjectSet all = ObjectSet::all(problem.scene);
  int compared = 0;
  for (const PushRequest& request : push_requests(problem)) {
    const PushOutcome out = planner.attempt(request, nullptr, nullptr);
    if (!out.valid()) continue;
    std::vector<Eigen::VectorXd> whole = out.approach;
    whole.insert(whole.end(), out.push.begin() + 1, out.push.end());
    const TimedPath motion = time_path(problem.robot, whole, problem.scene.physics.step);
    EvaluationRequest again;
    again.present = &all;
    again.from = &request.state;
    again.motion = &motion;
    again.until_asleep = true;
    EXPECT_EQ(evaluator.evaluate(again).state, out.after) << "object " << problem.scene[request.object].id;
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

TEST(ReplayAgreement, AMotionMeetsTheSameConfigurationsWhereverItBegins) {
  const Problem problem = one_cylinder_problem();
  RandomStream random(kSeed, {2});
  const double step_s = problem.scene.physics.step;
  for (int k = 0; k < 200; ++k) {
    std::vector<Eigen::VectorXd> path = {problem.q_start};
    for (int i = 0; i < 4; ++i) {
      path.push_back(path.back());
      for (double& value : path.back()) value += random.uniform(-0.1, 0.1);
    }
    const TimedPath motion = time_path(problem.robot, path, step_s);
    TimedPath late = motion;
    const double offset = static_cast<double>(random.below(100000)) * step_s;
    for (double& t : late.t) t += offset;
    Eigen::VectorXd q, q_late;
    for (long i = 0; i <= std::lround(motion.duration() / step_s); ++i) {
      motion.at(static_cast<double>(i) * step_s, q);
      late.at(static_cast<double>(i + std::lround(offset / step_s)) * step_s, q_late);
      ASSERT_EQ(q, q_late) << "seed " << kSeed << " path " << k << " step " << i;
    }
  }
}

TEST(ReplayAgreement, ObjectsEndWherePlanningSaid) {
  Agreement agreement;
  for (std::uint64_t scene = 1; scene <= 8; ++scene) {
    const Problem problem = push_problem(cluttered_shelf(8, 3, scene));
    const auto kinematics = std::make_shared<ForwardKinematics>(problem.robot);
    agreement.add(problem, random_chain(problem, kinematics, push_requests(problem), 4, {}, kSeed + scene));
  }
  agreement.print();
  for (const std::string& text : agreement.violations) std::puts(text.c_str());
  ASSERT_GE(agreement.chains, 5);
  ASSERT_GE(agreement.later_mm.size(), 10u);
  // Exactly: contact dynamics would make centimetres of the smallest difference.
  EXPECT_LT(Agreement::quantile(agreement.first_mm, 1), 1e-6) << "seed " << kSeed;
  EXPECT_LT(Agreement::quantile(agreement.later_mm, 1), 1e-6) << "seed " << kSeed;
  EXPECT_TRUE(agreement.violations.empty()) << "seed " << kSeed;
}

}  // namespace
}  // namespace mamo
