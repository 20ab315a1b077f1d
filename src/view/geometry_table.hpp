// Shapes and meshes of a page, each once, named by index.
#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <string>

#include "view/triangles.hpp"

namespace mamo::view {

/// Primitives by their sizes; surfaces as 16-bit coordinates within their box.
class GeometryTable {
 public:
  std::size_t add(const Shape& shape);
  std::size_t add(const TriangleMesh& mesh);
  nlohmann::json take() { return std::move(table_); }

 private:
  std::size_t put(nlohmann::json entry);
  nlohmann::json table_ = nlohmann::json::array();
  std::map<std::string, std::size_t> index_of_;  // by its own JSON
};

/// x y z qx qy qz qw, rounded to micrometres and microradians.
nlohmann::json pose_json(const Eigen::Isometry3d& X);
nlohmann::json point_json(const Eigen::Vector3d& p);

}  // namespace mamo::view
