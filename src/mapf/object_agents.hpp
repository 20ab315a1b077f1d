// Movable objects as the agents of conflict-based search (search::AgentDomain). Made for one call.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "mapf/region_shadow.hpp"

#include "mamo/search/agent_domain.hpp"

namespace mamo::mapf {

/// One movable object. The pose in the plane is `start` in its first cell and the cell's centre elsewhere.
struct ObjectAgent {
  ObjectId object;
  Footprint footprint;
  Eigen::Vector2d start;  // m
  GridCell start_cell;
  search::AgentNode start_node = 0;  // grid.size(): not on the grid, cannot move
  const InvalidGoals* invalid = nullptr;
  bool starts_clear = false;  // of the region

  /// Made when the agent is planned: most never are.
  struct Field {
    std::shared_ptr<const Surroundings> surroundings;
    std::vector<double> start_distance;    // to each obstacle (m)
    std::vector<std::uint8_t> cost;        // as Surroundings::cost, with what the start allows
    std::vector<search::Cost> penalty;     // of ending, kUnreachable: no goal
    std::vector<search::Cost> to_go;       // steps and penalty
    std::vector<search::Cost> cost_to_go;  // sum of `cost` on the way to a goal
  };
  std::optional<Field> field;
};

/// Agents on the cells of a grid. Bodies that touch at the start may touch: a pair may overlap as deep as it does
/// then, and half a cell deeper within one cell of the start, so that nothing is stuck where it stands.
class ObjectAgents {
 public:
  struct Witness {
    Eigen::Vector3d p_W{0, 0, 0};        // a point inside both bodies,
    int agent[2] = {-1, -1};             // or, if these are set, the two
    search::AgentNode node[2] = {0, 0};  // places themselves
  };
  /// What stays around an agent that is about to be planned.
  using SurroundingsOf = std::function<std::shared_ptr<const Surroundings>(const ObjectAgent&)>;

  ObjectAgents(const CellGrid& grid, const ObjectPathsOptions& options, std::vector<ObjectAgent> agents,
               RegionShadow& region, SurroundingsOf surroundings_of);

  const ObjectAgent& agent(int a) const { return agents_[static_cast<std::size_t>(a)]; }
  Eigen::Vector2d position(int a, search::AgentNode n) const {
    return n == agent(a).start_node ? agent(a).start : grid_.centre(grid_.at(n));
  }
  /// May the planned agent's centre be at p, as far as what stays is concerned?
  bool allowed(int a, const Eigen::Vector2d& p) const;

  int agents() const { return static_cast<int>(agents_.size()); }
  search::AgentNode start(int a) const { return agent(a).start_node; }
  void moves(int a, search::AgentNode n, std::vector<search::AgentMove>& out);
  search::Cost penalty(int a, search::AgentNode n);
  search::Cost heuristic(int a, search::AgentNode n);
  search::Cost preference(int a, search::AgentNode n);
  search::Cost preference_to_go(int a, search::AgentNode n);
  bool conflict(int a, search::AgentNode m, int b, search::AgentNode n);
  Witness witness(int a, search::AgentNode m, int b, search::AgentNode n);
  bool violates(int a, search::AgentNode n, const Witness& w) const;

 private:
  struct Pair {
    std::vector<PlanarShape> shapes;  // where the first may not be, relative to the second
    double start_distance = 0;        // m
  };

  const ObjectAgent::Field& field(int a);
  void allow_what_the_start_allows(int a, ObjectAgent::Field& field) const;
  search::Cost penalty_at(const ObjectAgent& agent, const GridCell& cell) const;
  std::vector<search::Cost> flood(const std::vector<search::Cost>& seeds, const std::vector<std::uint8_t>& cost,
                                  bool unit) const;
  bool near_start(int a, const Eigen::Vector2d& p) const;
  const Pair& pair(int a, int b);

  const CellGrid& grid_;
  const ObjectPathsOptions& options_;
  std::vector<ObjectAgent> agents_;
  RegionShadow& region_;
  SurroundingsOf surroundings_of_;
  std::vector<std::optional<Pair>> pairs_;
};

}  // namespace mamo::mapf
