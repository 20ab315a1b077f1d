#include "mamo/experiments/refrigerator.hpp"

#include <gtest/gtest.h>

#include "mamo/experiments/difficulty.hpp"
#include "mamo/experiments/household.hpp"
#include "mamo/io/load.hpp"
#include "mamo/planners/validate.hpp"

namespace mamo {
namespace {

Problem refrigerator(int index) {
  Result<Problem> problem = generate_refrigerator({1, index, Profile::full});
  EXPECT_TRUE(problem.ok()) << problem.error().message;
  return std::move(*problem);
}

TEST(Refrigerator, HoldsFiveHouseholdThingsAndTheCanIsBehindOthers) {
  for (int i = 0; i < 4; ++i) {
    const Problem p = refrigerator(i);
    SCOPED_TRACE(p.name);
    const Status sound = validate(p);
    EXPECT_TRUE(sound.ok()) << sound.error().message;
    EXPECT_EQ(p.scene[std::get<Retrieve>(p.task).object].id, "tomato_soup_can");
    EXPECT_EQ(ObjectSet::of_kind(p.scene, ObjectKind::movable).ids().size(), 4u);
    EXPECT_NE(difficulty(p), Difficulty::none);
    for (const Object& o : p.scene.objects) {
      if (o.fixture()) continue;
      const auto items = household_items();
      const auto item = std::find_if(items.begin(), items.end(), [&](const HouseholdItem& known) { return known.name == o.id; });
      ASSERT_NE(item, items.end()) << o.id;
      EXPECT_NEAR(o.mass / item->mass, 1, 0.1 + 1e-9);
      EXPECT_NEAR(volume(o.shapes[0].shape), volume(item->shape), 1e-9);
    }
  }
}

TEST(Refrigerator, AFileDependsOnSeedAndIndexOnly) {
  const auto text = io::to_native_yaml(refrigerator(1));
  refrigerator(0);
  EXPECT_EQ(*text, *io::to_native_yaml(refrigerator(1)));
  EXPECT_NE(*text, *io::to_native_yaml(refrigerator(2)));
}

}  // namespace
}  // namespace mamo
