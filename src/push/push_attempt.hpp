// The stages of one attempt, over the tools of one worker.
#pragma once

#include <memory>
#include <vector>

#include "push/push_bodies.hpp"
#include "push/push_sampler.hpp"
#include "push/tip_follower.hpp"
#include "push/way_home.hpp"

#include "mamo/kinematics/inverse_kinematics.hpp"
#include "mamo/push/push_planner.hpp"

namespace mamo::push {

/// What one worker has. Nothing in it remembers earlier attempts.
struct PushTools {
  const Problem& problem;
  const std::shared_ptr<const ForwardKinematics> kinematics;
  const PushOptions options;
  const std::uint64_t seed;
  const PushBodies bodies;
  const PushSampler sampler;
  const InverseKinematics inverse;
  CollisionChecker checker;
  Evaluator evaluator;
  TipFollower follower;
  WayHome home;
  CollisionReport report;

  PushTools(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics, const PushOptions& options,
            std::uint64_t seed);
};

/// The joint path of a push, there only.
struct JointWay {
  std::vector<Eigen::VectorXd> q;
  std::vector<double> share;  // of the object's path, at each point; negative before the object is reached
  double end() const { return share.empty() ? 0 : share.back(); }
};

class PushAttempt {
 public:
  PushAttempt(PushTools& tools, const PushRequest& request, StopSource* stop, const std::atomic<bool>* cancel);
  PushOutcome run();

 private:
  struct Draw {
    JointWay way;
    RandomStream random;
  };

  bool stopped() const;
  void failed(PushFailure failure);
  void try_draw(int index);
  std::vector<Eigen::VectorXd> starts(const TipWay& way, RandomStream& random);
  JointWay follow(const TipWay& way, const Eigen::VectorXd& q);
  PushFailure cut_to_free(JointWay& way);
  bool quick_approach(const Draw& draw);
  bool search_approach(const Draw& draw);
  bool simulate(const Draw& draw);
  void stop_before(const Violation& violation, const Draw& draw);
  void push_first(const Draw& draw);
  void note_moved();
  void retreat(const Draw& draw);

  PushTools& tools_;
  const PushRequest& request_;
  StopSource* stop_;
  const std::atomic<bool>* cancel_;
  RandomStream random_;
  PushOutcome out_;
  bool done_ = false;
  std::vector<Draw> blocked_;  // whole ways that have no cheap approach; the first one counts
  std::vector<Draw> short_;    // ways that end early; the longest share counts
};

}  // namespace mamo::push
