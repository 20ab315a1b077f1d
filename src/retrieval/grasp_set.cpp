#include "retrieval/grasp_set.hpp"

#include <algorithm>
#include <atomic>
#include <numbers>

#include "retrieval/grasp_poses.hpp"
#include "retrieval/tip_line.hpp"

#include "mamo/kinematics/inverse_kinematics.hpp"

namespace mamo::retrieval {
namespace {

constexpr std::uint64_t kIkKey = 0x67726173, kWayKey = 0x776179, kStartKey = 0x7374, kApproachKey = 0x617070;
constexpr double kReachStep = 0.01, kLiftStep = 0.005, kBackStep = 0.02;  // m, of the lines of the tip
constexpr double kClearance = 0.1;    // m: the line back may end where the tip is so far outside the objects' space
constexpr double kLongestBack = 0.7;  // m
constexpr int kFirstNodes = 300;    // of the search for each way home; a way that needs more waits until it is wanted,
constexpr int kFirstFailures = 16;  // and so does, once so many searches have failed, whatever needs a search
constexpr int kLastNodes = 4;       // times the budget of a call, where no way home was found at all
constexpr std::size_t kJoined = 8;  // ways that another may join, the latest ones

/// What came of one grasp pose: candidates with the beginning of their ways home, and why others are none.
struct Tried {
  std::vector<GraspCandidate> candidates;
  std::vector<WayHome> ways;
  std::vector<std::string> rejected;
};

/// Looks at one grasp pose at a time. One per worker; what it finds depends on the pose only.
class Grasper {
 public:
  Grasper(const GraspSet& set, CollisionChecker& checker)
      : set_(set),
        around_(set.around),
        ik_(*around_.kinematics),
        legs_(around_, checker, WorldState::start_of(around_.problem.scene), ObjectSet(around_.problem.scene.size())),
        space_(object_space(around_.problem.scene)) {}

  Tried look_at(const GraspPose& pose, std::size_t g) {
    Tried tried;
    std::string cause = "grasp_without_ik";
    const auto accept = [&](const Eigen::VectorXd& q) {
      if (legs_.free(Phase::reach, q)) return true;
      cause = "grasp_in_collision: " + legs_.hit();
      return false;
    };
    const std::vector<Eigen::VectorXd> solutions = ik_.solve_many(
        pose.X_WT, around_.task().home, hash_combine(mix64(set_.seed ^ kIkKey), g), set_.options.solutions, {}, accept);
    if (solutions.empty()) tried.rejected.push_back(cause);
    for (const Eigen::VectorXd& q : solutions) {
      cause = add(pose, q, tried);
      if (!cause.empty()) tried.rejected.push_back(cause);
    }
    return tried;
  }

 private:
  /// Empty: a candidate was added; else why not.
  std::string add(const GraspPose& pose, const Eigen::VectorXd& q, Tried& tried) {
    const Eigen::Isometry3d X_WT = around_.kinematics->tip_pose(q);
    const Eigen::Vector3d out = pose.X_WT_pregrasp.translation() - pose.X_WT.translation();
    GraspCandidate candidate;
    candidate.X_WT = X_WT;
    candidate.X_TO = X_WT.inverse() * around_.problem.scene[around_.task().object].X_WO;
    candidate.reach = follow_line(ik_, q, X_WT, out, kReachStep);
    if (candidate.reach.size() < line_points(out, kReachStep)) return "reach_without_ik";
    std::reverse(candidate.reach.begin(), candidate.reach.end());
    if (!legs_.free(Phase::approach, candidate.reach.front())) return "pregrasp_in_collision: " + legs_.hit();
    if (!legs_.free(Phase::reach, candidate.reach)) return "reach_in_collision: " + legs_.hit();
    legs_.grip(q);
    if (std::string cause = lift(candidate, X_WT); !cause.empty()) return cause;
    WayHome way;
    line_back(candidate, out, way);
    tried.candidates.push_back(std::move(candidate));
    tried.ways.push_back(std::move(way));
    return {};
  }

  /// As high as asked for; half as high as it goes where something is above.
  std::string lift(GraspCandidate& candidate, const Eigen::Isometry3d& X_WT) {
    const Eigen::Vector3d up(0, 0, set_.options.lift);
    std::vector<Eigen::VectorXd> line = follow_line(ik_, candidate.reach.back(), X_WT, up, kLiftStep);
    if (line.size() < 2) return "lift_without_ik";
    if (!legs_.free(Phase::leave, line[0], line[1])) return "lift_in_collision: " + legs_.hit();
    std::size_t points = 2;
    while (points < line.size() && legs_.free(Phase::carry, line[points - 1], line[points])) ++points;
    if (points < line_points(up, kLiftStep)) points = points / 2 + 1;
    line.resize(points);
    candidate.lift = std::move(line);
    if (!legs_.free(Phase::carry, candidate.lift.back())) return "lift_in_collision: " + legs_.hit();
    return {};
  }

