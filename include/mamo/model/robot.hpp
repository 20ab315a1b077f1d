// An arm as the planners see it: a tree of links from URDF, a group of joints that plan, the rest parked.
#pragma once

#include <Eigen/Geometry>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mamo/common/ids.hpp"
#include "mamo/model/shape.hpp"

namespace mamo {

enum class JointType { fixed, revolute, continuous, prismatic };

/// value = multiplier * value(joint) + offset. Chains are resolved by the loader: `joint` mimics nothing.
struct Mimic {
  JointId joint;
  double multiplier = 1;
  double offset = 0;
};

struct Joint {
  std::string name;
  JointType type = JointType::fixed;
  LinkId parent, child;
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();   // joint frame in parent link at value 0
  Eigen::Vector3d axis{1, 0, 0};                            // unit, in the joint frame
  double lower = -std::numeric_limits<double>::infinity();  // rad or m; infinite for continuous
  double upper = std::numeric_limits<double>::infinity();
  double max_velocity = 1.0;  // rad/s or m/s
  std::optional<Mimic> mimic;
  int variable = -1;  // index into a full joint vector; -1 for fixed and mimic joints
};

/// What a link looks like; only view and export read it. Either a primitive or a mesh file.
struct VisualGeometry {
  std::optional<Shape> shape;
  std::string mesh_path;  // resolved, empty if the shape is a primitive or the file was not found
  Eigen::Vector3d scale{1, 1, 1};
  Eigen::Isometry3d X_LV = Eigen::Isometry3d::Identity();
  Eigen::Vector4d rgba{0.7, 0.7, 0.7, 1.0};
};

struct Link {
  std::string name;
  JointId parent_joint{-1};  // invalid for the root
  std::vector<PlacedShape> collision;
  std::vector<VisualGeometry> visual;
  double mass = 0;  // kg; 0 when the URDF gives none (the arm is kinematic: only export needs it)
};

/// Immutable tree. Links and joints are in topological order: a parent comes before its children,
/// links[0] is the root, and joints[i] moves links[i + 1].
struct RobotModel {
  std::string name;
  std::string source;  // path of the URDF
  std::vector<Link> links;
  std::vector<Joint> joints;
  int variables = 0;                    // size of a full joint vector
  std::vector<JointId> variable_joint;  // joint of each variable

  /// Invalid id when there is none of that name.
  LinkId find_link(const std::string& name) const;
  JointId find_joint(const std::string& name) const;
};

/// The joints that plan, base to tip, and the link that is sent to a pose.
struct PlanningGroup {
  std::vector<JointId> joints;  // neither fixed nor mimic
  LinkId base, tip;
};

/// A robot placed in the world, ready to plan. A configuration q has one value per group joint (rad or m).
struct Robot {
  std::shared_ptr<const RobotModel> model;
  PlanningGroup group;
  Eigen::VectorXd posture;                                 // full joint vector; group entries are those of the start
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  // root link in world
  double speed_scale = 0.1;                                // of the velocity limits
  /// Pairs of links to test against each other (first < second), after SRDF or sampling.
  std::vector<std::pair<LinkId, LinkId>> self_pairs;
  /// Pairs that were disabled because they always collide when sampled or collide at the start; printed.
  std::vector<std::pair<LinkId, LinkId>> disabled_pairs;

  int dof() const { return static_cast<int>(group.joints.size()); }
  const Joint& joint(int i) const { return model->joints[group.joints[static_cast<std::size_t>(i)].index()]; }
  /// Group part of a full joint vector, and a full vector with the group part replaced.
  Eigen::VectorXd group_part(const Eigen::VectorXd& full) const;
  Eigen::VectorXd with_group(const Eigen::VectorXd& q) const;
  /// Within the limits of every group joint, with a slack in rad or m. No NaN.
  bool within_limits(const Eigen::VectorXd& q, double slack = 1e-9) const;
  /// Links that move when a group joint moves (mimic joints included), in model order.
  std::vector<bool> moving_links() const;
};

}  // namespace mamo
