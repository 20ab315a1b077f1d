// From what a URDF says to an arm that can plan: which joints plan, where it stands, how the rest is parked.
#pragma once

#include <Eigen/Geometry>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/io/load.hpp"

namespace mamo::io {

/// The choice a problem makes. The planning group is one of, in this order of precedence:
///  - `joints` (then `tip` is required; `base` defaults to the root link);
///  - `group` of `srdf` (`base` and `tip` override those of the group; a group without a chain takes as tip the
///    link behind its last joint);
///  - the movable joints between `base` (default: the root link) and `tip`.
/// Group joints end up in model order, base to tip, whatever order they were named in.
struct GroupSpec {
  std::string base, tip;
  std::vector<std::string> joints;
  std::string group;
  const Srdf* srdf = nullptr;                              // needed when `group` is given; outlives the call
  std::map<std::string, double> start;                     // rad or m, by joint; may name joints outside the group too
  std::map<std::string, double> fixed;                     // rad or m, joints outside the group
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  // root link in world
  double speed_scale = 0.1;                                // in (0, 1]
};

/// A robot ready to plan but for its self-collision pairs (choose_self_pairs, module collision). Joints without
/// a value stand at 0, moved into their limits. Errors are one line without a file name (unknown joints and links
/// with the nearest known name, values outside limits with the limits): the caller knows the file.
Result<Robot> make_robot(const RobotDescription& description, const GroupSpec& spec);

/// The disabled link pairs of an SRDF as ids of the model (first < second); unknown links are left out.
std::vector<std::pair<LinkId, LinkId>> disabled_links(const Srdf& srdf, const RobotModel& model);

}  // namespace mamo::io
