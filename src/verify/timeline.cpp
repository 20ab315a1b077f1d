#include "verify/timeline.hpp"

namespace mamo::verify {

int Timeline::segment_at(double time_s) const {
  for (std::size_t s = 0; s < end_s.size(); ++s)
    if (time_s <= end_s[s] + 1e-9) return static_cast<int>(s);
  return static_cast<int>(end_s.size()) - 1;
}

std::vector<int> group_indices(const Robot& robot, const Segment& segment) {
  std::vector<int> indices;
  for (const std::string& name : segment.joint_names) {
    int found = -1;
    for (int i = 0; i < robot.dof(); ++i)
      if (robot.joint(i).name == name) found = i;
    indices.push_back(found);
  }
  return indices;
}

Timeline make_timeline(const Problem& problem, const Plan& plan) {
  Timeline line;
  Eigen::VectorXd q = problem.q_start;
  double offset = 0;
  for (std::size_t s = 0; s < plan.segments.size(); ++s) {
    const Segment& segment = plan.segments[s];
    const std::vector<int> indices = group_indices(problem.robot, segment);
    line.begin_s.push_back(offset);
    for (std::size_t k = 0; k < segment.motion.t.size(); ++k) {
      for (std::size_t i = 0; i < indices.size(); ++i)
        q[indices[i]] = segment.motion.q[k][static_cast<Eigen::Index>(i)];
      if (k == 0 && s > 0) continue;  // the same point as the last one of the segment before
      line.path.t.push_back(k == 0 ? 0.0 : offset + segment.motion.t[k]);
      line.path.q.push_back(q);
      line.segment_of.push_back(static_cast<int>(s));
    }
    offset += segment.motion.duration();
    line.end_s.push_back(offset);
  }
  return line;
}

}  // namespace mamo::verify
