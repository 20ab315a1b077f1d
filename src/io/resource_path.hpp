// Where the mesh of a robot lies: relative to the URDF, file://, package://.
#pragma once

#include <map>
#include <string>

#include "mamo/common/result.hpp"

namespace mamo::io {

/// The file that `uri`, found in `urdf_path`, means. Extensions match without case. Looked up in this order:
///  - absolute paths and file:// as they are; other paths relative to the URDF's folder;
///  - package://NAME/rest (and model://): `package_path[NAME]`, the folders of ROS_PACKAGE_PATH and
///    AMENT_PREFIX_PATH (D/NAME, D/share/NAME, D itself if it is called NAME), an ancestor folder of the URDF called
///    NAME, and last rest and NAME/rest beside the URDF.
/// The error lists every path tried; it has no file and line of its own.
Result<std::string> resolve_resource(const std::string& uri, const std::string& urdf_path,
                                     const std::map<std::string, std::string>& package_path);

}  // namespace mamo::io
