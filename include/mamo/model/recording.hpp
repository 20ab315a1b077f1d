// A replay as plain data: what moved when, and who touched whom where. Made by verify, shown by view.
#pragma once

#include <Eigen/Geometry>

#include <map>
#include <vector>

#include "mamo/common/ids.hpp"

namespace mamo {

/// Sampled at whole physics steps, about every kRecordingStep seconds, from the plan's start to rest or to the first
/// violation; the last sample is where the replay ended. Every list of a track has one entry per sample.
struct Recording {
  /// An object that did not stay exactly where it began.
  struct Track {
    std::vector<Eigen::Isometry3d> X_WO;
    std::vector<double> tilt;   // rad, of the axis that was up at the start; the most since the sample before
    std::vector<double> speed;  // m/s, of the centre of mass; the most since the sample before
  };
  /// Two bodies that touched without a pause, one of them driven by the robot: a == kRobot, or two objects, a < b.
  /// A fixture stands here only if the robot touched it. The held object counts as robot.
  struct Contact {
    ObjectId a, b;
    double begin_s = 0, end_s = 0;
    double depth = 0;              // m, the deepest penetration
    Eigen::Vector3d p_W{0, 0, 0};  // where they first touched
  };

  std::vector<double> t;           // s
  std::vector<Eigen::VectorXd> q;  // group joints
  std::map<ObjectId, Track> tracks;
  std::vector<Contact> contacts;  // sorted by (begin, a, b)
  double grasped_s = -1;          // when the retrieved object was attached; negative: never

  bool empty() const { return t.empty(); }
  double duration_s() const { return t.empty() ? 0.0 : t.back(); }
};

inline constexpr double kRecordingStep = 1.0 / 30.0;  // s

}  // namespace mamo
