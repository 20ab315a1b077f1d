// The first planning iteration of fullsim as a search domain, without the planner around it.
#pragma once

#include <memory>
#include <set>
#include <string>

#include "mamo/common/result.hpp"
#include "mamo/lattice/manipulation_lattice.hpp"

namespace mamo {

class LatticeSearch {
 public:
  static Result<std::unique_ptr<LatticeSearch>> load(const std::string& problem_file);

  const ManipulationLattice& lattice() const { return *lattice_; }
  EdgeEvaluator& evaluator() { return *evaluator_; }

 private:
  explicit LatticeSearch(Problem problem);

  Problem problem_;
  std::shared_ptr<const ForwardKinematics> kinematics_;
  std::set<BannedEdge> banned_;  // none
  std::unique_ptr<EdgeEvaluator> evaluator_;
  std::unique_ptr<LatticeModel> model_;
  std::unique_ptr<ManipulationLattice> lattice_;
};

}  // namespace mamo
