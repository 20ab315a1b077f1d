// Files in, immutable models out. Every failure is one line with its place.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/model/plan.hpp"
#include "mamo/model/problem.hpp"

namespace mamo::io {

/// File options of the command line (INTERFACE: --robot, --srdf, --package-path, --request, --task, ...).
struct LoadOptions {
  std::string robot;                                // URDF that replaces the problem's own
  std::string srdf;
  std::string base, tip, group;                     // of the replacing robot
  std::map<std::string, std::string> package_path;  // NAME -> DIR
  std::string request;                              // MotionBenchMaker request file (not read yet)
  std::string task;                                 // "", "reach" or "retrieve"
  std::vector<std::string> movable;                 // globs of object ids to make movable
  std::optional<double> default_mass, default_friction;
  std::string constraints;  // profile that replaces the file's; on a shelf scene "legacy" also opens the walls
};

/// What a URDF says, before a group is chosen. Mesh shapes are hulls already.
struct RobotDescription {
  std::shared_ptr<const RobotModel> model;
  std::vector<std::string> warnings;
};
Result<RobotDescription> load_urdf(const std::string& path, const std::map<std::string, std::string>& package_path);

struct SrdfGroup {
  std::string name;
  std::string base, tip;            // of a chain; else empty
  std::vector<std::string> joints;  // resolved against the model, in model order
};
struct Srdf {
  std::vector<SrdfGroup> groups;
  std::map<std::string, std::map<std::string, double>> states;  // group_state name -> joint -> value
  std::vector<std::pair<std::string, std::string>> disabled;    // link pairs
};
Result<Srdf> load_srdf(const std::string& path, const RobotModel& model);

/// Any problem file, recognised by its content. Checks everything INTERFACE lists under exit code 3 that needs
/// no collision checker: a start in collision and overlapping objects are model checks of planners/validate.
Result<Problem> load_problem(const std::string& path, const LoadOptions& options = {});

/// A result object or its bare plan (JSON).
Result<Plan> load_plan(const std::string& path, const Problem& problem);
/// The same with how the run went (status, reason, most counters, notes), for people to look at. A run that found no
/// plan is no error here; a bare plan counts as solved.
Result<PlanResult> load_result(const std::string& path, const Problem& problem);

/// The native problem file (YAML) of a problem; the inverse of load_problem.
Result<std::string> to_native_yaml(const Problem& problem);
/// The result object of INTERFACE ("mamo-result/1") and the verdict ("mamo-verdict/1") are in io/result_json.hpp.

/// Writes a whole file or nothing (temporary beside it, then rename). Error kind: output.
Status write_file(const std::string& path, const std::string& content);
/// Can `path` be written? Tested before planning starts. Leaves nothing behind.
Status check_writable(const std::string& path);
/// The whole file, at most max_bytes. Errors name the path: missing, a folder, too large, unreadable.
Result<std::string> read_file(const std::string& path, std::size_t max_bytes = 64u << 20);

/// Where relative paths are looked up (INTERFACE): the file's folder, MAMO_DATA_DIR, bench/data, share/mamo.
Result<std::string> find_data_file(const std::string& relative, const std::string& beside_file);

}  // namespace mamo::io