  /// From lifted back above the pre-grasp pose, and on until the tip is outside where objects can be.
  void line_back(const GraspCandidate& candidate, const Eigen::Vector3d& out, WayHome& way) {
    const Eigen::VectorXd& lifted = candidate.lift.back();
    const std::vector<Eigen::VectorXd> first =
        follow_line(ik_, lifted, around_.kinematics->tip_pose(lifted), out, kReachStep);
    way.path = {lifted};
    extend(first, way);
    if (way.path.size() == line_points(out, kReachStep)) {
      way.over_pregrasp = way.path.size() - 1;
      const Eigen::Isometry3d X_WT = around_.kinematics->tip_pose(way.path.back());
      extend(follow_line(ik_, way.path.back(), X_WT, way_out(X_WT.translation(), out.normalized()), kBackStep), way);
    }
    way.line_end = way.path.size() - 1;
  }

  void extend(const std::vector<Eigen::VectorXd>& line, WayHome& way) {
    for (std::size_t k = 1; k < line.size() && legs_.free(Phase::carry, way.path.back(), line[k]); ++k)
      way.path.push_back(line[k]);
  }

  /// The shift along `direction` that takes the tip out of the objects' space.
  Eigen::Vector3d way_out(const Eigen::Vector3d& tip, const Eigen::Vector3d& direction) const {
    Eigen::AlignedBox3d around = space_;
    around.min().array() -= kClearance;
    around.max().array() += kClearance;
    double length = kBackStep;
    while (length < kLongestBack && around.contains(tip + length * direction)) length += kBackStep;
    return length * direction;
  }

  const GraspSet& set_;
  const Surroundings& around_;
  InverseKinematics ik_;
  Legs legs_;
  Eigen::AlignedBox3d space_;
};

/// Connects candidates with home, block by block: a way may join ways of the blocks before. Within a block nothing
/// depends on anything else of it, so the workers share it, and the outcome does not depend on how many they are.
class WayFinder {
 public:
  WayFinder(GraspSet& set, Executor& executor, const std::vector<CollisionChecker*>& checkers)
      : set_(set), executor_(executor) {
    const Problem& problem = set.around.problem;
    for (CollisionChecker* checker : checkers)
      legs_.push_back(std::make_unique<Legs>(set.around, *checker, WorldState::start_of(problem.scene),
                                             ObjectSet(problem.scene.size())));
  }

  void run() {
    connect_start();
    for (std::size_t first = 0; first < set_.ways.size();) {
      // Where the first search fails many will.
      const std::size_t wanted = !known_.empty() ? kBlock : failed_ > 0 ? kBlock / 2 : 1;
      const std::size_t size = std::min({wanted, kBlock, set_.ways.size() - first});
      find_ways(first, size, {failed_ < kFirstFailures ? kFirstNodes : 0});
      first += size;
    }
    for (std::size_t c = 0; c < set_.ways.size() && known_.empty(); ++c)
      find_ways(c, 1, {kLastNodes * set_.options.max_nodes});
  }

 private:
  static constexpr std::size_t kBlock = 16;

  void connect_start() {
    const Eigen::VectorXd &start = set_.around.problem.q_start, &home = set_.around.task().home;
    if (start == home)
      set_.from_start = {start};
    else
      set_.from_start = legs_.front()->search(Phase::approach, start, {home}, RandomStream(set_.seed, {kStartKey}),
                                              {kLastNodes * set_.options.max_nodes}, nullptr);
  }

  void find_ways(std::size_t first, std::size_t size, const JointPathOptions& options) {
    std::vector<Suffix> others;
    for (std::size_t k = known_.size(); k-- > 0 && others.size() < kJoined;)
      others.push_back({&set_.ways[known_[k]], set_.ways[known_[k]].line_end});
    std::atomic<std::size_t> next{first};
    const auto work = [&](WorkerId worker) {
      for (std::size_t c = next++; c < first + size; c = next++) find_way(*legs_[worker.index()], c, others, options);
    };
    if (size == 1)
      work(WorkerId(0));
    else
      executor_.run(work);
    for (std::size_t c = first; c < first + size; ++c)
      if (set_.ways[c].known)
        known_.push_back(c);
      else
        ++failed_;
  }

