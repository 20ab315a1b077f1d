#include "mamo/collision/collision_checker.hpp"

#include "fcl_geometry.hpp"

namespace mamo {
using namespace collision;

namespace {

struct RobotPart {
  LinkId link;
  bool moves;
  Eigen::Isometry3d X_LS;
  const Shape* shape;
  Geometry geometry;
};
struct ObjectPart {
  ObjectId object;
  Eigen::Isometry3d X_OS, X_WS;
  const Shape* shape;
  Geometry plain, padded;
  Eigen::AlignedBox3d box;  // world, unpadded
};

}  // namespace

struct CollisionChecker::Impl {
  std::shared_ptr<const ForwardKinematics> kinematics;
  Scene scene;
  CollisionOptions options;
  std::vector<RobotPart> parts;
  std::vector<ObjectPart> objects;
  std::vector<std::pair<int, int>> self;  // indices into parts
  WorldState state;
  ObjectId held = kNoObject;
  std::size_t own_parts = 0, own_self = 0;
  std::vector<Eigen::Isometry3d> X_WL, X_WS;
  std::vector<Eigen::AlignedBox3d> boxes;
  std::int64_t checks = 0;
  Eigen::VectorXd bounds;

  void place(std::size_t object) {
    const Eigen::Isometry3d X_WO = dequantise(state.poses[object]);
    for (ObjectPart& p : objects) {
      if (p.object.index() != object) continue;
      p.X_WS = X_WO * p.X_OS;
      p.box = mamo::bounds(*p.shape, p.X_WS);
    }
  }

  void pose(const Eigen::VectorXd& q) {
    ++checks;
    kinematics->link_poses(q, X_WL);
    X_WS.resize(parts.size());
    boxes.resize(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      X_WS[i] = X_WL[parts[i].link.index()] * parts[i].X_LS;
      boxes[i] = mamo::bounds(*parts[i].shape, X_WS[i]);
    }
  }

  bool self_collision(CollisionReport& out) {
    for (const auto& [a, b] : self) {
      const std::size_t i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(b);
      if (!boxes[i].intersects(boxes[k]) || !intersect(*parts[i].geometry, X_WS[i], *parts[k].geometry, X_WS[k])) continue;
      out.self = true;
      out.first_self = {parts[i].link, parts[k].link};
      return true;
    }
    return false;
  }

  bool hits(const ObjectPart& object, double padding) {
    Eigen::AlignedBox3d box = object.box;
    box.min().array() -= padding * std::sqrt(3.0);
    box.max().array() += padding * std::sqrt(3.0);
    const Geometry& geometry = padding > 0 ? object.padded : object.plain;
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (parts[i].moves && boxes[i].intersects(box) && intersect(*parts[i].geometry, X_WS[i], *geometry, object.X_WS))
        return true;
    return false;
  }
};

CollisionChecker::CollisionChecker(std::shared_ptr<const ForwardKinematics> kinematics, const Scene& scene,
                                   const CollisionOptions& options)
    : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.kinematics = std::move(kinematics);
  m.scene = scene;
  m.options = options;
  m.state = WorldState::start_of(scene);
  const Robot& robot = m.kinematics->robot();
  const std::vector<bool> moving = robot.moving_links();
  for (std::size_t i = 0; i < robot.model->links.size(); ++i)
    for (const PlacedShape& s : robot.model->links[i].collision)
      m.parts.push_back({LinkId(i), moving[i], s.X_BS, &s.shape, make_geometry(s.shape)});
  for (const auto& [a, b] : robot.self_pairs)
    for (std::size_t i = 0; i < m.parts.size(); ++i)
      for (std::size_t k = 0; k < m.parts.size(); ++k)
        if (m.parts[i].link == a && m.parts[k].link == b) m.self.emplace_back(i, k);
  m.own_parts = m.parts.size();
  m.own_self = m.self.size();
  for (std::size_t i = 0; i < m.scene.size(); ++i) {
    for (const PlacedShape& s : m.scene.objects[i].shapes)
      m.objects.push_back({ObjectId(i), s.X_BS, {}, &s.shape, make_geometry(s.shape),
                           make_geometry(s.shape, options.padding), {}});
    m.place(i);
  }
  m.bounds = m.kinematics->motion_bounds();
}

