// The continuous replay of several pushes ends where planning said, push by push.
#include <gtest/gtest.h>

#include "support/push_chain.hpp"
#include "support/push_problem.hpp"

namespace mamo {
namespace {

using namespace fixtures;

constexpr std::uint64_t kSeed = 11;

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
