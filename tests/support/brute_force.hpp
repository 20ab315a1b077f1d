// All pairs with fcl::collide, nothing else: what the collision checker has to agree with.
#pragma once

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <memory>
#include <vector>

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/scene.hpp"
#include "mamo/model/world_state.hpp"

namespace mamo::fixtures {

using FclShape = std::shared_ptr<fcl::CollisionGeometryd>;

/// Hulls are not padded here.
inline FclShape fcl_shape(const Shape& shape, double padding) {
  FclShape out;
  if (const Box* b = std::get_if<Box>(&shape)) {
    out = std::make_shared<fcl::Boxd>(b->size.x() + 2 * padding, b->size.y() + 2 * padding, b->size.z() + 2 * padding);
  } else if (const Cylinder* c = std::get_if<Cylinder>(&shape)) {
    out = std::make_shared<fcl::Cylinderd>(c->radius + padding, c->length + 2 * padding);
  } else if (const Sphere* s = std::get_if<Sphere>(&shape)) {
    out = std::make_shared<fcl::Sphered>(s->radius + padding);
  } else {
    const ConvexHull& hull = *std::get<Mesh>(shape).hull;
    auto faces = std::make_shared<std::vector<int>>();
    for (const auto& t : hull.triangles) faces->insert(faces->end(), {3, t[0], t[1], t[2]});
    out = std::make_shared<fcl::Convexd>(std::make_shared<const std::vector<Eigen::Vector3d>>(hull.vertices),
                                         static_cast<int>(hull.triangles.size()),
                                         std::shared_ptr<const std::vector<int>>(faces));
  }
  out->computeLocalAABB();
  return out;
}

class BruteForce {
 public:
  BruteForce(const Robot& robot, const Scene& scene, double padding)
      : robot_(robot), scene_(scene), kinematics_(robot) {
    for (const Link& link : robot.model->links) {
      links_.emplace_back();
      for (const PlacedShape& s : link.collision) links_.back().push_back({fcl_shape(s.shape, 0), s.X_BS});
    }
    for (const Object& o : scene.objects) {
      objects_.emplace_back();
      for (const PlacedShape& s : o.shapes) objects_.back().push_back({fcl_shape(s.shape, padding), s.X_BS});
    }
    state = WorldState::start_of(scene);
  }

  std::vector<ObjectId> touched(const Eigen::VectorXd& q) {
    kinematics_.link_poses(q, X_WL_);
    const std::vector<bool> moves = robot_.moving_links();
    std::vector<ObjectId> out;
    for (std::size_t o = 0; o < objects_.size(); ++o) {
      bool hit = false;
      const Eigen::Isometry3d X_WO = state.X_WO(ObjectId(o));
      if (held.value == static_cast<int>(o)) continue;
      for (std::size_t l = 0; l < links_.size(); ++l)
        hit = hit || (moves[l] && collide(links_[l], X_WL_[l], objects_[o], X_WO));
      if (held.valid()) hit = hit || collide(held_shapes(), X_WL_[held_by.index()] * X_LHeld, objects_[o], X_WO);
      if (hit) out.emplace_back(o);
    }
    return out;
  }
  bool self(const Eigen::VectorXd& q) {
    kinematics_.link_poses(q, X_WL_);
    for (const auto& [a, b] : robot_.self_pairs) {
      if (collide(links_[a.index()], X_WL_[a.index()], links_[b.index()], X_WL_[b.index()])) return true;
      if (held.valid() && a == held_by &&
          collide(held_shapes(), X_WL_[a.index()] * X_LHeld, links_[b.index()], X_WL_[b.index()]))
        return true;
      if (held.valid() && b == held_by &&
          collide(held_shapes(), X_WL_[b.index()] * X_LHeld, links_[a.index()], X_WL_[a.index()]))
        return true;
    }
    return false;
  }

  WorldState state;
  ObjectId held = kNoObject;
  LinkId held_by;
  Eigen::Isometry3d X_LHeld = Eigen::Isometry3d::Identity();

 private:
  struct Part {
    FclShape shape;
    Eigen::Isometry3d X_BS;
  };
  std::vector<Part> held_shapes() const {
    std::vector<Part> out;
    for (const PlacedShape& s : scene_[held].shapes) out.push_back({fcl_shape(s.shape, 0), s.X_BS});
    return out;
  }
  static bool collide(const std::vector<Part>& a, const Eigen::Isometry3d& X_WA, const std::vector<Part>& b,
                      const Eigen::Isometry3d& X_WB) {
    const fcl::CollisionRequestd request(1, false);
    for (const Part& p : a)
      for (const Part& q : b) {
        fcl::CollisionResultd result;
        if (fcl::collide(p.shape.get(), X_WA * p.X_BS, q.shape.get(), X_WB * q.X_BS, request, result) > 0) return true;
      }
    return false;
  }

  Robot robot_;
  Scene scene_;
  ForwardKinematics kinematics_;
  std::vector<std::vector<Part>> links_, objects_;
  std::vector<Eigen::Isometry3d> X_WL_;
};

}  // namespace mamo::fixtures
