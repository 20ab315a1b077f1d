// Typed reading of a YAML tree: every value is asked for by name, every surprise is a complaint with its
// place. The first complaint counts; after one the readers go on and return harmless values.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mamo/common/result.hpp"
#include "mamo/io/yaml_tree.hpp"

namespace mamo::io {

/// The first thing that is wrong with a file, and what was repaired.
class Complaints {
 public:
  explicit Complaints(std::string file) : file_(std::move(file)) {}
  void add(int line, int column, const std::string& message);
  void add(const YamlValue& at, const std::string& message) { add(at.line, at.column, message); }
  void add(Error error) {
    if (!first_) first_ = std::move(error);
  }
  void warn(int line, int column, const std::string& message);
  void warn(const YamlValue& at, const std::string& message) { warn(at.line, at.column, message); }

  bool any() const { return first_.has_value(); }
  const Error& first() const { return *first_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::optional<Error> first_;
  std::vector<std::string> warnings_;
};

/// What a number must be; the defaults allow any finite number.
struct NumberRule {
  double least = -std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::max();
  bool infinite_allowed = false;
  std::string_view words = "a finite number";  // "... must be <words>"
};
inline constexpr NumberRule kAnyNumber{};
/// Smaller than a hundredth of a millimetre is as good as zero, larger than a kilometre is no scene.
inline constexpr NumberRule kLength{1e-5, 1e3, false, "a positive length (1e-5 to 1000 m)"};
inline constexpr NumberRule kCoordinate{-1e3, 1e3, false, "a finite coordinate (within 1000 m)"};
inline constexpr NumberRule kMass{1e-6, 1e6, false, "a positive finite mass (1e-6 to 1e6 kg)"};
inline constexpr NumberRule kFriction{0, 100, false, "a friction coefficient (0 to 100)"};
inline constexpr NumberRule kLimit{0, std::numeric_limits<double>::max(), true, "0 or more (.inf: no limit)"};

double read_number(const YamlValue& value, const std::string& what, const NumberRule& rule, Complaints& complaints);
bool read_truth(const YamlValue& value, const std::string& what, Complaints& complaints);
std::string read_text(const YamlValue& value, const std::string& what, Complaints& complaints);
/// Exactly `count` numbers; zeros after a complaint.
Eigen::VectorXd read_numbers(const YamlValue& value, Eigen::Index count, const std::string& what,
                             const NumberRule& rule, Complaints& complaints);
/// {position: [x, y, z], quaternion: [x, y, z, w] | rpy: [r, p, y] | rpy_deg: [...]}; no orientation: identity.
Eigen::Isometry3d read_pose(const YamlValue& value, const std::string& what, Complaints& complaints);

/// A map whose keys must all be known; an unknown one is a complaint that names the nearest.
class StrictMap {
 public:
  StrictMap(const YamlValue& value, std::string what, std::vector<std::string> known, Complaints& complaints);

  const YamlValue& value() const { return value_; }
  const std::string& what() const { return what_; }
  /// Null when absent.
  const YamlValue* find(std::string_view key) const { return value_.find(key); }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Complains when absent, and returns an empty value that stands where the map stands.
  const YamlValue& need(std::string_view key);

  double number(std::string_view key, double fallback, const NumberRule& rule);
  double need_number(std::string_view key, const NumberRule& rule);
  bool truth(std::string_view key, bool fallback);
  std::string text(std::string_view key, const std::string& fallback = "");
  std::string need_text(std::string_view key);
  /// "mass of object 'cup'"
  std::string name_of(std::string_view key) const { return std::string(key) + " of " + what_; }
  void complain(const std::string& message) { complaints_.add(value_, message); }

 private:
  const YamlValue& value_;
  std::string what_;
  Complaints& complaints_;
  YamlValue missing_;
};

}  // namespace mamo::io
