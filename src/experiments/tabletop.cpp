#include "mamo/experiments/tabletop.hpp"

#include <numbers>

#include "experiments/footprint.hpp"
#include "experiments/shipped_robot.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/common/random.hpp"
#include "mamo/experiments/household.hpp"
#include "mamo/io/profile.hpp"
#include "mamo/kinematics/inverse_kinematics.hpp"

namespace mamo {
namespace {

// World: the robot's base at the origin, x forward, y left, z up. Seen from above (m):
//
//      y  0.40 +---------------+
//              |  . . . . . .  |     strip of objects: x 0.52 .. 0.88, centred at y = -0.25,
//   robot      |  . objects .  |     as wide as their number asks for
//   x = 0      |  . . . . . .  |
//        -0.80 +---------------+
//            0.45            1.05 x
constexpr double kTableTop = 0.72, kTableThickness = 0.04;
constexpr double kTableFront = 0.45, kTableDepth = 0.60, kTableMiddle = -0.20, kTableWidth = 1.20;
constexpr double kStripX[2] = {0.52, 0.88}, kStripMiddle = -0.25;
constexpr double kAreaPerObject = 0.028;          // m^2
constexpr double kStripWidth[2] = {0.30, 1.00};   // least and most
constexpr double kGap = 0.008;                    // m between objects
constexpr double kShoulder[2] = {-0.05, -0.188};  // axis of the shoulder's pan joint
constexpr int kMostObjects = 60;
constexpr int kPlaceAttempts = 400;  // per object
constexpr int kGoalsPerScene = 60, kScenes = 50;
constexpr std::uint64_t kStreamKey = 0x7461626c65;  // "table"
enum class Use : std::uint64_t { items, places, goal };

class Generator {
 public:
  explicit Generator(const TabletopSpec& spec) : spec_(spec) {}

  Result<Problem> run() {
    if (spec_.movable < 0 || spec_.immovable < 0 || spec_.movable + spec_.immovable > kMostObjects || spec_.index < 0)
      return Error{"tabletop: at most " + std::to_string(kMostObjects) + " objects, counts and index not negative",
                   ErrorKind::usage};
    problem_.name = "tabletop-" + std::to_string(spec_.seed) + "-" + std::to_string(spec_.index) + ".yaml";
    problem_.path = problem_.name;
    problem_.profile = spec_.profile;
    if (Status s = install_shipped_pr2(problem_, "r_gripper_tool_frame"); !s) return s.error();
    kinematics_ = std::make_shared<ForwardKinematics>(problem_.robot);
    bool placed_once = false;
    for (scene_attempt_ = 0; scene_attempt_ < kScenes; ++scene_attempt_) {
      if (!draw_scene()) continue;
      placed_once = true;
      if (draw_goal()) return finish();
    }
    if (!placed_once)
      return Error{"tabletop: no room for " + std::to_string(spec_.movable + spec_.immovable) + " objects on the table",
                   ErrorKind::usage};
    return Error{"tabletop: no reachable goal in " + std::to_string(kScenes) + " scenes (seed " +
                     std::to_string(spec_.seed) + ", index " + std::to_string(spec_.index) + ")",
                 ErrorKind::internal};
  }

 private:
  /// Streams do not depend on what other streams drew.
  RandomStream stream(Use use, int which) const {
    return RandomStream(spec_.seed,
                        {kStreamKey, static_cast<std::uint64_t>(spec_.index), static_cast<std::uint64_t>(use),
                         static_cast<std::uint64_t>(scene_attempt_), static_cast<std::uint64_t>(which)});
  }

  static Object table() {
    Object o;
    o.id = "table";
    o.kind = ObjectKind::fixture;
    o.shapes = {{Box{{kTableDepth, kTableWidth, kTableThickness}}, Eigen::Isometry3d::Identity()}};
    o.X_WO.translation() =
        Eigen::Vector3d(kTableFront + kTableDepth / 2, kTableMiddle, kTableTop - kTableThickness / 2);
    o.friction = 0.8;
    return o;
  }

  /// False when an object found no place, or the arm at home hits something.
  bool draw_scene() {
    Scene& scene = problem_.scene;
    scene.objects = {table()};
    scene.objects[0].constraints = io::default_constraints(spec_.profile, ObjectKind::fixture);
    const int count = spec_.movable + spec_.immovable;
    const double depth = kStripX[1] - kStripX[0];
    const double width = std::clamp(count * kAreaPerObject / depth, kStripWidth[0], kStripWidth[1]);
    std::vector<Footprint> taken;
    for (int k = 0; k < count; ++k)
      if (!place(k, width, taken)) return false;
    checker_ = std::make_unique<CollisionChecker>(kinematics_, scene);
    ObjectSet everything(scene.size());
    for (std::size_t i = 0; i < scene.size(); ++i) everything.insert(ObjectId(i));
    checker_->check(problem_.q_start, everything, true, report_);
    return report_.free();
  }

