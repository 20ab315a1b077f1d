#include "io/strict_reader.hpp"

#include <cmath>
#include <numbers>

#include "io/text.hpp"

#include "mamo/common/nearest_name.hpp"

namespace mamo::io {
namespace {

std::string kind_of(const YamlValue& value) {
  switch (value.kind) {
    case YamlValue::Kind::null:
      return "nothing";
    case YamlValue::Kind::scalar:
      return in_quotes(value.scalar);
    case YamlValue::Kind::list:
      return "a list";
    case YamlValue::Kind::map:
      return "a map";
  }
  return "something else";
}

Eigen::Matrix3d rotation_of_rpy(const Eigen::Vector3d& rpy) {
  // Fixed axes: roll about x first, then pitch about y, then yaw about z.
  return (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Matrix3d read_quaternion(const YamlValue& value, const std::string& what, Complaints& complaints) {
  const Eigen::VectorXd v = read_numbers(value, 4, what, kAnyNumber, complaints);
  if (complaints.any()) return Eigen::Matrix3d::Identity();
  const double norm = v.norm();
  if (!(norm > 1e-3 && norm < 1e3)) {
    complaints.add(value,
                   what + " cannot be normalised (norm " + shortest_number(norm) + "), expected x y z w of norm 1");
    return Eigen::Matrix3d::Identity();
  }
  if (std::abs(norm - 1) > 1e-3)
    complaints.warn(value, what + " has norm " + shortest_number(norm) + " and was normalised");
  return Eigen::Quaterniond(v[3], v[0], v[1], v[2]).normalized().toRotationMatrix();
}

}  // namespace

void Complaints::add(int line, int column, const std::string& message) {
  if (!first_) first_ = error_at(file_, line, column, message);
}

void Complaints::warn(int line, int column, const std::string& message) {
  warnings_.push_back(error_at(file_, line, column, message).message);
}

double read_number(const YamlValue& value, const std::string& what, const NumberRule& rule, Complaints& complaints) {
  const double harmless = std::max(rule.least, std::min(rule.most, 1.0));
  const std::optional<double> number = value.is_scalar() ? parse_number(value.scalar) : std::nullopt;
  if (!number) {
    complaints.add(value, what + " is " + kind_of(value) + ", expected a number");
    return harmless;
  }
  const bool infinite = std::isinf(*number);
  const bool good = infinite ? rule.infinite_allowed && *number > 0 : *number >= rule.least && *number <= rule.most;
  if (good) return *number;
  complaints.add(value, what + " is " + one_line(value.scalar) + ", must be " + std::string(rule.words));
  return harmless;
}

bool read_truth(const YamlValue& value, const std::string& what, Complaints& complaints) {
  if (value.is_scalar() && !value.quoted) {
    if (value.scalar == "true" || value.scalar == "True" || value.scalar == "TRUE") return true;
    if (value.scalar == "false" || value.scalar == "False" || value.scalar == "FALSE") return false;
  }
  complaints.add(value, what + " is " + kind_of(value) + ", expected true or false");
  return false;
}

std::string read_text(const YamlValue& value, const std::string& what, Complaints& complaints) {
  if (value.is_scalar() && !value.scalar.empty()) return value.scalar;
  complaints.add(value, what + " is " + kind_of(value) + ", expected a name");
  return {};
}

Eigen::VectorXd read_numbers(const YamlValue& value, Eigen::Index count, const std::string& what,
                             const NumberRule& rule, Complaints& complaints) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(count);
  if (!value.is_list() || static_cast<Eigen::Index>(value.items.size()) != count) {
    const std::string found = value.is_list() ? "a list of " + std::to_string(value.items.size()) : kind_of(value);
    complaints.add(value, what + " is " + found + ", expected a list of " + std::to_string(count) + " numbers");
    return out;
  }
  for (Eigen::Index i = 0; i < count; ++i)
    out[i] =
        read_number(value.items[static_cast<std::size_t>(i)], what + "[" + std::to_string(i) + "]", rule, complaints);
  return out;
}

Eigen::Isometry3d read_pose(const YamlValue& value, const std::string& what, Complaints& complaints) {
  StrictMap map(value, what, {"position", "quaternion", "rpy", "rpy_deg"}, complaints);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = read_numbers(map.need("position"), 3, map.name_of("position"), kCoordinate, complaints);
  if (map.has("quaternion") + map.has("rpy") + map.has("rpy_deg") > 1)
    map.complain(what + " gives its orientation twice, expected one of quaternion, rpy, rpy_deg");
  if (const YamlValue* q = map.find("quaternion"))
    X.linear() = read_quaternion(*q, map.name_of("quaternion"), complaints);
  if (const YamlValue* rpy = map.find("rpy"))
    X.linear() = rotation_of_rpy(read_numbers(*rpy, 3, map.name_of("rpy"), kAnyNumber, complaints));
  if (const YamlValue* rpy = map.find("rpy_deg"))
    X.linear() = rotation_of_rpy(read_numbers(*rpy, 3, map.name_of("rpy_deg"), kAnyNumber, complaints) *
                                 (std::numbers::pi / 180));
  return X;
}

StrictMap::StrictMap(const YamlValue& value, std::string what, std::vector<std::string> known, Complaints& complaints)
    : value_(value), what_(std::move(what)), complaints_(complaints) {
  missing_.line = value.line;
  missing_.column = value.column;
  if (!value.is_map()) {
    complaints.add(value, what_ + " is " + kind_of(value) + ", expected a map");
    return;
  }
  for (const YamlMember& member : value.members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      complaints.add(member.line, member.column,
                     "unknown key " + in_quotes(member.key) + " of " + what_ + ", the nearest known key is " +
                         in_quotes(nearest_name(member.key, known)));
}

const YamlValue& StrictMap::need(std::string_view key) {
  if (const YamlValue* found = find(key)) return *found;
  complaints_.add(value_, what_ + " misses the key " + in_quotes(key));
  return missing_;
}

double StrictMap::number(std::string_view key, double fallback, const NumberRule& rule) {
  const YamlValue* found = find(key);
  return found ? read_number(*found, name_of(key), rule, complaints_) : fallback;
}

double StrictMap::need_number(std::string_view key, const NumberRule& rule) {
  return read_number(need(key), name_of(key), rule, complaints_);
}

bool StrictMap::truth(std::string_view key, bool fallback) {
  const YamlValue* found = find(key);
  return found ? read_truth(*found, name_of(key), complaints_) : fallback;
}

std::string StrictMap::text(std::string_view key, const std::string& fallback) {
  const YamlValue* found = find(key);
  return found ? read_text(*found, name_of(key), complaints_) : fallback;
}

std::string StrictMap::need_text(std::string_view key) { return read_text(need(key), name_of(key), complaints_); }

}  // namespace mamo::io
