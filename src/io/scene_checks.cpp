#include "io/scene_checks.hpp"

#include "io/text.hpp"

namespace mamo::io {
namespace {

constexpr double kGap = 0.005;  // m

Eigen::AlignedBox3d box_of(const Object& object) {
  Eigen::AlignedBox3d box;
  for (const PlacedShape& s : object.shapes) box.extend(bounds(s.shape, object.X_WO * s.X_BS));
  return box;
}

bool is_static(const Object& object) { return object.fixture() || object.mass == 0; }

/// Does `other` reach to the underside of `box` somewhere?
bool may_carry(const Eigen::AlignedBox3d& other, const Eigen::AlignedBox3d& box) {
  const double z = box.min().z();
  for (int axis : {0, 1})
    if (other.max()[axis] < box.min()[axis] - kGap || other.min()[axis] > box.max()[axis] + kGap) return false;
  return other.max().z() >= z - kGap && other.min().z() <= z + kGap;
}

}  // namespace

void check_floating(const Scene& scene, const std::vector<Place>& places, bool only_warn, Complaints& complaints) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Object& object : scene.objects) boxes.push_back(box_of(object));
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Object& object = scene.objects[i];
    if (is_static(object)) continue;
    const double z = boxes[i].min().z();
    bool carried = std::abs(z) <= kGap;
    for (std::size_t j = 0; j < scene.size() && !carried; ++j) carried = j != i && may_carry(boxes[j], boxes[i]);
    if (carried) continue;
    const Place place = i < places.size() ? places[i] : Place{};
    const std::string message = "object " + in_quotes(object.id) + (z < 0 ? " hangs below the floor" : " floats") +
                                " at the start: nothing is under it at z = " + shortest_number(z) + " m";
    only_warn ? complaints.warn(place.line, place.column, message) : complaints.add(place.line, place.column, message);
  }
}

}  // namespace mamo::io
