#include "io/shelf_scene.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "io/object_reader.hpp"
#include "io/robot_request.hpp"
#include "io/text.hpp"
#include "mamo/io/profile.hpp"

namespace mamo::io {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

Eigen::Matrix3d rotation(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// Hands out the lines one by one and knows their number.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  /// The next line that is not blank; false at the end.
  bool next(std::string_view& line) {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      line = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++number_;
      if (!line.empty()) return true;
    }
    return false;
  }
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// The goal line of the file: x, y, z and three angles of which only the heading has a meaning.
struct Goal {
  Eigen::Vector3d position;
  double yaw;
};

class ShelfReader {
 public:
  ShelfReader(const std::string& text, const LoadOptions& options, Problem& problem, Complaints& complaints)
      : lines_(text), options_(options), problem_(problem), complaints_(complaints) {}

  void run() {
    read_sections();
    if (complaints_.any()) return;
    if (!goal_) return fail("the file is truncated: it has no section G (the pre-grasp pose)");
    if (target_.empty()) return fail("the file is truncated: it has no section ooi (the object of interest)");
    install_pr2();
    if (!complaints_.any()) make_task();
  }

 private:
  void fail(const std::string& message) { complaints_.add(lines_.number(), 0, message); }
  void warn(const std::string& message) { complaints_.warn(lines_.number(), 0, message); }

  void read_sections() {
    problem_.profile = parse_profile(options_.constraints).value_or(Profile::full);
    std::string_view letter;
    while (!complaints_.any() && lines_.next(letter)) {
      if (letter == "A") return;  // from here on: recordings of an earlier planner
      if (letter == "O")
        read_objects_section();
      else if (letter == "R")
        read_base();
      else if (letter == "S")
        skip_start();
      else if (letter == "G")
        read_goal();
      else if (letter == "ooi")
        read_target();
      else
        fail("unknown section " + in_quotes(letter) + ", expected O, R, S, G, ooi or A");
    }
  }

  std::string_view need_line(const std::string& what) {
    std::string_view line;
    if (!lines_.next(line)) fail("the file is truncated: " + what + " was expected");
    return line;
  }

  int read_count(const std::string& what) {
    const std::string_view line = need_line("the number of " + what);
    const std::optional<double> n = parse_number(line);
    if (complaints_.any()) return 0;
    if (!n || !(*n >= 0 && *n <= 100000) || *n != std::floor(*n)) {
      fail("the number of " + what + " is " + in_quotes(line) + ", expected a whole number");
      return 0;
    }
    return static_cast<int>(*n);
  }

  static std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    for (;;) {
      const std::size_t comma = line.find(',');
      fields.push_back(trimmed(line.substr(0, comma)));
      if (comma == std::string_view::npos) return fields;
      line.remove_prefix(comma + 1);
    }
  }

  double field_number(std::string_view field, const std::string& what, const NumberRule& rule) {
    const std::optional<double> n = parse_number(field);
    if (n && std::isfinite(*n) && *n >= rule.least && *n <= rule.most) return *n;
    fail(what + " is " + in_quotes(field) + ", expected " + std::string(rule.words));
    return std::max(rule.least, 0.0);
  }

  void read_objects_section() {
    if (!problem_.scene.objects.empty()) return fail("a second section O");
    const int count = read_count("objects");
    for (int i = 0; i < count && !complaints_.any(); ++i) {
      const std::string_view line = need_line("object " + std::to_string(i + 1) + " of " + std::to_string(count));
      if (!complaints_.any()) read_object(line);
    }
  }

