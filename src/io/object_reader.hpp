// Objects and their constraints, out of the native problem file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/strict_reader.hpp"
#include "mamo/io/load.hpp"

namespace mamo::io {

/// What the objects of one file have in common.
struct ObjectContext {
  const LoadOptions& options;
  std::string path;                                 // of the problem file
  std::map<std::string, std::string> package_path;  // of its robot, for package:// meshes
  Profile profile = Profile::contact_only;
  const YamlValue* common = nullptr;  // the file's `constraints`, for every movable
};

/// The profile a file asks for: its own `constraints: {profile: ...}` unless the options replace it. Checks the
/// whole map.
Profile read_profile(const YamlValue* constraints, const LoadOptions& options, Complaints& complaints);

/// The list `objects`, in file order. Duplicate ids are complaints.
std::vector<Object> read_objects(const YamlValue& list, const ObjectContext& context, Complaints& complaints);

/// Does one of the globs of LoadOptions::movable match?
bool made_movable(const std::string& id, const LoadOptions& options);

}  // namespace mamo::io
