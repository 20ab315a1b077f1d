// Shapes and visual meshes as triangles of a bounded number.
#pragma once

#include <map>
#include <string>

#include "mamo/io/mesh.hpp"
#include "mamo/model/robot.hpp"
#include "mamo/model/shape.hpp"

namespace mamo::view {

using io::TriangleMesh;

/// The surface of a shape in its own frame, counter-clockwise seen from outside. Round shapes have `sides` sides.
TriangleMesh tessellate(const Shape& shape, int sides = 32);

/// Merges vertices that share a cell of a grid, coarser until at most `most` triangles are left.
TriangleMesh reduce(const TriangleMesh& mesh, std::size_t most);

/// The visual meshes of a robot, each file read once and reduced so that all of them together stay below a budget.
/// A file that cannot be read is null.
class VisualMeshes {
 public:
  VisualMeshes(const RobotModel& robot, std::size_t budget);
  const TriangleMesh* find(const VisualGeometry& visual) const;

 private:
  static std::string key(const VisualGeometry& visual);
  std::map<std::string, TriangleMesh> meshes_;
};

/// Triangles of all visual meshes together.
inline constexpr std::size_t kVisualBudget = 60000;

}  // namespace mamo::view
