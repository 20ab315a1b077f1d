#include "verify/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mamo::verify {
namespace {

constexpr double kMoves = 1e-3;  // m/s: an object faster than this, once driven, drives what it touches

bool is_fixture(const Scene& scene, ObjectId id) { return id == kFloor || (id.valid() && scene[id].fixture()); }

}  // namespace

Recorder::Recorder(const Scene& scene, Recording& recording)
    : scene_(scene),
      out_(recording),
      stride_(std::max(1, static_cast<int>(std::lround(kRecordingStep / scene.physics.step)))) {
  out_ = {};
  for (ObjectId id : ObjectSet::all(scene).ids()) {
    const Eigen::Isometry3d& X = scene[id].X_WO;
    objects_.push_back({id, X, X.linear().transpose() * Eigen::Vector3d::UnitZ(), 0, 0, false});
  }
}

void Recorder::note(const World& world, const std::vector<Contact>& contacts, double time_s, const Eigen::VectorXd& q) {
  time_s_ = time_s;
  q_ = q;
  look(world);
  note_contacts(world, contacts, time_s);
  if (out_.t.empty() || ++since_ >= stride_) sample();
}

void Recorder::look(const World& world) {
  for (Now& now : objects_) {
    const Eigen::Isometry3d X = world.X_WO(now.id);
    now.moved = now.moved || (X.matrix() - scene_[now.id].X_WO.matrix()).cwiseAbs().maxCoeff() > 1e-6;
    now.X_WO = X;
    now.tilt = std::max(now.tilt, std::acos(std::clamp((X.linear() * now.up).z(), -1.0, 1.0)));
    if (world.awake(now.id)) now.speed = std::max(now.speed, world.linear_velocity(now.id).norm());
  }
}

void Recorder::note_contacts(const World& world, const std::vector<Contact>& contacts, double time_s) {
  const auto drives = [&](ObjectId id) {
    if (id == kRobot) return true;
    return driven_.contains(id) && world.awake(id) && world.linear_velocity(id).norm() > kMoves;
  };
  std::map<std::pair<ObjectId, ObjectId>, std::size_t> still;
  for (const Contact& c : contacts) {
    if (c.a == c.b) continue;
    const std::pair pair(c.a, c.b);
    const auto known = open_.find(pair);
    if (known == open_.end()) {
      const bool resting = is_fixture(scene_, c.a) || is_fixture(scene_, c.b);
      if (!(drives(c.a) || drives(c.b)) || (resting && c.a != kRobot)) continue;
      out_.contacts.push_back({c.a, c.b, time_s, time_s, c.depth, c.p_W});
      still[pair] = out_.contacts.size() - 1;
      for (ObjectId id : {c.a, c.b})
        if (id.valid() && !is_fixture(scene_, id)) driven_.insert(id);
      continue;
    }
    Recording::Contact& contact = out_.contacts[known->second];
    contact.end_s = time_s;
    contact.depth = std::max(contact.depth, c.depth);
    still.insert(*known);
  }
  open_ = std::move(still);
}

void Recorder::sample() {
  since_ = 0;
  out_.t.push_back(time_s_);
  out_.q.push_back(q_);
  for (Now& now : objects_) {
    Recording::Track& track = out_.tracks[now.id];
    track.X_WO.push_back(now.X_WO);
    track.tilt.push_back(now.tilt);
    track.speed.push_back(now.speed);
    now.tilt = now.speed = 0;
  }
}

void Recorder::finish() {
  if (since_ > 0) sample();
  for (const Now& now : objects_)
    if (!now.moved) out_.tracks.erase(now.id);
  std::sort(out_.contacts.begin(), out_.contacts.end(),
            [](const auto& x, const auto& y) { return std::tie(x.begin_s, x.a, x.b) < std::tie(y.begin_s, y.a, y.b); });
}

}  // namespace mamo::verify