CollisionChecker::~CollisionChecker() = default;

void CollisionChecker::set_state(const WorldState& state) {
  for (std::size_t i = 0; i < state.poses.size(); ++i) {
    if (impl_->state.poses[i] == state.poses[i]) continue;
    impl_->state.poses[i] = state.poses[i];
    impl_->place(i);
  }
}

void CollisionChecker::check(const Eigen::VectorXd& q, const ObjectSet& against, bool stop_at_first, CollisionReport& out) {
  Impl& m = *impl_;
  out = {};
  m.pose(q);
  if (m.self_collision(out) && stop_at_first) return;
  for (const ObjectPart& o : m.objects) {
    if (o.object == m.held || !against.contains(o.object)) continue;
    if (!out.touched.empty() && out.touched.back() == o.object) continue;
    if (!m.hits(o, 0)) continue;
    out.touched.push_back(o.object);
    if (stop_at_first) return;
  }
}

std::vector<double> CollisionChecker::edge_samples(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1) const {
  const double travel = impl_->bounds.dot((q1 - q0).cwiseAbs());
  const int n = std::max(1, static_cast<int>(std::ceil(travel / impl_->options.edge_step - 1e-9)));
  std::vector<double> s;
  for (int k = 0; k <= n; ++k) s.push_back(static_cast<double>(k) / n);
  return s;
}

bool CollisionChecker::check_edge(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const ObjectSet& forbidden,
                                  const ObjectSet& watched, CollisionReport& out) {
  Impl& m = *impl_;
  out = {};
  for (double s : edge_samples(q0, q1)) {
    m.pose(q0 + s * (q1 - q0));
    if (m.self_collision(out)) return out.touched.clear(), false;
    for (const ObjectPart& o : m.objects) {
      if (o.object == m.held || (!forbidden.contains(o.object) && !watched.contains(o.object))) continue;
      if (std::binary_search(out.touched.begin(), out.touched.end(), o.object)) continue;
      if (!m.hits(o, m.options.padding)) continue;
      if (forbidden.contains(o.object)) return out.touched = {o.object}, false;
      out.first_touch = std::min(out.first_touch, s);
      out.touched.insert(std::lower_bound(out.touched.begin(), out.touched.end(), o.object), o.object);
    }
  }
  return true;
}

void CollisionChecker::attach(ObjectId object, LinkId link, const Eigen::Isometry3d& X_LO) {
  detach();
  Impl& m = *impl_;
  m.held = object;
  for (const PlacedShape& s : m.scene[object].shapes) {
    for (const auto& [a, b] : m.kinematics->robot().self_pairs)
      for (std::size_t k = 0; k < m.own_parts; ++k)
        if ((a == link && m.parts[k].link == b) || (b == link && m.parts[k].link == a)) m.self.emplace_back(k, m.parts.size());
    m.parts.push_back({link, true, X_LO * s.X_BS, &s.shape, make_geometry(s.shape)});
  }
}

void CollisionChecker::detach() {
  impl_->held = kNoObject;
  impl_->parts.resize(impl_->own_parts);
  impl_->self.resize(impl_->own_self);
}

std::vector<std::pair<ObjectId, ObjectId>> CollisionChecker::overlapping_objects(double tolerance) {
  Impl& m = *impl_;
  std::vector<Geometry> shrunk;
  for (const ObjectPart& o : m.objects) shrunk.push_back(make_geometry(*o.shape, -tolerance / 2));
  std::vector<std::pair<ObjectId, ObjectId>> pairs;
  for (std::size_t i = 0; i < m.objects.size(); ++i)
    for (std::size_t k = i + 1; k < m.objects.size(); ++k)
      if (m.objects[i].object != m.objects[k].object && m.objects[i].box.intersects(m.objects[k].box) &&
          intersect(*shrunk[i], m.objects[i].X_WS, *shrunk[k], m.objects[k].X_WS))
        pairs.emplace_back(m.objects[i].object, m.objects[k].object);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::int64_t CollisionChecker::checks() const { return impl_->checks; }
const CollisionOptions& CollisionChecker::options() const { return impl_->options; }

}  // namespace mamo
