#include "mamo/io/trajectory.hpp"

#include <array>
#include <cmath>

#include "io/text.hpp"
#include "mamo/io/result_json.hpp"

namespace mamo::io {
namespace {

constexpr double kJump = 1e-6;  // rad or m: a segment starts where the one before it ended

std::vector<std::string> column_names(const Plan& plan, const Robot& robot) {
  std::vector<std::string> names;
  for (int i = 0; i < robot.dof(); ++i) names.push_back(robot.joint(i).name);
  for (const Segment& segment : plan.segments)
    for (const std::string& name : segment.joint_names)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

Error bad_segment(std::size_t index, const std::string& what) {
  return {"plan: segment " + std::to_string(index) + ": " + what};
}

/// `full` holds one value per column and is updated to the segment's end.
Status append(const Segment& segment, std::size_t index, const std::vector<std::string>& names, Eigen::VectorXd& full,
              TimedPath& out) {
  std::vector<Eigen::Index> column;
  for (const std::string& name : segment.joint_names)
    column.push_back(std::find(names.begin(), names.end(), name) - names.begin());
  const double start = out.duration();
  for (std::size_t k = 0; k < segment.motion.t.size(); ++k) {
    const Eigen::VectorXd& q = segment.motion.q[k];
    if (q.size() != static_cast<Eigen::Index>(column.size()))
      return bad_segment(index, "point " + std::to_string(k) + " does not have one value per joint name");
    Eigen::VectorXd next = full;
    for (std::size_t i = 0; i < column.size(); ++i) next[column[i]] = q[static_cast<Eigen::Index>(i)];
    const double time = start + segment.motion.t[k];
    const bool first = out.t.empty();
    if (!first && time <= out.t.back()) {
      // The seam of two segments, or an instant said twice: one point is enough if it is the same.
      if ((next - full).cwiseAbs().maxCoeff() > kJump)
        return bad_segment(index, "point " + std::to_string(k) + " is elsewhere than the point before it at no later time");
      continue;
    }
    full = next;
    out.t.push_back(first ? 0.0 : time);
    out.q.push_back(next);
  }
  return {};
}

std::string object_comments(const Plan& plan, const Scene& scene) {
  std::string text;
  for (std::size_t i = 0; i < plan.segments.size(); ++i) {
    const Segment& s = plan.segments[i];
    text += "# after segment " + std::to_string(i) + " (" + std::string(to_string(s.kind));
    if (s.object.valid()) text += " " + one_line(object_name(scene, s.object));
    text += "), x y z qx qy qz qw:\n";
    for (const auto& [id, X] : s.objects_after) {
      const Eigen::Quaterniond q(X.linear());
      text += "#   " + one_line(object_name(scene, id)) + ": " +
              yaml_list(std::array{X.translation().x(), X.translation().y(), X.translation().z(), q.x(), q.y(), q.z(),
                                   q.w()}) +
              "\n";
    }
  }
  return text;
}

}  // namespace

Result<JoinedPlan> join_segments(const Plan& plan, const Problem& problem) {
  JoinedPlan joined;
  joined.joint_names = column_names(plan, problem.robot);
  Eigen::VectorXd full(static_cast<Eigen::Index>(joined.joint_names.size()));
  for (std::size_t i = 0; i < joined.joint_names.size(); ++i) {
    const JointId id = problem.robot.model->find_joint(joined.joint_names[i]);
    const int variable = id.valid() ? problem.robot.model->joints[id.index()].variable : -1;
    if (variable < 0) return Error{"plan: the robot has no movable joint " + in_quotes(joined.joint_names[i])};
    full[static_cast<Eigen::Index>(i)] = problem.robot.posture[variable];
  }
  for (int i = 0; i < problem.robot.dof(); ++i) full[i] = problem.q_start[i];
  for (std::size_t i = 0; i < plan.segments.size(); ++i)
    if (Status s = append(plan.segments[i], i, joined.joint_names, full, joined.motion); !s) return s.error();
  if (joined.motion.t.empty()) return Error{"plan: it has no points, so there is no trajectory to write"};
  return joined;
}

Result<std::string> trajectory_csv(const Plan& plan, const Problem& problem) {
  Result<JoinedPlan> joined = join_segments(plan, problem);
  if (!joined) return joined.error();
  std::string text = "time";
  for (const std::string& name : joined->joint_names) text += "," + name;
  text += "\n";
  for (std::size_t i = 0; i < joined->motion.t.size(); ++i) {
    text += shortest_number(joined->motion.t[i]);
    for (double v : joined->motion.q[i]) text += "," + shortest_number(v);
    text += "\n";
  }
  return text;
}

Result<std::string> joint_trajectory_yaml(const Plan& plan, const Problem& problem, bool ros1) {
  Result<JoinedPlan> joined = join_segments(plan, problem);
  if (!joined) return joined.error();
  const std::string sec = ros1 ? "secs" : "sec", nanosec = ros1 ? "nsecs" : "nanosec";
  const std::string zero = "{" + sec + ": 0, " + nanosec + ": 0}";
  std::string text = "header:\n";
  if (ros1) text += "  seq: 0\n";
  text += "  stamp: " + zero + "\n  frame_id: " + yaml_string(problem.robot.model->links.front().name) +
          "\njoint_names: [";
  for (std::size_t i = 0; i < joined->joint_names.size(); ++i)
    text += (i ? ", " : "") + yaml_string(joined->joint_names[i]);
  text += "]\npoints:\n";
  std::int64_t before = -1;
  for (std::size_t i = 0; i < joined->motion.t.size(); ++i) {
    std::int64_t ns = std::llround(joined->motion.t[i] * 1e9);
    ns = std::max(ns, before + 1);  // strictly increasing also after rounding
    before = ns;
    text += "  - positions: " + yaml_list(joined->motion.q[i]) + "\n    velocities: []\n    accelerations: []\n    effort: []\n" +
            "    time_from_start: {" + sec + ": " + std::to_string(ns / 1000000000) + ", " + nanosec + ": " +
            std::to_string(ns % 1000000000) + "}\n";
  }
  return text + object_comments(plan, problem.scene);
}

}  // namespace mamo::io
