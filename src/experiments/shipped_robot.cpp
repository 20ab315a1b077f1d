#include "experiments/shipped_robot.hpp"

#include "mamo/collision/collision_checker.hpp"
#include "mamo/io/load.hpp"
#include "mamo/io/robot_setup.hpp"

namespace mamo {

Status install_shipped_pr2(Problem& problem, const std::string& tip) {
  const Result<std::string> urdf = io::find_data_file("robots/pr2_right_arm.urdf", "");
  if (!urdf) return urdf.error();
  const Result<std::string> srdf_path = io::find_data_file("robots/pr2_right_arm.srdf", "");
  if (!srdf_path) return srdf_path.error();
  Result<io::RobotDescription> description = io::load_urdf(*urdf, {});
  if (!description) return description.error();
  const Result<io::Srdf> srdf = io::load_srdf(*srdf_path, *description->model);
  if (!srdf) return srdf.error();

  io::GroupSpec spec;
  spec.srdf = &*srdf;
  spec.group = "right_arm";
  spec.tip = tip;
  for (const auto& [state, values] : {std::pair("home", &spec.start), std::pair("parked", &spec.fixed)}) {
    const auto found = srdf->states.find(state);
    if (found == srdf->states.end()) return Error{*srdf_path + ": no group state '" + state + "'"};
    *values = found->second;
  }
  spec.fixed["torso_lift_joint"] = 0.1;
  spec.fixed["r_gripper_l_finger_joint"] = 0.2;
  Result<Robot> robot = io::make_robot(*description, spec);
  if (!robot) return Error{*urdf + ": " + robot.error().message};

  problem.robot = std::move(*robot);
  problem.q_start = problem.robot.group_part(problem.robot.posture);
  problem.robot_files.urdf = *urdf;
  problem.robot_files.srdf = *srdf_path;
  problem.robot_files.disabled = io::disabled_links(*srdf, *problem.robot.model);
  choose_self_pairs(problem.robot, problem.robot_files.disabled, true, 1);
  return {};
}

}  // namespace mamo
