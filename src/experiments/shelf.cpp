#include "mamo/experiments/shelf.hpp"

#include <algorithm>
#include <numbers>

#include "experiments/footprint.hpp"
#include "experiments/retrieve_task.hpp"
#include "experiments/shelf_room.hpp"
#include "experiments/shipped_robot.hpp"

#include "mamo/common/random.hpp"
#include "mamo/experiments/household.hpp"
#include "mamo/io/profile.hpp"
#include "mamo/planners/validate.hpp"

namespace mamo {
namespace {

constexpr double kGap = 0.004;                         // m between objects, and to the walls
constexpr double kLeastMass = 0.001, kMostMass = 0.5;  // kg; the published ones go down to 0.07 g
constexpr double kFriction[2] = {0.8, 1.2};
constexpr double kHeadingSpread = 0.5;  // rad to each side
constexpr int kMostObjects = 60;
constexpr int kPlaceAttempts = 400;  // per object
constexpr int kScenes = 400, kMovableDraws = 8;
constexpr std::uint64_t kStreamKey = 0x7368656c66;  // "shelf"
enum class Use : std::uint64_t { kept, movables, approach };

/// Draws one scene after another until one is what was asked for.
class Generator {
 public:
  explicit Generator(const ShelfSpec& spec) : spec_(spec) {}

  Result<Problem> run() {
    if (spec_.movable < 0 || spec_.immovable < 0 || spec_.movable + spec_.immovable + 1 > kMostObjects ||
        spec_.index < 0)
      return Error{"shelf: at most " + std::to_string(kMostObjects - 1) +
                       " objects beside the one to fetch, counts and index not negative",
                   ErrorKind::usage};
    if (spec_.difficulty && difficulty_of(spec_.movable) < *spec_.difficulty)
      return Error{"shelf: " + std::to_string(spec_.movable) + " movable objects cannot be " +
                       std::string(to_string(*spec_.difficulty)),
                   ErrorKind::usage};
    problem_.name = "shelf-" + std::to_string(spec_.seed) + "-" + std::to_string(spec_.index) + ".yaml";
    problem_.path = problem_.name;
    problem_.profile = spec_.profile;
    if (Status s = install_shipped_pr2(problem_, "r_gripper_finger_dummy_planning_link"); !s) return s.error();
    for (scene_ = 0; scene_ < kScenes; ++scene_) {
      if (!draw_kept()) continue;
      const std::optional<VoxelVolume> region = retrieval_region(problem_);
      if (!region) continue;
      for (int k = 0; k < kMovableDraws; ++k, ++redraws_) {
        if (!draw_movables(k) || !validate(problem_).ok()) continue;
        const int in_the_way = movables_in(*region, problem_);
        if (!spec_.difficulty || difficulty_of(in_the_way) == *spec_.difficulty) return finish(in_the_way);
      }
    }
    return Error{"shelf: no problem of that kind in " + std::to_string(kScenes) + " scenes (seed " +
                     std::to_string(spec_.seed) + ", index " + std::to_string(spec_.index) + ")",
                 ErrorKind::usage};
  }

 private:
  /// Streams do not depend on what other streams drew.
  RandomStream stream(Use use, int draw, int which) const {
    return RandomStream(spec_.seed, {kStreamKey, static_cast<std::uint64_t>(spec_.index),
                                     static_cast<std::uint64_t>(scene_), static_cast<std::uint64_t>(use),
                                     static_cast<std::uint64_t>(draw), static_cast<std::uint64_t>(which)});
  }

  /// The shelf, the object to fetch, obstacles, the task. False when something found no place or cannot be reached.
  bool draw_kept() {
    ++redraws_;
    problem_.scene.objects = shelf_fixtures(kShelf, spec_.profile);
    fixtures_ = problem_.scene.size();
    taken_.clear();
    for (int k = 0; k <= spec_.immovable; ++k) {
      const std::string id = k == 0 ? "target" : "obstacle_" + std::to_string(k);
      if (!place(id, ObjectKind::immovable, stream(Use::kept, 0, k))) return false;
    }
    const double turn = stream(Use::approach, 0, 0).uniform(-kHeadingSpread, kHeadingSpread);
    problem_.task = retrieve_task(problem_, ObjectId(fixtures_), turn);
    return validate(problem_).ok();
  }