  bool place(int k, double width, std::vector<Footprint>& taken) {
    const auto items = household_items();
    const HouseholdItem& item = items[stream(Use::items, k).below(items.size())];
    RandomStream random = stream(Use::places, k);
    for (int attempt = 0; attempt < kPlaceAttempts; ++attempt) {
      const double x = random.uniform(kStripX[0], kStripX[1]);
      const double y = kStripMiddle + random.uniform(-width / 2, width / 2);
      const double yaw = random.uniform(-std::numbers::pi, std::numbers::pi);
      Footprint outline = footprint(item.shape, x, y, yaw);
      const auto too_close = [&](const Footprint& other) { return closer_than(outline, other, kGap); };
      if (std::any_of(taken.begin(), taken.end(), too_close)) continue;
      taken.push_back(std::move(outline));
      problem_.scene.objects.push_back(stand(item, k, x, y, yaw));
      return true;
    }
    return false;
  }

  Object stand(const HouseholdItem& item, int k, double x, double y, double yaw) const {
    Object o;
    o.id = std::string(item.name) + "_" + std::to_string(k + 1);
    o.kind = k < spec_.movable ? ObjectKind::movable : ObjectKind::immovable;
    o.shapes = {{item.shape, Eigen::Isometry3d::Identity()}};
    o.X_WO.translation() = Eigen::Vector3d(x, y, kTableTop + height(item.shape) / 2);
    o.X_WO.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    o.mass = item.mass;
    o.friction = item.friction;
    o.constraints = io::default_constraints(spec_.profile, o.kind);
    return o;
  }

  bool draw_goal() {
    ObjectSet walls = ObjectSet::of_kind(problem_.scene, ObjectKind::immovable);
    walls.insert(ObjectId(0));
    const InverseKinematics inverse(*kinematics_);
    for (int attempt = 0; attempt < kGoalsPerScene; ++attempt) {
      const Eigen::Isometry3d X_WT = goal_pose(attempt);
      // As planners check an edge: a goal that is free by less is none to them.
      const auto is_free = [&](const Eigen::VectorXd& q) { return checker_->check_edge(q, q, walls, {}, report_); };
      IkOptions options;
      options.starts *= 2;
      if (!inverse.solve_many(X_WT, problem_.q_start, 1, 1, options, is_free).empty()) {
        ReachPose task;
        task.X_WT = X_WT;
        problem_.task = task;
        return true;
      }
      ++goal_redraws_;
    }
    return false;
  }

  Eigen::Isometry3d goal_pose(int attempt) const {
    RandomStream random = stream(Use::goal, attempt);
    // A point between three objects, uniform in their triangle; the strip's middle when there are none.
    Eigen::Vector2d p((kStripX[0] + kStripX[1]) / 2, kStripMiddle);
    if (const std::size_t n = problem_.scene.size() - 1; n > 0) {
      Eigen::Vector2d corner[3];
      for (Eigen::Vector2d& c : corner) c = problem_.scene.objects[1 + random.below(n)].X_WO.translation().head<2>();
      const double a = std::sqrt(random.uniform()), b = random.uniform();
      p = (1 - a) * corner[0] + a * (1 - b) * corner[1] + a * b * corner[2];
    }
    const double ahead = std::atan2(p.y() - kShoulder[1], p.x() - kShoulder[0]);
    Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
    X_WT.translation() = Eigen::Vector3d(p.x(), p.y(), kTableTop + random.uniform(0.05, 0.12));
    X_WT.linear() = (Eigen::AngleAxisd(ahead + random.uniform(-0.6, 0.6), Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(random.uniform(0.0, 0.5), Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(random.uniform(-0.5, 0.5) * std::numbers::pi, Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
    return X_WT;
  }

  Problem finish() {
    problem_.generated = {{"generator", "tabletop"},
                          {"seed", std::to_string(spec_.seed)},
                          {"index", std::to_string(spec_.index)},
                          {"movable", std::to_string(spec_.movable)},
                          {"immovable", std::to_string(spec_.immovable)},
                          {"goal_redraws", std::to_string(goal_redraws_)},
                          {"scene_redraws", std::to_string(scene_attempt_)},
                          {"goal_needs_contact", goal_needs_contact(problem_) ? "yes" : "unknown"}};
    return std::move(problem_);
  }

  const TabletopSpec spec_;
  Problem problem_;
  std::shared_ptr<const ForwardKinematics> kinematics_;
  std::unique_ptr<CollisionChecker> checker_;  // of the scene being drawn
  CollisionReport report_;
  int scene_attempt_ = 0, goal_redraws_ = 0;
};

}  // namespace

Result<Problem> generate_tabletop(const TabletopSpec& spec) { return Generator(spec).run(); }

}  // namespace mamo
