#include "mamo/lattice/goal_chain.hpp"

#include <numbers>

#include "mamo/common/random.hpp"
#include "mamo/common/stop.hpp"

namespace mamo {
namespace {

struct Tree {
  struct Node {
    Eigen::VectorXd q;
    int parent;
  };
  std::vector<Node> nodes;

  int nearest(const Eigen::VectorXd& q) const {
    int best = 0;
    double best_distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double d = (nodes[i].q - q).squaredNorm();
      if (d < best_distance) best_distance = d, best = static_cast<int>(i);
    }
    return best;
  }
  std::vector<Eigen::VectorXd> to_root(int node) const {
    std::vector<Eigen::VectorXd> path;
    for (; node >= 0; node = nodes[static_cast<std::size_t>(node)].parent)
      path.push_back(nodes[static_cast<std::size_t>(node)].q);
    return path;
  }
};

class Connector {
 public:
  Connector(const Problem& problem, CollisionChecker& checker, const ObjectSet& walls, const GoalChainOptions& options)
      : problem_(problem), checker_(checker), walls_(walls), options_(options) {}

  /// Path from the start to some goal; empty when the budget of nodes is used up.
  std::vector<Eigen::VectorXd> connect(const std::vector<Eigen::VectorXd>& goals, RandomStream& random,
                                       StopSource* stop) {
    Tree trees[2];
    trees[0].nodes.push_back({problem_.q_start, -1});
    for (const Eigen::VectorXd& q : goals) trees[1].nodes.push_back({q, -1});
    int side = 0;
    while (static_cast<int>(trees[0].nodes.size() + trees[1].nodes.size()) < options_.max_nodes &&
           attempts_++ < 4 * options_.max_nodes) {
      if (stop && stop->stopped()) return {};
      Tree &grown = trees[side], &other = trees[1 - side];
      bool reached = false;
      const int node = extend(grown, sample(random), reached);
      side = 1 - side;
      if (node < 0) continue;
      const Eigen::VectorXd target = grown.nodes[static_cast<std::size_t>(node)].q;
      for (int last = -1;;) {
        last = extend(other, target, reached);
        if (last < 0) break;
        if (!reached) continue;
        const int from_start = side == 1 ? node : last, to_goal = side == 1 ? last : node;
        std::vector<Eigen::VectorXd> path = trees[0].to_root(from_start);
        std::reverse(path.begin(), path.end());
        const std::vector<Eigen::VectorXd> rest = trees[1].to_root(to_goal);
        path.insert(path.end(), rest.begin() + 1, rest.end());
        return path;
      }
    }
    return {};
  }

  void shorten(std::vector<Eigen::VectorXd>& path, RandomStream& random) {
    for (int k = 0; k < options_.shortcuts && path.size() > 2; ++k) {
      const std::size_t i = random.below(path.size() - 2);
      const std::size_t j = i + 2 + random.below(path.size() - i - 2);
      if (free(path[i], path[j]))
        path.erase(path.begin() + static_cast<std::ptrdiff_t>(i) + 1, path.begin() + static_cast<std::ptrdiff_t>(j));
    }
  }

 private:
  bool free(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return checker_.check_edge(a, b, walls_, none_, report_);
  }

  Eigen::VectorXd sample(RandomStream& random) const {
    Eigen::VectorXd q(problem_.robot.dof());
    for (int i = 0; i < problem_.robot.dof(); ++i) {
      const Joint& j = problem_.robot.joint(i);
      q[i] = random.uniform(std::max(j.lower, problem_.q_start[i] - std::numbers::pi),
                            std::min(j.upper, problem_.q_start[i] + std::numbers::pi));
    }
    return q;
  }

  int extend(Tree& tree, const Eigen::VectorXd& target, bool& reached) {
    const int parent = tree.nearest(target);
    const Eigen::VectorXd& from = tree.nodes[static_cast<std::size_t>(parent)].q;
    const double distance = (target - from).norm();
    reached = distance <= options_.step;
    const Eigen::VectorXd q = reached ? target : Eigen::VectorXd(from + (target - from) * (options_.step / distance));
    if (!free(from, q)) return -1;
    tree.nodes.push_back({q, parent});
    return static_cast<int>(tree.nodes.size()) - 1;
  }

  const Problem& problem_;
  CollisionChecker& checker_;
  const ObjectSet& walls_;
  const ObjectSet none_;
  const GoalChainOptions& options_;
  CollisionReport report_;
  int attempts_ = 0;
};

std::vector<Eigen::VectorXd> subdivided(const std::vector<Eigen::VectorXd>& path, double spacing) {
  std::vector<Eigen::VectorXd> out{path.front()};
  for (std::size_t k = 1; k < path.size(); ++k) {
    const int pieces = std::max(1, static_cast<int>(std::ceil((path[k] - path[k - 1]).norm() / spacing)));
    for (int i = 1; i < pieces; ++i)
      out.push_back(path[k - 1] + (path[k] - path[k - 1]) * (static_cast<double>(i) / pieces));
    out.push_back(path[k]);
  }
  return out;
}

}  // namespace

std::vector<GoalChain> make_goal_chains(const Problem& problem, CollisionChecker& checker, const ObjectSet& walls,
                                        const std::vector<Eigen::VectorXd>& goals, std::uint64_t seed,
                                        const GoalChainOptions& options, StopSource* stop) {
  std::vector<GoalChain> chains;
  if (goals.empty()) return chains;
  checker.set_state(WorldState::start_of(problem.scene));
  for (int k = 0; k < options.chains; ++k) {
    RandomStream random(seed, {0x636861696e, static_cast<std::uint64_t>(k)});
    Connector connector(problem, checker, walls, options);
    std::vector<Eigen::VectorXd> path = connector.connect(goals, random, stop);
    if (path.size() < 2) continue;
    connector.shorten(path, random);
    GoalChain chain;
    chain.q = subdivided(path, options.spacing);
    while (goals[static_cast<std::size_t>(chain.goal)] != path.back()) ++chain.goal;
    chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace mamo
