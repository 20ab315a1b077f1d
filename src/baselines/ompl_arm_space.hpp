// The arm's configurations as a state space of OMPL's; each state carries where the objects are.
#pragma once

#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <memory>

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/model/world_state.hpp"

namespace mamo {

/// Euclidean, continuous joints without wrap-around (as in E-M4M's comparison): half a turn either way of the start.
class ArmSpace final : public ompl::base::RealVectorStateSpace {
 public:
  class StateType : public ompl::base::RealVectorStateSpace::StateType {
   public:
    std::shared_ptr<const WorldState> objects;
  };

  /// Both must outlive the space. Samples carry `start`.
  ArmSpace(const ForwardKinematics& kinematics, const Eigen::VectorXd& q_start, WorldState start, std::uint64_t seed);

  ompl::base::State* allocState() const override;
  void freeState(ompl::base::State* state) const override;
  void copyState(ompl::base::State* to, const ompl::base::State* from) const override;
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t,
                   ompl::base::State* state) const override;
  /// The tip's position, cells of a twentieth of its extent (OMPL's default).
  void registerProjections() override;

  Eigen::VectorXd q(const ompl::base::State* state) const;
  void set(ompl::base::State* state, const Eigen::VectorXd& q, std::shared_ptr<const WorldState> objects) const;
  static const WorldState& objects(const ompl::base::State* state) {
    return *static_cast<const StateType*>(state)->objects;
  }
  const std::shared_ptr<const WorldState>& start() const { return start_; }
  const ForwardKinematics& kinematics() const { return kinematics_; }

 private:
  const ForwardKinematics& kinematics_;
  std::shared_ptr<const WorldState> start_;
};

}  // namespace mamo
