#include "mamo/model/scene.hpp"

namespace mamo {

Eigen::Vector3d Object::centre_of_mass() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0;
  for (const PlacedShape& s : shapes) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    if (const Mesh* mesh = std::get_if<Mesh>(&s.shape)) centre = mesh->hull->centroid;
    const double v = volume(s.shape);
    sum += v * (s.X_BS * centre);
    total += v;
  }
  return total > 0 ? Eigen::Vector3d(sum / total) : sum;
}

ObjectId Scene::find(const std::string& id) const {
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (objects[i].id == id) return ObjectId(i);
  return kNoObject;
}

ObjectSet ObjectSet::all(const Scene& scene) {
  ObjectSet set(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (!scene.objects[i].fixture()) set.insert(ObjectId(i));
  return set;
}

ObjectSet ObjectSet::of_kind(const Scene& scene, ObjectKind kind) {
  ObjectSet set(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (scene.objects[i].kind == kind) set.insert(ObjectId(i));
  return set;
}

}  // namespace mamo
