#include <map>
#include <numbers>

#include "arm_parts.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/common/random.hpp"

namespace mamo {
namespace {

using LinkPair = std::pair<LinkId, LinkId>;

constexpr std::uint64_t kStreamKey = 0x73656c66;  // "self"
constexpr int kSamples = 1000;
constexpr double kAlways = 0.95;  // share of samples in collision that counts as always

/// The nearest ancestor that has shapes, through links that have none; invalid if there is none.
LinkId shaped_parent(const RobotModel& model, LinkId link) {
  do {
    const JointId up = model.links[link.index()].parent_joint;
    if (!up.valid()) return LinkId{-1};
    link = model.joints[up.index()].parent;
  } while (model.links[link.index()].collision.empty());
  return link;
}

class LinkSolids {
 public:
  explicit LinkSolids(const RobotModel& model) {
    for (const Link& link : model.links) {
      links_.emplace_back();
      for (const PlacedShape& s : link.collision) {
        Eigen::Vector3d centre;
        const collision::Solid solid = collision::make_solid(s.shape, 0, centre);
        links_.back().push_back({solid, s.X_BS * Eigen::Translation3d(centre)});
      }
    }
  }
  bool collide(const std::vector<Eigen::Isometry3d>& X_WL, LinkPair pair) const {
    for (const Part& a : links_[pair.first.index()])
      for (const Part& b : links_[pair.second.index()])
        if (collision::relate(a.solid, placed(X_WL[pair.first.index()] * a.X_LS), b.solid,
                              placed(X_WL[pair.second.index()] * b.X_LS), 0) == collision::Relation::hit)
          return true;
    return false;
  }

 private:
  struct Part {
    collision::Solid solid;
    Eigen::Isometry3d X_LS;
  };
  static collision::Placed placed(const Eigen::Isometry3d& X) { return {X.linear(), X.translation()}; }
  std::vector<std::vector<Part>> links_;
};

/// All pairs whose relative pose can change, less adjacent and listed ones.
std::vector<LinkPair> candidates(const Robot& robot, const std::vector<LinkPair>& disabled) {
  const RobotModel& model = *robot.model;
  const std::vector<int> group = collision::rigid_groups(robot);
  std::vector<LinkPair> pairs;
  for (std::size_t a = 0; a < model.links.size(); ++a) {
    for (std::size_t b = a + 1; b < model.links.size(); ++b) {
      const LinkPair pair{LinkId(a), LinkId(b)};
      if (model.links[a].collision.empty() || model.links[b].collision.empty() || group[a] == group[b]) continue;
      if (shaped_parent(model, pair.second) == pair.first) continue;
      const bool listed = std::any_of(disabled.begin(), disabled.end(), [&](const LinkPair& d) {
        return d == pair || d == LinkPair{pair.second, pair.first};
      });
      if (!listed) pairs.push_back(pair);
    }
  }
  return pairs;
}

}  // namespace

void choose_self_pairs(Robot& robot, const std::vector<LinkPair>& disabled, bool srdf_given, std::uint64_t seed) {
  robot.disabled_pairs.clear();
  robot.self_pairs = candidates(robot, disabled);
  if (srdf_given) return;

  const ForwardKinematics kinematics(robot);
  const LinkSolids solids(*robot.model);
  std::vector<Eigen::Isometry3d> X_WL;
  std::map<LinkPair, int> hits;
  kinematics.link_poses(robot.group_part(robot.posture), X_WL);
  for (const LinkPair& pair : robot.self_pairs)
    if (solids.collide(X_WL, pair)) hits[pair] = kSamples;
  RandomStream random(seed, {kStreamKey});
  Eigen::VectorXd q(robot.dof());
  for (int k = 0; k < kSamples; ++k) {
    for (int i = 0; i < robot.dof(); ++i) {
      const Joint& j = robot.joint(i);
      const bool limited = std::isfinite(j.lower) && std::isfinite(j.upper);
      q[i] = random.uniform(limited ? j.lower : -std::numbers::pi, limited ? j.upper : std::numbers::pi);
    }
    kinematics.link_poses(q, X_WL);
    for (const LinkPair& pair : robot.self_pairs)
      if (solids.collide(X_WL, pair)) ++hits[pair];
  }
  const auto always = [&](const LinkPair& pair) { return hits[pair] >= kAlways * kSamples; };
  std::copy_if(robot.self_pairs.begin(), robot.self_pairs.end(), std::back_inserter(robot.disabled_pairs), always);
  std::erase_if(robot.self_pairs, always);
}

}  // namespace mamo
