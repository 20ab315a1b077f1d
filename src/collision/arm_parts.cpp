#include "arm_parts.hpp"

namespace mamo::collision {

std::vector<int> rigid_groups(const Robot& robot) {
  const RobotModel& model = *robot.model;
  std::vector<bool> driven(model.joints.size(), false);
  for (JointId j : robot.group.joints) driven[j.index()] = true;
  std::vector<int> group(model.links.size(), 0);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& j = model.joints[i];
    const bool moves = driven[i] || (j.mimic && driven[j.mimic->joint.index()]);
    group[j.child.index()] = moves ? j.child.value : group[j.parent.index()];
  }
  return group;
}

ArmParts::ArmParts(const ForwardKinematics& kinematics)
    : robot_(kinematics.robot()), rigid_group_(rigid_groups(robot_)), travel_(robot_) {
  const std::vector<bool> moves = robot_.moving_links();
  for (int still = 0; still < 2; ++still) {
    for (std::size_t i = moves.size(); i-- > 0;) {
      if (moves[i] == (still == 1)) continue;
      for (const PlacedShape& s : robot_.model->links[i].collision) {
        ArmPart part{LinkId(i), moves[i], {}, s.X_BS, false};
        Eigen::Vector3d centre;
        part.solid = make_solid(s.shape, 0, centre);
        part.X_LS.translate(centre);
        part.turned = part.X_LS.linear() != Eigen::Matrix3d::Identity();
        travel_.add_part(part.link, part.solid, part.X_LS);
        if (part.moves) own_moving_.push_back(static_cast<int>(parts_.size()));
        parts_.push_back(std::move(part));
      }
    }
  }
  own_parts_ = parts_.size();
  moving_ = own_moving_;
  for (const auto& [la, lb] : robot_.self_pairs)
    for (std::size_t a = 0; a < own_parts_; ++a)
      for (std::size_t b = 0; b < own_parts_; ++b)
        if (parts_[a].link == la && parts_[b].link == lb && !rigid_with(la, lb))
          add_self_pair(static_cast<int>(a), static_cast<int>(b));
  own_self_ = self_.size();
}

void ArmParts::add_self_pair(int a, int b) {
  const LinkId la = parts_[static_cast<std::size_t>(a)].link, lb = parts_[static_cast<std::size_t>(b)].link;
  self_.push_back({a, b, std::min(la, lb), std::max(la, lb)});
  travel_.add_pair(a, b);
}

void ArmParts::hold(const Object& object, LinkId link, const Eigen::Isometry3d& X_LO) {
  release();
  // What the object may hit: the partners of every link that it is now rigid with (the link itself may have no shape).
  std::vector<bool> partner(robot_.model->links.size(), false);
  for (const auto& [a, b] : robot_.self_pairs) {
    if (rigid_with(a, link)) partner[b.index()] = true;
    if (rigid_with(b, link)) partner[a.index()] = true;
  }
  moving_.clear();
  for (const PlacedShape& s : object.shapes) {
    ArmPart part{link, true, {}, X_LO * s.X_BS, false};
    Eigen::Vector3d centre;
    part.solid = make_solid(s.shape, 0, centre);
    part.X_LS.translate(centre);
    part.turned = part.X_LS.linear() != Eigen::Matrix3d::Identity();
    travel_.add_part(link, part.solid, part.X_LS);
    const int index = static_cast<int>(parts_.size());
    parts_.push_back(std::move(part));
    moving_.push_back(index);
    for (std::size_t k = 0; k < own_parts_; ++k)
      if (partner[parts_[k].link.index()] && !rigid_with(parts_[k].link, link))
        add_self_pair(static_cast<int>(k), index);
  }
  moving_.insert(moving_.end(), own_moving_.begin(), own_moving_.end());
}

void ArmParts::release() {
  parts_.resize(own_parts_);
  self_.resize(own_self_);
  moving_ = own_moving_;
  travel_.remove_parts_from(static_cast<int>(own_parts_));
  travel_.remove_pairs_from(static_cast<int>(own_self_));
}

Placed ArmParts::placed(int part, const std::vector<Eigen::Isometry3d>& X_WL) const {
  const ArmPart& p = parts_[static_cast<std::size_t>(part)];
  const Eigen::Isometry3d& X = X_WL[p.link.index()];
  Placed out;
  if (p.turned)
    out.R.noalias() = X.linear() * p.X_LS.linear();
  else
    out.R = X.linear();
  out.p.noalias() = X.linear() * p.X_LS.translation() + X.translation();
  return out;
}

}  // namespace mamo::collision
