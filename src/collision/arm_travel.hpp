// How fast the parts of an arm can move along a straight edge in joint space: upper bounds that hold.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "solid.hpp"

#include "mamo/model/robot.hpp"

namespace mamo::collision {

/// Speeds are in metres per unit of the edge parameter s (0 at q0, 1 at q1). A point of a part moves at most at the
/// sum over the moving joints above it of |dq/ds| times its distance from that joint's axis. The distance is taken at
/// the middle of a stretch of the edge, plus what the joints in between can add to it within the stretch, and never
/// more than the sum of offsets along the chain.
class ArmTravel {
 public:
  explicit ArmTravel(const Robot& robot);

  /// A solid fixed to a link; returns its index.
  int add_part(LinkId link, const Solid& solid, const Eigen::Isometry3d& X_LS);
  /// Two parts whose relative motion matters; returns the pair's index.
  int add_pair(int a, int b);
  void remove_parts_from(int part) { parts_.resize(static_cast<std::size_t>(part)); }
  void remove_pairs_from(int pair) { pairs_.resize(static_cast<std::size_t>(pair)); }

  /// Prepares speeds for a stretch of an edge: link poses at its middle, dq/ds of the group joints, and how far s goes
  /// to either side.
  void update(const std::vector<Eigen::Isometry3d>& X_WL, const Eigen::VectorXd& dq, double half_stretch);

  /// Largest speed of any point of a part in the world; of any point of one part seen from the other.
  double speed(int part) const { return parts_[static_cast<std::size_t>(part)].speed; }
  double pair_speed(int pair) const;
  /// Largest speed of any part.
  double largest_speed() const;
  /// Largest speed in any configuration whatever; needs no update().
  double worst_speed(const Eigen::VectorXd& dq) const;

 private:
  struct Actuator {  // a joint driven by the group
    int link;        // its child
    int group_index;
    double multiplier;     // absolute
    Eigen::Vector3d axis;  // in the link
    double rate = 0;       // |d value / ds|, by update(); so are axis and a point of it in the world
    Eigen::Vector3d axis_W = Eigen::Vector3d::Zero(), p_W = Eigen::Vector3d::Zero();
  };
  struct Lever {  // of a part about an actuator above it
    int actuator;
    double largest;    // in any configuration (m, 1 for prismatic)
    bool constant;     // the same in all configurations
    double speed = 0;  // rate times the lever, by update()
  };
  struct Part {
    int link;
    Eigen::Vector3d p_L;  // centre of the ball
    double radius;
    std::vector<Lever> levers;  // nearest actuator first
    double speed = 0;
  };
  struct Pair {
    int a, b;
    std::size_t shared;  // actuators that both parts hang on: they move the two as one
  };

  Robot robot_;
  std::vector<Actuator> actuators_;
  std::vector<int> actuator_of_link_;  // -1: the link's joint is not driven
  std::vector<Part> parts_;
  std::vector<Pair> pairs_;
};

}  // namespace mamo::collision
