// A query: robot, scene, start, task. Made by io, immutable afterwards, shared by planners and verify.
#pragma once

#include <Eigen/Geometry>

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "mamo/model/robot.hpp"
#include "mamo/model/scene.hpp"

namespace mamo {

/// Bring the tip link to a pose. Tolerances: position m (norm), angle rad (of the relative rotation).
struct ReachPose {
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  double position_tolerance = 0.01;
  double angle_tolerance = 0.05;
  ObjectId target = kNoObject;  // the object the pose is for; it must not be touched
};
/// Bring the group joints to a configuration (rad or m), each within the tolerance.
struct ReachJoints {
  Eigen::VectorXd q;
  double tolerance = 0.0175;
};
/// Grasp an object and bring it home. E-M4M's problem.
struct Retrieve {
  ObjectId object;
  Eigen::Isometry3d X_WT_pregrasp = Eigen::Isometry3d::Identity();  // of the tip link
  Eigen::VectorXd home;                                             // group joints
  double home_tolerance = 0.0175;                                   // rad
};
using Task = std::variant<ReachPose, ReachJoints, Retrieve>;

enum class Profile { contact_only, full, legacy };
std::string_view to_string(Profile profile);

/// Where the robot came from, so that a problem can be written down again, and what its SRDF disables.
struct RobotFiles {
  std::string urdf, srdf;                           // paths as found; no SRDF: empty
  std::map<std::string, std::string> package_path;  // NAME -> DIR
  std::vector<std::pair<LinkId, LinkId>> disabled;  // by the SRDF, first < second
};

struct Problem {
  std::string name;    // file name without folder
  std::string path;    // as given
  std::string sha256;  // of the file's bytes, 64 hex digits
  Robot robot;
  RobotFiles robot_files;
  Scene scene;
  Eigen::VectorXd q_start;  // group joints
  Task task;
  Profile profile = Profile::contact_only;
  std::map<std::string, std::string> generated;  // what the generator noted (redraws, seed, ...)
  std::vector<std::string> warnings;             // what was ignored or repaired while loading
};

}  // namespace mamo
