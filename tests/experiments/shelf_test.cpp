#include "mamo/experiments/shelf.hpp"

#include <gmock/gmock.h>

#include "experiments/shelf_room.hpp"
#include "support/scratch_folder.hpp"
#include "support/shared_data.hpp"

#include "mamo/io/load.hpp"
#include "mamo/planners/validate.hpp"

namespace mamo {
namespace {

Problem shelf(int movable, int immovable, int index, std::uint64_t seed = 1, std::optional<Difficulty> wanted = {}) {
  Result<Problem> problem = generate_shelf({movable, immovable, seed, index, Profile::full, wanted});
  EXPECT_TRUE(problem.ok()) << problem.error().message;
  return std::move(*problem);
}

std::string yaml(const Problem& problem) {
  const Result<std::string> text = io::to_native_yaml(problem);
  EXPECT_TRUE(text.ok()) << text.error().message;
  return *text;
}

TEST(Shelf, ProblemsAreSoundAndHoldWhatWasAskedFor) {
  for (int i = 0; i < 3; ++i) {
    const Problem p = shelf(5 * (i % 3 + 1), 4, i);
    SCOPED_TRACE(p.name);
    const Status sound = validate(p);
    EXPECT_TRUE(sound.ok()) << sound.error().message;
    EXPECT_EQ(ObjectSet::of_kind(p.scene, ObjectKind::movable).ids().size(), static_cast<std::size_t>(5 * (i % 3 + 1)));
    EXPECT_EQ(ObjectSet::of_kind(p.scene, ObjectKind::immovable).ids().size(), 5u) << "four and the one to fetch";
    const Retrieve& task = std::get<Retrieve>(p.task);
    EXPECT_EQ(p.scene[task.object].id, "target");
    EXPECT_EQ(task.home, p.q_start);
    EXPECT_TRUE(retrieval_region(p).has_value());
  }
}

TEST(Shelf, EverythingStandsUprightOnTheFloorAndInside) {
  for (int i = 0; i < 2; ++i)
    for (const Object& o : shelf(15, 4, i, 3).scene.objects) {
      if (o.fixture()) continue;
      SCOPED_TRACE(o.id);
      const Eigen::AlignedBox3d box = bounds(o.shapes[0].shape, o.X_WO);
      EXPECT_NEAR(box.min().z(), kShelf.floor, 1e-9);
      EXPECT_LT(box.max().z(), 1.09);
      EXPECT_NEAR(o.X_WO.linear()(2, 2), 1, 1e-12);
      EXPECT_GE(box.min().x(), kShelf.x[0] - 1e-9);
      EXPECT_LT(box.max().x(), kShelf.x[1]);
      EXPECT_GT(box.min().y(), kShelf.y[0]);
      EXPECT_LT(box.max().y(), kShelf.y[1]);
    }
}

// Facts of the published scenes (their smallest and largest values), seen here too.
TEST(Shelf, SizesMassesAndFrictionsAreOfThePublishedRanges) {
  int boxes = 0, cylinders = 0;
  for (int i = 0; i < 4; ++i)
    for (const Object& o : shelf(15, 4, i, 5).scene.objects) {
      if (o.fixture()) continue;
      EXPECT_GE(o.mass, 0.001);
      EXPECT_LE(o.mass, 0.5);
      EXPECT_GE(o.friction, 0.8);
      EXPECT_LE(o.friction, 1.2);
      if (const Box* box = std::get_if<Box>(&o.shapes[0].shape)) {
        ++boxes;
        EXPECT_GE(box->size.head<2>().minCoeff(), 0.06);
        EXPECT_LE(box->size.head<2>().maxCoeff(), 0.16);
        EXPECT_GE(box->size.z(), 0.18);
        EXPECT_LE(box->size.z(), 0.31);
      } else {
        ++cylinders;
        const Cylinder& c = std::get<Cylinder>(o.shapes[0].shape);
        EXPECT_GE(c.radius, 0.03);
        EXPECT_LE(c.radius, 0.08);
        EXPECT_GE(c.length, 0.15);
        EXPECT_LE(c.length, 0.20);
      }
    }
  EXPECT_GT(boxes, 15);
  EXPECT_GT(cylinders, 15);
}

TEST(Shelf, AFileDependsOnSeedAndIndexOnly) {
  const std::string third = yaml(shelf(4, 1, 2));
  shelf(4, 1, 0);
  EXPECT_EQ(yaml(shelf(4, 1, 2)), third);
  EXPECT_NE(yaml(shelf(4, 1, 3)), third);
  EXPECT_NE(yaml(shelf(4, 1, 2, 2)), third);
}

TEST(Shelf, TheDifficultyAskedForIsTheOneThatItsFileHas) {
  const test::ScratchFolder folder;
  for (Difficulty wanted : {Difficulty::easy, Difficulty::medium, Difficulty::hard}) {
    const Problem made = shelf(10, 4, 0, 2, wanted);
    EXPECT_EQ(made.generated.at("difficulty"), to_string(wanted));
    Result<Problem> read = io::load_problem(folder.write(made.name, yaml(made)));
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(difficulty(*read), wanted);
    read->generated.clear();  // computed again, from the file
    EXPECT_EQ(difficulty(*read), wanted);
  }
}

TEST(Shelf, DifficultyCountsTheMovablesInTheWay) {
  EXPECT_EQ(difficulty_of(0), Difficulty::none);
  EXPECT_EQ(difficulty_of(1), Difficulty::easy);
  EXPECT_EQ(difficulty_of(2), Difficulty::medium);
  EXPECT_EQ(difficulty_of(3), Difficulty::hard);
  EXPECT_EQ(difficulty_of(9), Difficulty::hard);
  EXPECT_EQ(parse_difficulty("medium"), Difficulty::medium);
  EXPECT_EQ(parse_difficulty("Medium"), std::nullopt);
  const Problem nothing = shelf(0, 2, 0);
  EXPECT_EQ(difficulty(nothing), Difficulty::none);
}

TEST(Shelf, ImpossibleRequestsAreUsageErrors) {
  const ShelfSpec impossible[] = {{-1, 0, 1, 0, Profile::full, {}},
                                  {0, -1, 1, 0, Profile::full, {}},
                                  {1, 1, 1, -1, Profile::full, {}},
                                  {100, 1, 1, 0, Profile::full, {}},
                                  {1, 0, 1, 0, Profile::full, Difficulty::medium}};
  for (const ShelfSpec& spec : impossible) {
    const Result<Problem> p = generate_shelf(spec);
    ASSERT_FALSE(p.ok()) << spec.movable << " " << spec.immovable;
    EXPECT_EQ(p.error().kind, ErrorKind::usage);
  }
}

// The shelf itself is that of the published scenes, part for part.
TEST(Shelf, TheRoomIsThePublishedOne) {
  MAMO_SHARED_OR_SKIP(scene, "em4m_scenes/5/plan_100000_SCENE.txt");
  const Result<Problem> published = io::load_problem(scene);
  ASSERT_TRUE(published.ok()) << published.error().message;
  const Problem ours = shelf(0, 0, 0);
  EXPECT_TRUE(ours.robot.posture.isApprox(published->robot.posture, 1e-6));
  EXPECT_EQ(ours.robot.group.tip, published->robot.group.tip);
  EXPECT_TRUE(ours.q_start.isApprox(published->q_start, 1e-6));
  for (std::size_t i = 0; i < 5; ++i) {
    const Object &a = ours.scene.objects[i], &b = published->scene.objects[i];
    EXPECT_TRUE(a.X_WO.isApprox(b.X_WO, 1e-9)) << a.id;
    EXPECT_TRUE(std::get<Box>(a.shapes[0].shape).size.isApprox(std::get<Box>(b.shapes[0].shape).size, 1e-9)) << a.id;
    EXPECT_EQ(a.constraints.touch, b.constraints.touch) << a.id;
  }
}

}  // namespace
}  // namespace mamo
