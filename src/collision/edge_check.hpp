// One edge, coarse to fine, with what is proven far left out.
#pragma once

#include <cstdint>
#include <vector>

#include "arm_parts.hpp"
#include "edge_samples.hpp"
#include "obstacles.hpp"

#include "mamo/collision/collision_checker.hpp"

namespace mamo::collision {

/// The scratch and the algorithm of CollisionChecker::check and check_edge. The answer is that of testing every pair
/// at every sample. What makes it cheap: a node of the bisection stands for a range of samples; the arm is posed at its
/// middle sample; a pair further apart there than it can come together within the range is dropped for the
/// whole range. Most pairs are dropped at the root, and a range without pairs needs no pose at all.
class EdgeCheck {
 public:
  EdgeCheck(const ForwardKinematics& kinematics, ArmParts& arm, const Obstacles& obstacles,
            const CollisionOptions& options)
      : kinematics_(kinematics), arm_(arm), obstacles_(obstacles), options_(options) {}

  void configuration(const Eigen::VectorXd& q, const ObjectSet& against, ObjectId held, bool stop_at_first,
                     CollisionReport& out);
  bool edge(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const ObjectSet& forbidden, const ObjectSet& watched,
            ObjectId held, CollisionReport& out);
  std::vector<double> samples(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1);
  std::int64_t poses() const { return poses_; }

 private:
  enum Role : std::uint8_t { ignored, watched_role, forbidden_role };
  struct Pair {
    std::int32_t part, obstacle;
  };
  struct Range {  // indices into pairs_ or self_pairs_
    std::size_t begin, end;
  };
  struct Node {
    int stretch, low, high;  // samples low .. high of the stretch
    Range pairs, self;
    bool root;
  };
  struct PlacedPart {
    Placed X;
    std::int64_t stamp = -1;  // pose number it belongs to
  };

  void pose(const Eigen::VectorXd& q);
  void pose_at(double s, const Eigen::VectorXd& q0, const Eigen::VectorXd& q1);
  const Placed& placed(int part);
  void begin_edge(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1);
  void measure(int stretch);
  void gather(Node& root, double reach);
  bool visit(Node node, const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, CollisionReport& out);
  bool test_obstacles(Node& node, double s, double s_low, double reach, CollisionReport& out);
  bool test_self(Node& node, double reach, CollisionReport& out);
  double speed(int stretch, int part) const {
    return speeds_[static_cast<std::size_t>(stretch) * arm_.parts().size() + static_cast<std::size_t>(part)];
  }
  double pair_speed(int stretch, int pair) const {
    return pair_speeds_[static_cast<std::size_t>(stretch) * arm_.self_pairs().size() + static_cast<std::size_t>(pair)];
  }

  const ForwardKinematics& kinematics_;
  ArmParts& arm_;
  const Obstacles& obstacles_;
  const CollisionOptions& options_;

  std::int64_t poses_ = 0;
  std::vector<Eigen::Isometry3d> X_WL_;
  std::vector<PlacedPart> placed_;
  Eigen::VectorXd q_, dq_;
  std::vector<Stretch> stretches_;
  std::vector<double> speeds_, pair_speeds_;  // by stretch: of each part, of each self pair
  std::vector<std::uint8_t> role_;            // of each obstacle part
  std::vector<std::int32_t> active_;          // obstacle parts with a role
  std::vector<std::uint8_t> touched_;         // by object
  std::vector<int> order_;
  std::vector<Eigen::Vector3d> boxes_;  // half boxes of the arm's parts
  std::vector<Node> nodes_;
  std::vector<Pair> pairs_;
  std::vector<std::int32_t> self_pairs_;
};

}  // namespace mamo::collision
