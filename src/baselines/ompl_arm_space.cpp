#include "baselines/ompl_arm_space.hpp"

#include <numbers>

namespace mamo {
namespace ob = ompl::base;
namespace {

class Sampler final : public ob::RealVectorStateSampler {
 public:
  Sampler(const ArmSpace* space, std::uint_fast32_t seed) : ob::RealVectorStateSampler(space), arm_(*space) {
    rng_.setLocalSeed(seed);
  }
  void sampleUniform(ob::State* state) override { ob::RealVectorStateSampler::sampleUniform(state), begin(state); }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    ob::RealVectorStateSampler::sampleUniformNear(state, near, distance), begin(state);
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    ob::RealVectorStateSampler::sampleGaussian(state, mean, deviation), begin(state);
  }

 private:
  void begin(ob::State* state) const { static_cast<ArmSpace::StateType*>(state)->objects = arm_.start(); }
  const ArmSpace& arm_;
};

class TipPosition final : public ob::ProjectionEvaluator {
 public:
  explicit TipPosition(const ArmSpace* space) : ob::ProjectionEvaluator(space), arm_(*space) {}
  unsigned int getDimension() const override { return 3; }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> projection) const override {
    projection = arm_.kinematics().tip_pose(arm_.q(state)).translation();
  }

 private:
  const ArmSpace& arm_;
};

}  // namespace

ArmSpace::ArmSpace(const ForwardKinematics& kinematics, const Eigen::VectorXd& q_start, WorldState start,
                   std::uint64_t seed)
    : ob::RealVectorStateSpace(static_cast<unsigned int>(q_start.size())),
      kinematics_(kinematics),
      start_(std::make_shared<const WorldState>(std::move(start))) {
  const Robot& robot = kinematics.robot();
  ob::RealVectorBounds limits(getDimension());
  for (int i = 0; i < robot.dof(); ++i) {
    const Joint& joint = robot.joint(i);
    const bool continuous = joint.type == JointType::continuous;
    limits.setLow(static_cast<unsigned>(i), continuous ? q_start[i] - std::numbers::pi : joint.lower);
    limits.setHigh(static_cast<unsigned>(i), continuous ? q_start[i] + std::numbers::pi : joint.upper);
  }
  setBounds(limits);
  // One sampler, made here: its construction draws from a generator of the whole process.
  const auto sampler = std::make_shared<Sampler>(this, static_cast<std::uint_fast32_t>(seed >> 33));
  setStateSamplerAllocator([sampler](const ob::StateSpace*) { return sampler; });
}

ob::State* ArmSpace::allocState() const {
  auto* state = new StateType();
  state->values = new double[dimension_];
  return state;
}

void ArmSpace::freeState(ob::State* state) const {
  auto* mine = static_cast<StateType*>(state);
  delete[] mine->values;
  delete mine;
}

void ArmSpace::copyState(ob::State* to, const ob::State* from) const {
  ob::RealVectorStateSpace::copyState(to, from);
  static_cast<StateType*>(to)->objects = static_cast<const StateType*>(from)->objects;
}

void ArmSpace::interpolate(const ob::State* from, const ob::State* to, double t, ob::State* state) const {
  ob::RealVectorStateSpace::interpolate(from, to, t, state);
  static_cast<StateType*>(state)->objects = static_cast<const StateType*>(from)->objects;
}

void ArmSpace::registerProjections() { registerDefaultProjection(std::make_shared<TipPosition>(this)); }

Eigen::VectorXd ArmSpace::q(const ob::State* state) const {
  return Eigen::Map<const Eigen::VectorXd>(static_cast<const StateType*>(state)->values, dimension_);
}

void ArmSpace::set(ob::State* state, const Eigen::VectorXd& q, std::shared_ptr<const WorldState> objects) const {
  auto* mine = static_cast<StateType*>(state);
  Eigen::Map<Eigen::VectorXd>(mine->values, dimension_) = q;
  mine->objects = std::move(objects);
}

}  // namespace mamo
