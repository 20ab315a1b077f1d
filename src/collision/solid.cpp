#include "solid.hpp"

#include "hull_offset.hpp"

namespace mamo::collision {
namespace {

using Kind = Solid::Kind;

Mesh recentred(const Mesh& mesh, const Eigen::Vector3d& centre) {
  auto hull = std::make_shared<ConvexHull>(*mesh.hull);
  for (auto& v : hull->vertices) v -= centre;
  hull->centroid -= centre;
  return {hull};
}

/// Distance (negative inside) of a point in the solid's frame; exact for boxes and cylinders, of the box for a hull.
double signed_distance(const Solid& s, const Eigen::Vector3d& p) {
  if (s.kind == Kind::sphere) return p.norm() - s.half.x();
  Eigen::Vector3d d = p.cwiseAbs() - s.half;
  if (s.kind == Kind::cylinder) d << std::sqrt(p.x() * p.x() + p.y() * p.y()) - s.half.x(), d.z(), d.z();
  const double inside = d.maxCoeff();
  if (inside <= 0) return inside;
  if (s.kind == Kind::cylinder) d.y() = 0;
  return d.cwiseMax(0.0).norm();
}

/// The widest gap found along axes that often separate. A positive gap is a lower bound of the distance; for two boxes
/// a negative one proves intersection, since all 15 axes are tried.
class GapSearch {
 public:
  GapSearch(const Solid& a, const Placed& X_WA, const Solid& b, const Placed& X_WB, double enough)
      : a_(a), b_(b), RA_(X_WA.R), RB_(X_WB.R), t_(X_WB.p - X_WA.p), enough_(enough) {}

  /// True as soon as a gap exceeds `enough`.
  bool run() {
    const double distance = t_.norm();
    if (distance > 0 && along(t_ / distance)) return true;
    return own_axes(a_, RA_) || own_axes(b_, RB_) || crosses();
  }
  double widest() const { return widest_; }

 private:
  bool along(const Eigen::Vector3d& unit) {
    const double gap = std::abs(unit.dot(t_)) - half_width(a_, RA_, unit) - half_width(b_, RB_, unit);
    widest_ = std::max(widest_, gap);
    return gap > enough_;
  }
  bool along_any(const Eigen::Vector3d& d) {
    const double squared = d.squaredNorm();
    return squared > 1e-12 && along(d / std::sqrt(squared));
  }
  bool own_axes(const Solid& s, const Eigen::Matrix3d& R) {
    const Eigen::Vector3d z = R.col(2);
    if (s.kind == Kind::cylinder) return along_any(t_ - z.dot(t_) * z) || along(z);
    return along(R.col(0)) || along(R.col(1)) || along(z);
  }
  bool crosses() {
    const int first_a = a_.kind == Kind::cylinder ? 2 : 0, first_b = b_.kind == Kind::cylinder ? 2 : 0;
    for (int i = first_a; i < 3; ++i)
      for (int k = first_b; k < 3; ++k)
        if (along_any(RA_.col(i).cross(RB_.col(k)))) return true;
    return false;
  }

  const Solid &a_, &b_;
  const Eigen::Matrix3d &RA_, &RB_;
  Eigen::Vector3d t_;
  double enough_, widest_ = -std::numeric_limits<double>::infinity();
};

bool fcl_hit(const Solid& a, const Placed& X_WA, const Solid& b, const Placed& X_WB) {
  const auto isometry = [](const Placed& X) {
    Eigen::Isometry3d out;
    out.linear() = X.R;
    out.translation() = X.p;
    out.makeAffine();
    return out;
  };
  return intersect(*a.geometry, isometry(X_WA), *b.geometry, isometry(X_WB));
}

Relation sphere_against(const Solid& ball, const Placed& X_WBall, const Solid& other, const Placed& X_WOther,
                        double clearance) {
  const double gap = signed_distance(other, X_WOther.R.transpose() * (X_WBall.p - X_WOther.p)) - ball.half.x();
  if (gap > clearance) return Relation::apart;
  if (gap > 0) return Relation::near;
  if (other.kind != Kind::hull) return Relation::hit;
  return fcl_hit(ball, X_WBall, other, X_WOther) ? Relation::hit : Relation::near;
}

}  // namespace

Solid make_solid(const Shape& shape, double padding, Eigen::Vector3d& centre) {
  Solid solid;
  centre.setZero();
  const auto grown = [&](double size) { return std::max(1e-6, size + padding); };
  if (const Box* b = std::get_if<Box>(&shape)) {
    solid.kind = Kind::box;
    for (int k = 0; k < 3; ++k) solid.half[k] = grown(b->size[k] / 2);
    solid.radius = solid.half.norm();
  } else if (const Cylinder* c = std::get_if<Cylinder>(&shape)) {
    solid.kind = Kind::cylinder;
    solid.half << grown(c->radius), grown(c->radius), grown(c->length / 2);
    solid.radius = std::hypot(solid.half.x(), solid.half.z());
  } else if (const Sphere* s = std::get_if<Sphere>(&shape)) {
    solid.kind = Kind::sphere;
    solid.half.setConstant(grown(s->radius));
    solid.radius = solid.half.x();
  } else {
    solid.kind = Kind::hull;
    const Mesh& mesh = std::get<Mesh>(shape);
    const std::vector<Eigen::Vector3d> vertices = offset_vertices(*mesh.hull, padding);
    Eigen::AlignedBox3d box;
    for (const auto& v : vertices) box.extend(v);
    centre = box.center();
    solid.half = box.sizes() / 2;
    for (const auto& v : vertices) solid.radius = std::max(solid.radius, (v - centre).norm());
    solid.geometry = make_geometry(recentred(mesh, centre), padding);
    return solid;
  }
  solid.geometry = make_geometry(shape, padding);
  return solid;
}

Relation relate(const Solid& a, const Placed& X_WA, const Solid& b, const Placed& X_WB, double clearance) {
  const double reach = a.radius + b.radius + clearance;
  if ((X_WB.p - X_WA.p).squaredNorm() > reach * reach) return Relation::apart;
  if (a.kind == Kind::sphere) return sphere_against(a, X_WA, b, X_WB, clearance);
  if (b.kind == Kind::sphere) return sphere_against(b, X_WB, a, X_WA, clearance);

  GapSearch search(a, X_WA, b, X_WB, clearance);
  if (search.run()) return Relation::apart;
  if (search.widest() > 0) return Relation::near;
  if (a.kind == Kind::box && b.kind == Kind::box) return Relation::hit;
  return fcl_hit(a, X_WA, b, X_WB) ? Relation::hit : Relation::near;
}

}  // namespace mamo::collision
