// The robot of a problem: what a file asks for, what the command line replaces, and the files it takes.
#pragma once

#include <map>
#include <string>

#include "io/strict_reader.hpp"
#include "mamo/io/load.hpp"
#include "mamo/io/robot_setup.hpp"

namespace mamo::io {

struct RobotRequest {
  std::string urdf, srdf;  // as they stand in the file: looked up by find_data_file
  std::map<std::string, std::string> package_path;
  GroupSpec spec;           // spec.srdf is filled in by install_robot
  std::string start_state;  // a group_state of the SRDF instead of spec.start
};

/// The map `robot` of a native file.
RobotRequest read_robot(const YamlValue& value, Complaints& complaints);

/// Loads the robot and puts it into the problem: robot, robot_files, q_start. `node` is where the file speaks of
/// its robot (null: nowhere). A replacing robot (--robot) keeps of the file's group and posture what fits it.
void install_robot(RobotRequest request, const LoadOptions& options, const YamlValue* node, Problem& problem,
                   Complaints& complaints);

}  // namespace mamo::io