  void find_way(Legs& legs, std::size_t c, const std::vector<Suffix>& others, const JointPathOptions& options) {
    legs.grip(set_.candidates[c].reach.back());
    if (find_rest(set_, legs, set_.ways[c], others, RandomStream(set_.seed, {kWayKey, c}), options, nullptr))
      set_.ways[c].approach = find_approach(set_, legs, set_.ways[c], set_.candidates[c].reach.front(),
                                            RandomStream(set_.seed, {kApproachKey, c}), options, nullptr);
  }

  GraspSet& set_;
  Executor& executor_;
  std::vector<std::unique_ptr<Legs>> legs_;  // one per worker
  std::vector<std::size_t> known_;           // candidates with a way home
  int failed_ = 0;                           // candidates without
};

}  // namespace

GraspSet::GraspSet(const Problem& problem, std::shared_ptr<const ForwardKinematics> kinematics,
                   const RetrievalOptions& options_in, std::uint64_t seed_in, Executor& executor,
                   const std::vector<CollisionChecker*>& checkers)
    : around(problem, std::move(kinematics), options_in.max_object_tilt_deg * std::numbers::pi / 180),
      options(options_in),
      seed(seed_in) {
  const std::vector<GraspPose> poses =
      grasp_poses(problem.scene[around.task().object], around.task().X_WT_pregrasp, options.grasps);
  std::vector<Tried> tried(poses.size());
  std::atomic<std::size_t> next{0};
  executor.run([&](WorkerId worker) {
    Grasper grasper(*this, *checkers[worker.index()]);
    for (std::size_t g = next++; g < poses.size(); g = next++) tried[g] = grasper.look_at(poses[g], g);
  });
  for (Tried& t : tried) {
    std::ranges::move(t.candidates, std::back_inserter(candidates));
    std::ranges::move(t.ways, std::back_inserter(ways));
    for (const std::string& cause : t.rejected) ++rejected[cause];
  }
  WayFinder(*this, executor, checkers).run();
}

bool find_rest(const GraspSet& grasps, Legs& legs, WayHome& way, const std::vector<Suffix>& others, RandomStream random,
               const JointPathOptions& options, StopSource* stop) {
  const Eigen::VectorXd& home = grasps.around.task().home;
  struct Source {
    std::size_t other, index;
  };
  std::vector<Source> sources{{0, 0}};
  std::vector<Eigen::VectorXd> goals{home};
  for (std::size_t k = 0; k < others.size(); ++k)
    for (std::size_t i = others[k].way->path.size() - 1; i-- > others[k].from;) {
      goals.push_back(others[k].way->path[i]);
      sources.push_back({k, i});
    }
  std::vector<Eigen::VectorXd> rest = legs.search(Phase::carry, way.path.back(), goals, random, options, stop);
  if (rest.empty()) return false;
  const auto reached = static_cast<std::size_t>(std::find(goals.begin(), goals.end(), rest.back()) - goals.begin());
  if (reached > 0) {
    const std::vector<Eigen::VectorXd>& other = others[sources[reached].other].way->path;
    rest.insert(rest.end(), other.begin() + static_cast<std::ptrdiff_t>(sources[reached].index) + 1, other.end());
    // The other way was checked with the object held otherwise.
    if (!legs.free(Phase::carry, rest)) {
      rest = legs.search(Phase::carry, way.path.back(), {home}, random, options, stop);
      if (rest.empty()) return false;
    }
  }
  way.path.insert(way.path.end(), rest.begin() + 1, rest.end());
  way.known = true;
  return true;
}

std::vector<Eigen::VectorXd> find_approach(const GraspSet& grasps, Legs& legs, const WayHome& way,
                                           const Eigen::VectorXd& pregrasp, RandomStream random,
                                           const JointPathOptions& options, StopSource* stop) {
  if (way.over_pregrasp > 0 && !grasps.from_start.empty()) {
    std::vector<Eigen::VectorXd> path = grasps.from_start;
    path.insert(path.end(), way.path.rbegin() + 1, way.path.rend() - static_cast<std::ptrdiff_t>(way.over_pregrasp));
    path.push_back(pregrasp);
    if (legs.free(Phase::approach, path)) return path;
  }
  return legs.search(Phase::approach, grasps.around.problem.q_start, {pregrasp}, random, options, stop);
}

}  // namespace mamo::retrieval
