// Has an object left what carried it at the start? The rule of INTERFACE.md ("Tilt is ... has left its support").
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <utility>
#include <vector>

#include "mamo/model/scene.hpp"

namespace mamo {

/// An object has left when its centre of mass is over none of the fixtures that may support it (those with
/// `touch: support`, and those it stood on) and not over an object it stood on, or is below the top of what it
/// stood on. It stood on bodies that touched it at the start and had a top below its centre of mass.
class SupportRule {
 public:
  /// The scene must outlive the rule. `touching`: pairs that touch at the start.
  SupportRule(const Scene& scene, const std::vector<std::pair<ObjectId, ObjectId>>& touching);

  /// 0 while supported; else how far (m) the centre of mass p_WCm is below the top or beside the nearest support.
  /// X_WO: where an object is now.
  double left_by(ObjectId id, const Eigen::Vector3d& p_WCm,
                 const std::function<Eigen::Isometry3d(ObjectId)>& X_WO) const;

 private:
  struct Start {
    std::vector<ObjectId> stood_on;  // ascending
    double top;                      // m, of the lowest of them; -infinity: of none
  };
  const Scene& scene_;
  std::vector<Start> start_;                // by object
  std::vector<ObjectId> supporting_fixtures_;
};

}  // namespace mamo
