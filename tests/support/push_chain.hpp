// Several pushes one after the other, as a plan, and how far their continuous replay is from what was planned.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "mamo/model/plan.hpp"
#include "mamo/push/push_planner.hpp"
#include "mamo/verify/verifier.hpp"

namespace mamo::fixtures {

inline Segment segment(const Problem& problem, SegmentKind kind, ObjectId object,
                       const std::vector<Eigen::VectorXd>& path, double wait_s) {
  Segment out;
  out.kind = kind;
  out.object = object;
  for (int i = 0; i < problem.robot.dof(); ++i) out.joint_names.push_back(problem.robot.joint(i).name);
  const double step_s = problem.scene.physics.step;
  out.motion = time_path(problem.robot, path, step_s);
  if (const long steps = std::lround(wait_s / step_s); steps > 0) {
    out.motion.t.push_back(static_cast<double>(std::lround(out.motion.t.back() / step_s) + steps) * step_s);
    out.motion.q.push_back(out.motion.q.back());
  }
  return out;
}

struct Chain {
  Plan plan;
  std::vector<WorldState> after;  // each push
};

/// Random pushes one after the other, each from where the one before left the objects.
inline Chain random_chain(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                          const std::vector<PushRequest>& requests, int pushes, const PushOptions& options,
                          std::uint64_t seed) {
  PushPlanner planner(problem, std::move(kinematics), options, seed);
  RandomStream random(seed, {1});
  Chain chain;
  WorldState state = WorldState::start_of(problem.scene);
  for (int tries = 0; tries < 40 && static_cast<int>(chain.after.size()) < pushes; ++tries) {
    PushRequest request = requests[random.below(requests.size())];
    const Eigen::Vector2d moved = state.X_WO(request.object).translation().head<2>() - request.path.front();
    for (Eigen::Vector2d& p : request.path) p += moved;
    request.state = state;
    const PushOutcome out = planner.attempt(request, nullptr, nullptr);
    if (!out.valid()) continue;
    chain.plan.segments.push_back(segment(problem, SegmentKind::approach, request.object, out.approach, 0));
    chain.plan.segments.push_back(segment(problem, SegmentKind::push, request.object, out.push, out.settle_s));
    chain.plan.segments.push_back(segment(problem, SegmentKind::retreat, request.object, out.retreat, 0));
    chain.after.push_back(out.after);
    state = out.after;
  }
  return chain;
}

/// Sums over chains.
struct Agreement {
  std::vector<double> first_mm, later_mm;  // of each object that moved, at the end of each push
  std::vector<std::string> violations;     // of the replay
  int chains = 0, pushes = 0;

  void add(const Problem& problem, const Chain& chain) {
    if (chain.after.empty()) return;
    ++chains;
    pushes += static_cast<int>(chain.after.size());
    StopSource stop;
    const Verdict verdict = Verifier({0.004, 1.0}).judge(problem, chain.plan, stop);
    for (const Verdict::Finding& finding : verdict.findings)
      if (finding.violation.kind != ViolationKind::task_not_done)  // nothing is retrieved here
        violations.push_back(finding.text);
    for (std::size_t k = 0; k < chain.after.size() && 3 * k + 2 < verdict.objects_after.size(); ++k)
      for (const auto& [id, X_WO] : verdict.objects_after[3 * k + 2])
        if (chain.after[k][id] != WorldState::start_of(problem.scene)[id])
          (k == 0 ? first_mm : later_mm)
              .push_back(1e3 * (X_WO.translation() - chain.after[k].X_WO(id).translation()).norm());
  }
  static double quantile(std::vector<double> v, double p) {
    if (v.empty()) return 0;
    std::sort(v.begin(), v.end());
    return v[static_cast<std::size_t>(p * static_cast<double>(v.size() - 1))];
  }
  void print() const {
    for (const auto& [name, mm] : {std::pair("first", first_mm), std::pair("later", later_mm)})
      std::printf("replay of the %s push: objects off by 50%% %.3f  75%% %.3f  90%% %.3f  100%% %.3f mm (%zu)\n", name,
                  quantile(mm, 0.5), quantile(mm, 0.75), quantile(mm, 0.9), quantile(mm, 1), mm.size());
    std::printf("replay: %zu of %d chains (%d pushes) violate something\n", violations.size(), chains, pushes);
  }
};

}  // namespace mamo::fixtures
