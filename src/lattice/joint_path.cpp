#include "mamo/lattice/joint_path.hpp"

#include <algorithm>
#include <numbers>

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
  Connector(const Robot& robot, CollisionChecker& checker, const JointPathQuery& query, RandomStream& random,
            const JointPathOptions& options)
      : robot_(robot), checker_(checker), query_(query), random_(random), options_(options) {}

  std::vector<Eigen::VectorXd> direct() {
    for (const Eigen::VectorXd& goal : query_.goals)
      if (free(query_.start, goal)) return {query_.start, goal};
    return {};
  }

  std::vector<Eigen::VectorXd> connect(StopSource* stop) {
    Tree trees[2];
    trees[0].nodes.push_back({query_.start, -1});
    for (const Eigen::VectorXd& q : query_.goals) trees[1].nodes.push_back({q, -1});
    int side = 0;
    for (int rounds = 0; static_cast<int>(trees[0].nodes.size() + trees[1].nodes.size()) < options_.max_nodes &&
                         rounds < 4 * options_.max_nodes;
         ++rounds) {
      if (stop && stop->stopped()) return {};
      Tree &grown = trees[side], &other = trees[1 - side];
      bool reached = false;
      const int node = extend(grown, sample(), reached);
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

  void shorten(std::vector<Eigen::VectorXd>& path) {
    for (int k = 0; k < options_.shortcuts && path.size() > 2; ++k) {
      const std::size_t i = random_.below(path.size() - 2);
      const std::size_t j = i + 2 + random_.below(path.size() - i - 2);
      if (free(path[i], path[j]))
        path.erase(path.begin() + static_cast<std::ptrdiff_t>(i) + 1, path.begin() + static_cast<std::ptrdiff_t>(j));
    }
  }

 private:
  bool free(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    if (query_.accept) {
      const int pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / query_.accept_step)));
      for (int i = 1; i <= pieces; ++i)
        if (!query_.accept(a + (b - a) * (static_cast<double>(i) / pieces))) return false;
    }
    return checker_.check_edge(a, b, query_.forbidden, query_.avoided, report_) && report_.touched.empty();
  }

  Eigen::VectorXd sample() {
    Eigen::VectorXd q(robot_.dof());
    for (int i = 0; i < robot_.dof(); ++i) {
      const Joint& j = robot_.joint(i);
      q[i] = random_.uniform(std::max(j.lower, query_.start[i] - std::numbers::pi),
                             std::min(j.upper, query_.start[i] + std::numbers::pi));
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

  const Robot& robot_;
  CollisionChecker& checker_;
  const JointPathQuery& query_;
  RandomStream& random_;
  const JointPathOptions& options_;
  CollisionReport report_;
};

}  // namespace

std::vector<Eigen::VectorXd> find_joint_path(const Robot& robot, CollisionChecker& checker, const JointPathQuery& query,
                                             RandomStream random, const JointPathOptions& options, StopSource* stop) {
  Connector connector(robot, checker, query, random, options);
  if (options.direct)
    if (std::vector<Eigen::VectorXd> path = connector.direct(); !path.empty()) return path;
  std::vector<Eigen::VectorXd> path = connector.connect(stop);
  connector.shorten(path);
  return path;
}

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

}  // namespace mamo
