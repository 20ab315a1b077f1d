// What a picture from above shows, and where: objects with their outlines, paths, the scale. The drawing is elsewhere.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "view/plan_path.hpp"

#include "mamo/kinematics/forward_kinematics.hpp"
#include "mamo/view/svg.hpp"
#include "mamo/view/top_view.hpp"

namespace mamo::view {

inline constexpr double kLegendPx = 210;  // width of the legend
inline constexpr double kHeadPx = 58;     // height of the title

class TopScene {
 public:
  TopScene(const Problem& problem, const Plan* plan, const TopViewOptions& options);

  struct Drawn {  // an object, with everything the picture needs of it
    ObjectId id;
    std::string css;
    Points2 outline;                // world, where it ends (or is)
    std::optional<Points2> before;  // world, if it moved
    Eigen::Vector2d from, to;       // centres, world
  };

  const Problem& problem;
  const Plan* plan;
  const TopViewOptions& options;
  const ForwardKinematics kinematics;
  ObjectId target = kNoObject;
  std::vector<SegmentPath> paths;
  std::vector<Drawn> drawn;
  std::vector<std::pair<SegmentKind, Points2>> tip;  // world
  double scale = 1;                                  // px per m
  Eigen::AlignedBox2d field;                         // px, where the world is drawn
  Eigen::Vector2d middle{0, 0};                      // world, at the middle of the field
  Eigen::Vector2d size{0, 0};                        // px, of the whole picture

  Eigen::Isometry3d pose_of(ObjectId id) const;
  Eigen::Vector2d tip_at(const Eigen::VectorXd& q) const;
  /// Outlines in world of the links that group joints move, or of the others.
  std::vector<Points2> arm_outlines(const Eigen::VectorXd& q, bool moving) const;
  Eigen::Vector2d px_of(const Eigen::Vector2d& p_W) const;
  Points2 px_of(const Points2& points) const;
  bool has(const std::string& css) const;
  bool anything_moved() const;

 private:
  void collect_objects();
  void collect_tip_path();
  void fit();
  std::map<ObjectId, Eigen::Isometry3d> final_;
};

/// The outline of the largest of an object's shapes, in world.
Points2 body_outline(const Object& object, const Eigen::Isometry3d& X_WO);

/// Fixtures, the robot, objects before and after, the tip's path, the goal. Clipped to the field by the caller.
std::string draw_bodies(const TopScene& scene);
/// A cross in a ring around a point (px).
std::string goal_mark(const Eigen::Vector2d& centre);
/// Names on the field.
std::string draw_labels(const TopScene& scene);
/// Title and legend around it.
std::string draw_frame(const TopScene& scene);

}  // namespace mamo::view
