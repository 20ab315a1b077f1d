// Who plays which part: how each object is shown, where things happened, from where to look. Shared by page and
// picture.
#pragma once

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/view/playback.hpp"

namespace mamo::view {

struct StageObject {
  ObjectId id;
  std::string role;          // name of a colour: target, immovable, moved, relevant, movable, fixture
  bool see_through = false;  // a wall or a roof that would hide what matters
  int relevant = -1;         // when it became relevant, from 1
  bool touched = false;
};

/// Where a segment runs in the recording's time.
struct StageSegment {
  SegmentKind kind;
  ObjectId object;
  double begin_s = 0, end_s = 0;
};

struct Camera {
  Eigen::Vector3d target{0, 0, 0};              // world, m
  double yaw = 0, pitch = 0;                    // rad: from where it looks, as seen from the target
  double distance = 2;                          // m
  static constexpr double kFieldOfView = 0.61;  // rad, vertical
};

class Stage {
 public:
  explicit Stage(const Playback& playback);

  const Playback& playback() const { return playback_; }
  const Problem& problem() const { return *playback_.problem; }
  const ForwardKinematics& kinematics() const { return kinematics_; }
  const std::vector<StageObject>& objects() const { return objects_; }
  const std::vector<StageSegment>& segments() const { return segments_; }
  ObjectId target() const { return target_; }
  std::optional<Eigen::Isometry3d> goal() const;  // of the tip
  Camera camera() const;

  double duration_s() const { return playback_.recording ? playback_.recording->duration_s() : 0; }
  /// Configuration and object poses at a time of the recording (clamped); the start without one.
  Eigen::VectorXd q_at(double time_s) const;
  Eigen::Isometry3d X_WO_at(ObjectId id, double time_s) const;
  /// Where a violation happened: the contact, else the object; nothing when neither is known.
  std::optional<Eigen::Vector3d> place_of(const Violation& violation) const;

 private:
  bool moved(ObjectId id) const;
  Eigen::AlignedBox3d scene_bounds() const;

  Playback playback_;
  ForwardKinematics kinematics_;
  ObjectId target_ = kNoObject;
  std::vector<StageObject> objects_;
  std::vector<StageSegment> segments_;
};

}  // namespace mamo::view
