#include "baselines/ompl_query.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <limits>
#include <mutex>

#include "baselines/ompl_arm_space.hpp"

#include "mamo/common/random.hpp"

namespace mamo {
namespace ob = ompl::base;
namespace og = ompl::geometric;
namespace {

constexpr std::uint64_t kTrees = 0x6f6d706c;  // "ompl"

/// OMPL's generators draw their seeds from one that the process has once. Whoever makes some holds this.
std::mutex& seeding() {
  static std::mutex mutex;
  return mutex;
}

std::uint_fast32_t narrow(std::uint64_t seed) { return static_cast<std::uint_fast32_t>((seed >> 33) | 1); }

class Rrt final : public og::RRT {
 public:
  Rrt(const ob::SpaceInformationPtr& si, std::uint64_t seed) : og::RRT(si) {
    rng_.setLocalSeed(narrow(seed));
    // The default structure draws pivots from a generator that nobody can seed.
    setNearestNeighbors<ompl::NearestNeighborsLinear>();
  }
};

class Kpiece final : public og::KPIECE1 {
 public:
  Kpiece(const ob::SpaceInformationPtr& si, std::uint64_t seed) : og::KPIECE1(si) { rng_.setLocalSeed(narrow(seed)); }
};

}  // namespace

/// A step is a motion judged by the evaluation; where it leaves the objects is written into its end.
class SamplingQuery::Motions final : public ob::MotionValidator {
 public:
  Motions(const ob::SpaceInformationPtr& si, const ArmSpace& space, SamplingQuery& query)
      : ob::MotionValidator(si), space_(space), query_(query) {}

  bool checkMotion(const ob::State* s1, const ob::State* s2) const override {
    return reach(s1, space_.q(s2), const_cast<ob::State*>(s2));  // OMPL copies the state into its tree after this
  }
  bool checkMotion(const ob::State* s1, const ob::State* s2, std::pair<ob::State*, double>& last) const override {
    const Eigen::VectorXd q0 = space_.q(s1), q1 = space_.q(s2);
    if (reach(s1, q1, const_cast<ob::State*>(s2))) return true;
    last.second = query_.free_share(q0, q1, ArmSpace::objects(s1));
    if (last.second <= 0 || !reach(s1, q0 + last.second * (q1 - q0), last.first)) {
      last.second = 0;
      space_.copyState(last.first, s1);
    }
    return false;
  }

 private:
  bool reach(const ob::State* from, const Eigen::VectorXd& q, ob::State* to) const {
    EdgeResult edge = query_.propagate(space_.q(from), q, ArmSpace::objects(from));
    if (!edge.valid) return false;
    auto objects = static_cast<const ArmSpace::StateType*>(from)->objects;
    if (edge.simulated) objects = std::make_shared<const WorldState>(std::move(edge.state));
    space_.set(to, q, std::move(objects));
    return true;
  }

  const ArmSpace& space_;
  SamplingQuery& query_;
};

/// From here the object can be fetched: near a pre-grasp, and simulation agrees.
class SamplingQuery::Goal final : public ob::GoalSampleableRegion {
 public:
  Goal(const ob::SpaceInformationPtr& si, const ArmSpace& space, SamplingQuery& query, std::uint64_t seed)
      : ob::GoalSampleableRegion(si), space_(space), query_(query), random_(seed, {}) {
    setThreshold(query.settings_.goal_distance);
  }

  const RetrievalPath* way() const { return way_; }

  void sampleGoal(ob::State* state) const override {
    space_.set(state, query_.ways()[random_.below(query_.ways().size())].reach.front(), space_.start());
  }
  unsigned int maxSampleCount() const override { return std::numeric_limits<unsigned int>::max(); }
  double distanceGoal(const ob::State* state) const override {
    const Eigen::VectorXd q = space_.q(state);
    double least = std::numeric_limits<double>::infinity();
    for (const RetrievalPath& way : query_.ways()) least = std::min(least, (q - way.reach.front()).norm());
    return least;
  }
  bool isSatisfied(const ob::State* state) const override { return isSatisfied(state, nullptr); }
  bool isSatisfied(const ob::State* state, double* distance) const override {
    if (distance) *distance = distanceGoal(state);
    const Eigen::VectorXd q = space_.q(state);
    for (const RetrievalPath& way : query_.ways()) {
      if ((q - way.reach.front()).norm() > threshold_ || query_.at_an_end()) continue;
      if (!query_.completes(q, ArmSpace::objects(state), way)) continue;
      way_ = &way;
      return true;
    }
    return false;
  }

