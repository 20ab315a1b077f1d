// One rigid body of a World: its shape, its Bullet state, whether it sleeps.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <memory>

#include "physics/body_shape.hpp"

#include "mamo/common/ids.hpp"
#include "mamo/physics/world.hpp"

class btRigidBody;

namespace mamo {

/// Axis-aligned, in world (m).
struct Bounds {
  std::array<double, 3> min, max;
  bool overlaps(const Bounds& o) const {
    return min[0] <= o.max[0] && o.min[0] <= max[0] && min[1] <= o.max[1] && o.min[1] <= max[1] && min[2] <= o.max[2] &&
           o.min[2] <= max[2];
  }
};

/// Static; moved by the arm's joints; moved by forces.
enum class Role { still, driven, free };

class Body {
 public:
  /// A body of these shapes at X_WB. mass (kg) > 0 makes it free.
  Body(const std::vector<PlacedShape>& shapes, const Eigen::Isometry3d& X_WB, ObjectId id, double mass,
       double friction);
  /// The floor: everything below z (m).
  Body(double floor_z, double friction);
  ~Body();
  Body(Body&&) noexcept;

  /// Free if it has mass, else static; at rest and asleep at X_WB, as if just made.
  void place(const Eigen::Isometry3d& X_WB);
  /// From now on moves with the link, at X_LB.
  void attach_to(LinkId link, const Eigen::Isometry3d& X_LB);
  /// A driven body sets off for its link's next pose at the velocity that takes it there in 1 / rate seconds, and
  /// arrives once the step's velocities are solved: contacts are found where it starts, as for every other body, so
  /// that what it reaches at the end of the step is pushed in that step, and what it does not reach is not.
  void drive(const Eigen::Isometry3d& X_WL, double rate);
  void arrive(const Eigen::Isometry3d& X_WL);
  void apply_gravity();
  /// Moves a free body by its velocity, counts its steps of rest.
  void integrate(double step_s);
  void wake();
  void put_to_sleep(const Eigen::Isometry3d& X_WB);

  Eigen::Isometry3d X_WB() const;
  Eigen::Vector3d linear_velocity() const;   // of the centre of mass (m/s)
  Eigen::Vector3d angular_velocity() const;  // rad/s

  btRigidBody* bullet() const { return rigid_.get(); }
  Role role() const { return role_; }
  /// Who the body counts as: links and what they hold are the robot.
  ObjectId name() const { return role_ == Role::driven ? kRobot : id_; }
  ObjectId id() const { return id_; }
  LinkId link() const { return link_; }
  /// Of the shape, widened by how far contact points reach and, if that is much, by travel().
  const Bounds& bounds() const { return bounds_; }
  /// In the object's frame: holds bounds() wherever the body rests.
  World::Ball ball() const;
  /// How far any of its points can get in this step at its present velocity (m). Set by drive() and integrate().
  double travel() const { return travel_; }
  bool awake() const { return awake_; }    // free bodies only
  bool moving() const { return moving_; }  // driven bodies: in this step
  bool active() const { return awake_ || moving_; }
  bool has_box() const { return has_box_; }
  int rest_steps() const { return rest_steps_; }
  void limit_rest(int steps) { rest_steps_ = std::min(rest_steps_, steps); }

  bool present = true;
  bool ignores_robot = false;

 private:
  void rest_at(const Eigen::Isometry3d& X_WB);
  void update_bounds();
  void update_travel(double step_s);
  void resist_rolling();
  void become(Role role);

  std::unique_ptr<BodyShape> shape_;  // none: the floor
  std::unique_ptr<struct FloorShape> floor_;
  std::unique_ptr<btRigidBody> rigid_;
  Role role_ = Role::still;
  ObjectId id_;
  double mass_ = 0;  // kg, while free
  LinkId link_;      // while driven
  Eigen::Isometry3d X_LC_ = Eigen::Isometry3d::Identity();
  double margin_ = 0;  // m, how far contact points reach
  double radius_ = 0;  // m, about the centre of mass
  double travel_ = 0;
  std::vector<Eigen::Vector3d> rolling_axes_;  // of cylinders, in C; zero for spheres
  Bounds bounds_{};
  bool has_box_ = false;
  bool awake_ = false, moving_ = false;
  int rest_steps_ = 0;
};

}  // namespace mamo
