// Integer handles that cannot be mixed up: an ObjectId is not a LinkId.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace mamo {

/// A typed index. Negative values are reserved for the sentinels named beside each alias.
template <class Tag>
struct Id {
  std::int32_t value = -1;

  constexpr Id() = default;
  constexpr explicit Id(std::int32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::int32_t>(v)) {}
  constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  constexpr bool valid() const { return value >= 0; }
  friend constexpr auto operator<=>(Id, Id) = default;
};

/// Index of an object in Scene::objects. kRobot, kFloor and kNoObject stand where an object is named
/// but is none ("touched by: the robot").
using ObjectId = Id<struct ObjectTag>;
inline constexpr ObjectId kNoObject{-1};
inline constexpr ObjectId kRobot{-2};
inline constexpr ObjectId kFloor{-3};

/// Index into RobotModel::links, into RobotModel::joints.
using LinkId = Id<struct LinkTag>;
using JointId = Id<struct JointTag>;

/// Handle of a search state, in order of interning; never shown in output (it may depend on threads).
using StateId = Id<struct StateTag>;
/// Index of a worker, 0 .. threads-1.
using WorkerId = Id<struct WorkerTag>;

}  // namespace mamo

template <class Tag>
struct std::hash<mamo::Id<Tag>> {
  std::size_t operator()(mamo::Id<Tag> id) const noexcept { return std::hash<std::int32_t>{}(id.value); }
};