  /// id, shape, type, x, y, z, roll, pitch, yaw, sx, sy, sz, mass, mu, movable
  void read_object(std::string_view line) {
    const std::vector<std::string_view> f = fields_of(line);
    if (f.size() != 15)
      return fail("an object has " + std::to_string(f.size()) +
                  " fields, expected 15 (id,shape,type,x,y,z,roll,pitch,yaw,sx,sy,sz,mass,mu,movable)");
    Object object;
    object.id = std::string(f[0]);
    const std::string of = " of object " + in_quotes(object.id);
    if (object.id.empty()) return fail("an object has no id");
    if (!ids_.insert(object.id).second) return fail("a second object with the id " + in_quotes(object.id));
    std::array<double, 6> pose{};
    for (std::size_t i = 0; i < 6; ++i)
      pose[i] = field_number(f[3 + i], std::string(kPoseNames[i]) + of, i < 3 ? kCoordinate : kAnyNumber);
    object.X_WO.translation() = Eigen::Vector3d(pose[0], pose[1], pose[2]);
    object.X_WO.linear() = rotation(pose[3], pose[4], pose[5]);
    object.shapes = {{read_shape(f, of), Eigen::Isometry3d::Identity()}};
    object.mass = field_number(f[12], "mass" + of, {0, 1e6, false, "a finite mass (0: fixed)"});
    object.friction = field_number(f[13], "friction" + of, kFriction);
    read_kind(f, of, object);
    problem_.scene.objects.push_back(object);
  }

  /// Boxes give half sizes; cylinders (and spheres) the radius, cylinders then the full height.
  Shape read_shape(const std::vector<std::string_view>& f, const std::string& of) {
    const Eigen::Vector3d s(field_number(f[9], "sx" + of, kLength), field_number(f[10], "sy" + of, kLength),
                            field_number(f[11], "sz" + of, kLength));
    if (f[1] == "0") return Box{2 * s};
    if (f[1] != "1" && f[1] != "2")
      fail("shape" + of + " is " + in_quotes(f[1]) + ", expected 0 (box), 1 (sphere) or 2 (cylinder)");
    if (s.x() != s.y()) warn("sx and sy" + of + " differ though it is round: the larger one counts");
    const double radius = std::max(s.x(), s.y());
    if (f[1] == "1") return Sphere{radius};
    return Cylinder{radius, s.z()};
  }

  void read_kind(const std::vector<std::string_view>& f, const std::string& of, Object& object) {
    const bool movable = f[14] == "True" || f[14] == "true";
    if (!movable && f[14] != "False" && f[14] != "false")
      return fail("movable" + of + " is " + in_quotes(f[14]) + ", expected True or False");
    if (f[2] != "-1" && f[2] != "0" && f[2] != "1")
      return fail("type" + of + " is " + in_quotes(f[2]) + ", expected -1 (shelf), 0 (immovable) or 1 (movable)");
    if (f[2] != "-1" && movable != (f[2] == "1")) warn("type" + of + " says otherwise than movable: the latter counts");
    if (f[2] == "-1") {
      object.kind = ObjectKind::fixture;
      object.mass = 0;
    } else {
      object.kind = movable || made_movable(object.id, options_) ? ObjectKind::movable : ObjectKind::immovable;
    }
    if (object.movable() && object.mass <= 0) {
      if (!options_.default_mass) {
        warn("object " + in_quotes(object.id) + " is movable but has no mass: it stands still");
        object.kind = ObjectKind::immovable;
      }
      object.mass = options_.default_mass.value_or(0);
    }
    object.constraints = default_constraints(problem_.profile, object.kind);
    if (object.fixture() && object.id != "1")  // 1 is the floor of the shelf, the others its walls and top
      object.constraints.touch = problem_.profile == Profile::legacy ? Touch::objects : Touch::forbidden;
  }

  void read_base() {
    const std::vector<std::string_view> f = fields_of(need_line("the robot's base pose"));
    if (complaints_.any()) return;
    if (f.size() != 7) return fail("the robot's base pose needs 7 numbers (x,y,z,qx,qy,qz,qw)");
    std::array<double, 7> v{};
    for (std::size_t i = 0; i < 7; ++i) v[i] = field_number(f[i], "the robot's base pose", kCoordinate);
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (!(q.norm() > 1e-3)) return fail("the quaternion of the robot's base cannot be normalised");
    X_WB_.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
    X_WB_.linear() = q.normalized().toRotationMatrix();
  }

  /// The published planner ignored this section, and so does this one: the start is the home configuration.
  void skip_start() {
    const int count = read_count("joints");
    for (int i = 0; i < count && !complaints_.any(); ++i) need_line("joint " + std::to_string(i + 1));
  }