  bool draw_movables(int draw) {
    const std::size_t kept = fixtures_ + static_cast<std::size_t>(spec_.immovable) + 1;
    problem_.scene.objects.resize(kept);
    taken_.resize(kept - fixtures_);
    for (int k = 0; k < spec_.movable; ++k)
      if (!place("movable_" + std::to_string(k + 1), ObjectKind::movable, stream(Use::movables, draw, k))) return false;
    return true;
  }

  /// Shape and place are drawn together, so what fits easily comes more often where it is crowded, as published.
  bool place(const std::string& id, ObjectKind kind, RandomStream random) {
    for (int attempt = 0; attempt < kPlaceAttempts; ++attempt) {
      Object o = draw_object(random);
      const double x = random.uniform(kShelf.x[0], kShelf.x[1]), y = random.uniform(kShelf.y[0], kShelf.y[1]);
      const double yaw = random.uniform(0.0, 2 * std::numbers::pi);
      Footprint outline = footprint(o.shapes[0].shape, x, y, yaw);
      const auto outside = [](const Eigen::Vector2d& p) {
        return p.x() < kShelf.x[0] || p.x() > kShelf.x[1] - kGap || p.y() < kShelf.y[0] + kGap ||
               p.y() > kShelf.y[1] - kGap;
      };
      const auto too_close = [&](const Footprint& other) { return closer_than(outline, other, kGap); };
      if (std::any_of(outline.begin(), outline.end(), outside)) continue;
      if (std::any_of(taken_.begin(), taken_.end(), too_close)) continue;
      taken_.push_back(std::move(outline));
      o.id = id;
      o.kind = kind;
      o.X_WO.translation() = Eigen::Vector3d(x, y, kShelf.floor + height(o.shapes[0].shape) / 2);
      o.X_WO.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      o.constraints = io::default_constraints(spec_.profile, kind);
      problem_.scene.objects.push_back(std::move(o));
      return true;
    }
    return false;
  }

  static Object draw_object(RandomStream& random) {
    Object o;
    if (random.uniform() < 0.4) {
      const double a = std::max(0.06, random.uniform(0.0, 0.16)), b = std::max(0.06, random.uniform(0.0, 0.16));
      o.shapes = {{Box{{a, b, std::max(0.18, random.uniform(0.0, 0.31))}}, Eigen::Isometry3d::Identity()}};
    } else {
      const double radius = std::max(0.03, random.uniform(0.0, 0.08));
      o.shapes = {{Cylinder{radius, std::max(0.15, random.uniform(0.0, 0.20))}, Eigen::Isometry3d::Identity()}};
    }
    o.mass = std::max(kLeastMass, random.uniform(0.0, kMostMass));
    o.friction = random.uniform(kFriction[0], kFriction[1]);
    return o;
  }

  Problem finish(int in_the_way) {
    problem_.generated = {{"generator", "shelf"},
                          {"seed", std::to_string(spec_.seed)},
                          {"index", std::to_string(spec_.index)},
                          {"movable", std::to_string(spec_.movable)},
                          {"immovable", std::to_string(spec_.immovable)},
                          {"difficulty", std::string(to_string(difficulty_of(in_the_way)))},
                          {"movables_in_the_way", std::to_string(in_the_way)},
                          {"scene_redraws", std::to_string(redraws_ - 1)}};
    return std::move(problem_);
  }

  const ShelfSpec spec_;
  Problem problem_;
  std::size_t fixtures_ = 0;
  std::vector<Footprint> taken_;  // of what was placed, in order
  int scene_ = 0, redraws_ = 0;
};

}  // namespace

Result<Problem> generate_shelf(const ShelfSpec& spec) { return Generator(spec).run(); }

}  // namespace mamo
