// What urdfdom would accept in silence or report without a line, found in the XML first.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/xml_file.hpp"

namespace mamo::io {

/// Lines of a URDF by name, for messages about what urdfdom parsed.
struct UrdfLines {
  std::map<std::string, int> links, joints;
};

/// Checks every <link> and <joint>: names, joint types, geometry kinds, all numbers finite and sizes positive,
/// parents, children and mimicked joints that exist, limits the right way round. The first problem in the file is
/// the error.
Result<UrdfLines> check_urdf(const XmlFile& file);

}  // namespace mamo::io