  void read_goal() {
    const std::vector<std::string_view> f = fields_of(need_line("the pre-grasp pose"));
    if (complaints_.any()) return;
    if (f.size() != 6) return fail("the pre-grasp pose needs 6 numbers (x,y,z,yaw,pitch,roll)");
    std::array<double, 6> v{};
    for (std::size_t i = 0; i < 6; ++i)
      v[i] = field_number(f[i], "the pre-grasp pose", i < 3 ? kCoordinate : kAnyNumber);
    // Where the recorded Euler angles flipped (roll and pitch about pi), the heading is yaw + pi.
    const bool flipped = std::abs(v[5]) > 1e-4;
    goal_ = Goal{Eigen::Vector3d(v[0], v[1], v[2]), flipped ? v[3] + std::numbers::pi : v[3]};
  }

  void read_target() { target_ = std::string(need_line("the id of the object of interest")); }

  void install_pr2() {
    RobotRequest request;
    request.urdf = "robots/pr2_right_arm.urdf";
    request.srdf = "robots/pr2_right_arm.srdf";
    GroupSpec& spec = request.spec;
    spec.base = "base_footprint";
    spec.tip = "r_gripper_finger_dummy_planning_link";
    spec.X_WB = X_WB_;
    for (std::size_t i = 0; i < kArm.size(); ++i) {
      spec.joints.push_back("r_" + std::string(kArm[i]) + "_joint");
      spec.start[spec.joints.back()] = kHome[i];
      spec.fixed["l_" + std::string(kArm[i]) + "_joint"] = kParked[i];
    }
    spec.fixed["torso_lift_joint"] = 0.1;
    spec.fixed["r_gripper_l_finger_joint"] = 0.2;
    install_robot(std::move(request), options_, nullptr, problem_, complaints_);
  }

  void make_task() {
    Retrieve retrieve;
    retrieve.object = problem_.scene.find(target_);
    if (!retrieve.object.valid()) return fail("the object of interest " + in_quotes(target_) + " is not among the objects");
    const Object& target = problem_.scene[retrieve.object];
    if (target.fixture()) return fail("the object of interest " + in_quotes(target_) + " is a part of the shelf");
    if (target.movable()) warn("the object of interest " + in_quotes(target_) + " is movable");
    retrieve.X_WT_pregrasp.translation() = goal_->position;
    retrieve.X_WT_pregrasp.linear() = rotation(0, 0, goal_->yaw);
    retrieve.home = problem_.q_start;
    const double away = (goal_->position - target.X_WO.translation()).head<2>().norm();
    if (away > kUsualDistance)
      warn("the pre-grasp pose is " + shortest_number(std::round(away * 1000) / 1000) +
           " m from the object of interest (plan view), usually it is within " + shortest_number(kUsualDistance) + " m");
    problem_.task = retrieve;
  }

  static constexpr std::array<std::string_view, 6> kPoseNames = {"x", "y", "z", "roll", "pitch", "yaw"};
  static constexpr std::array<std::string_view, 7> kArm = {"shoulder_pan", "shoulder_lift", "upper_arm_roll", "elbow_flex",
                                                           "forearm_roll", "wrist_flex",    "wrist_roll"};
  static constexpr std::array<double, 7> kHome = {-1.68651, -0.184315, -1.67611, -1.66215, 0.285096, -0.658798, 1.41563};
  static constexpr std::array<double, 7> kParked = {
      std::numbers::pi / 2, std::numbers::pi / 2, 0, -std::numbers::pi / 4, 0, 0, 0};
  static constexpr double kUsualDistance = 0.12;  // m

  Lines lines_;
  const LoadOptions& options_;
  Problem& problem_;
  Complaints& complaints_;
  std::set<std::string> ids_;
  Eigen::Isometry3d X_WB_ = Eigen::Isometry3d::Identity();
  std::optional<Goal> goal_;
  std::string target_;
};

}  // namespace

bool looks_like_shelf_scene(const std::string& text) {
  Lines lines(text);
  std::string_view first;
  return lines.next(first) && first == "O";
}

void read_shelf_scene(const std::string& text, const LoadOptions& options, Problem& problem, Complaints& complaints) {
  ShelfReader(text, options, problem, complaints).run();
}

}  // namespace mamo::io