 private:
  const ArmSpace& space_;
  SamplingQuery& query_;
  mutable RandomStream random_;
  mutable const RetrievalPath* way_ = nullptr;
};

/// What one run of OMPL's consists of.
struct SamplingQuery::Tree {
  std::shared_ptr<ArmSpace> space;
  std::shared_ptr<ob::SpaceInformation> information;
  std::shared_ptr<ob::ProblemDefinition> definition;
  std::shared_ptr<Goal> goal;
  std::shared_ptr<ob::Planner> planner;
};

SamplingQuery::SamplingQuery(SamplingAlgorithm algorithm, const Problem& problem, const PlanOptions& options,
                             const PlanContext& context, const SamplingOptions& settings)
    : GraspQuery(algorithm == SamplingAlgorithm::rrt ? "rrt" : "kpiece", problem, options, context, settings.grasp),
      algorithm_(algorithm),
      settings_(settings) {}

void SamplingQuery::search() {
  RandomStream seeds(options().seed, {kTrees});
  for (int tree = 0; tree < settings_.trees && !over(); ++tree)
    if (!grow(seeds.next())) break;
  if (!over())
    finish(PlanStatus::limit,
           "no plan within the propagations and trees allowed; max_propagations and trees raise that");
}

/// False: no use to go on.
bool SamplingQuery::grow(std::uint64_t seed) {
  const std::unique_ptr<Tree> tree = plant(seed);
  const ob::PlannerStatus status =
      tree->planner->solve(ob::PlannerTerminationCondition([this] { return at_an_end(); }));
  signature().add(result().stats.expansions);
  if (over()) return false;
  if (status != ob::PlannerStatus::EXACT_SOLUTION) return !at_an_end();
  std::vector<Eigen::VectorXd> path;
  for (const ob::State* state : tree->definition->getSolutionPath()->as<og::PathGeometric>()->getStates())
    path.push_back(tree->space->q(state));
  return submit(std::move(path), *tree->goal->way()) == Submitted::rejected;
}

std::unique_ptr<SamplingQuery::Tree> SamplingQuery::plant(std::uint64_t seed) {
  const std::lock_guard<std::mutex> lock(seeding());
  ompl::msg::noOutputHandler();  // it would report on the terminal
  ompl::RNG::setSeed(narrow(seed));
  auto tree = std::make_unique<Tree>();
  tree->space =
      std::make_shared<ArmSpace>(kinematics(), problem().q_start, WorldState::start_of(problem().scene), seed);
  tree->information = std::make_shared<ob::SpaceInformation>(tree->space);
  tree->information->setStateValidityChecker([](const ob::State*) { return true; });  // motions are judged, not states
  tree->information->setMotionValidator(std::make_shared<Motions>(tree->information, *tree->space, *this));
  tree->information->setup();
  tree->definition = std::make_shared<ob::ProblemDefinition>(tree->information);
  ob::State* start = tree->space->allocState();
  tree->space->set(start, problem().q_start, tree->space->start());
  tree->definition->addStartState(start);
  tree->space->freeState(start);
  tree->goal = std::make_shared<Goal>(tree->information, *tree->space, *this, seed);
  tree->definition->setGoal(tree->goal);
  if (algorithm_ == SamplingAlgorithm::rrt)
    tree->planner = std::make_shared<Rrt>(tree->information, seed);
  else
    tree->planner = std::make_shared<Kpiece>(tree->information, seed);
  tree->planner->setProblemDefinition(tree->definition);
  tree->planner->setup();
  return tree;
}

/// Time, simulations or propagations are used up; says so in the result.
bool SamplingQuery::at_an_end() {
  if (over()) return true;
  if (stop().stopped()) return stopped(), true;
  if (out_of_simulations()) return true;
  const std::int64_t used = result().stats.expansions;
  if (used >= options().max_expansions)
    return finish(PlanStatus::limit, "no plan within the limit on expansions; --max-expansions raises it"), true;
  if (used >= settings_.max_propagations)
    return finish(PlanStatus::limit, "no plan within max_propagations; --set max_propagations=N raises it"), true;
  return false;
}

EdgeResult SamplingQuery::propagate(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const WorldState& from) {
  if (at_an_end()) return {};
  if (++result().stats.expansions % 100 == 0) report_progress();
  for (Eigen::Index i = 0; i < q1.size(); ++i) signature().add(q1[i]);
  return step(q0, q1, from);
}

/// How far the motion goes before the arm hits itself or what it must not touch.
double SamplingQuery::free_share(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const WorldState& from) {
  checker().set_state(from);
  CollisionReport report;
  double share = 0;
  for (const double s : checker().edge_samples(q0, q1)) {
    checker().check(q0 + s * (q1 - q0), everything().forbidden, true, report);
    if (!report.free()) return share;
    share = s;
  }
  return 0;  // it was the simulation that refused: nothing is kept
}

}  // namespace mamo
