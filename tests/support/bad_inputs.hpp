// Files that must be refused with one clear line, as small strings: tests of the readers and of the tool's exit
// codes share them.
#pragma once

#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mamo::test {

struct BadInput {
  std::string name;                   // letters, digits and _: fit for a test's name
  std::string content;                // of the file
  std::vector<std::string> expected;  // all stand in the message; the place follows the file's name, ":3:5:"
};
/// For messages of parameterised tests.
inline std::ostream& operator<<(std::ostream& out, const BadInput& input) { return out << input.name; }

/// A whole native problem; the bad ones differ from it in one thing. Its robot is the shipped PR2.
inline std::string good_problem() {
  return R"(format: mamo-problem/1
robot:
  urdf: robots/pr2_right_arm.urdf
  base: base_footprint
  tip: r_gripper_tool_frame
  start: {torso_lift_joint: 0.1, r_shoulder_pan_joint: -1.68651, r_shoulder_lift_joint: -0.184315, r_upper_arm_roll_joint: -1.67611,
          r_elbow_flex_joint: -1.66215, r_forearm_roll_joint: 0.285096, r_wrist_flex_joint: -0.658798, r_wrist_roll_joint: 1.41563}
  fixed: {r_gripper_l_finger_joint: 0.2}
task: {kind: reach, pose: {position: [0.7, -0.4, 0.9], quaternion: [0, 0, 0, 1]}, tolerance: {position: 0.01, angle: 0.05}, target: cup}
constraints: {profile: full}
objects:
  - {id: table, shape: {box: {size: [0.6, 0.8, 0.04]}}, pose: {position: [0.78, -0.5, 0.75]}, fixture: true, touch: support}
  - {id: can, shape: {cylinder: {radius: 0.03, length: 0.1}}, pose: {position: [0.7, -0.6, 0.82], rpy: [0, 0, 0]}, mass: 0.35, friction: 0.9, movable: true}
  - {id: cup, shape: {sphere: {radius: 0.04}}, pose: {position: [0.8, -0.4, 0.81]}, mass: 0.2, movable: false}
)";
}

/// good_problem() with the first `from` replaced.
inline std::string problem_with(const std::string& from, const std::string& to) {
  std::string text = good_problem();
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("bad_inputs: no such text: " + from);
  return text.replace(at, from.size(), to);
}

inline std::vector<BadInput> bad_problems() {
  std::string deep, laughs = "a: &a [x, x]\n";
  for (int i = 0; i < 100; ++i) deep += std::string(static_cast<std::size_t>(i), ' ') + "k:\n";
  for (int i = 0; i < 40; ++i) laughs += "b" + std::to_string(i) + ": &b" + std::to_string(i) + " [*a, *a]\n";
  const std::string good = good_problem();
  const std::string radius = "radius: 0.03,", mass = "mass: 0.35", size = "[0.6, 0.8, 0.04]";
  return {
      {"empty", "", {"empty"}},
      {"blank", " \n\n  \n", {"empty"}},
      {"binary", std::string("\x7f""ELF\x02\x01\0\0\0", 9), {"binary"}},
      {"control_characters", std::string(40, '\x01'), {"binary"}},
      {"truncated_in_flow", good.substr(0, good.rfind("radius")), {":14:", "bad YAML"}},
      {"truncated_generated", good + "generated: {seed: 1}\n", {":15:", "truncated", "end: true"}},
      {"end_not_last", "end: true\n" + good, {":1:", "last key"}},
      {"does_not_parse", problem_with("objects:", "objects: ]"), {":11:", "bad YAML"}},
      {"a_plain_word", "hello\n", {":1:1:", "a problem file is a map"}},
      {"a_list", "- 1\n- 2\n", {":1:1:", "a problem file is a map"}},
      {"two_documents", good + "---\n" + good, {"more than one YAML document"}},
      {"anchor", problem_with("constraints: {", "constraints: &c {"), {":10:", "anchors"}},
      {"alias", problem_with("constraints: {profile: full}", "constraints: *c"), {":10:", "anchor"}},
      {"billion_laughs", laughs, {":1:4:", "anchors"}},
      {"nesting", deep, {"nested deeper than 64"}},
      {"nesting_in_flow", "format: " + std::string(100000, '['), {":1:"}},
      {"tag", problem_with("urdf: robots", "urdf: !!python/object robots"), {":3:", "tags"}},
      {"key_twice", problem_with("movable: true}", "movable: true, mass: 1}"), {":13:", "'mass'", "second time"}},
      {"no_format", problem_with("format: mamo-problem/1\n", ""), {"misses the key 'format'"}},
      {"wrong_format", problem_with("problem/1", "problem/9"), {":1:9:", "expected mamo-problem/1"}},
      {"unknown_key", problem_with("objects:", "objcts:"), {":11:1:", "'objcts'", "'objects'"}},
      {"unknown_object_key", problem_with(mass, "masss: 0.35"), {":13:", "'masss'", "'mass'"}},
      {"unknown_robot_key", problem_with("base: base_f", "bse: base_f"), {":4:3:", "'bse'", "'base'"}},
      {"unknown_shape", problem_with("{cylinder: {", "{cylindre: {"), {":13:", "'cylindre'", "'cylinder'"}},
      {"unknown_constraint", problem_with("{profile: full}", "{max_tlt: 1}"), {":10:", "'max_tlt'", "'max_tilt'"}},
      {"nan_mass", problem_with(mass, "mass: .nan"), {":13:", "mass of object 'can'", ".nan", "positive finite mass"}},
      {"infinite_mass", problem_with(mass, "mass: .inf"), {":13:", "mass of object 'can'", "positive finite mass"}},
      {"negative_mass", problem_with(mass, "mass: -1"), {":13:", "mass of object 'can' is -1"}},
      {"zero_mass", problem_with(mass, "mass: 0"), {":13:", "mass of object 'can' is 0", "positive"}},
      {"no_mass", problem_with(mass + ", ", ""), {":13:", "'can'", "misses 'mass'"}},
      {"nan_size", problem_with(size, "[0.6, .NaN, 0.04]"), {":12:", "size of box of object 'table'[1]", "positive"}},
      {"infinite_size", problem_with(size, "[.inf, 0.8, 0.04]"), {":12:", "positive length"}},
      {"negative_size", problem_with(radius, "radius: -0.03,"), {":13:", "radius of cylinder of object 'can' is -0.03"}},
      {"zero_size", problem_with(radius, "radius: 0,"), {":13:", "radius", "positive length"}},
      {"overflowing_size", problem_with(radius, "radius: 1e999,"), {":13:", "1e999", "positive length"}},
      {"size_is_text", problem_with(radius, "radius: wide,"), {":13:", "'wide'", "expected a number"}},
      {"size_has_a_unit", problem_with(radius, "radius: 3cm,"), {":13:", "'3cm'", "expected a number"}},
      {"size_of_two", problem_with(size, "[0.6, 0.8]"), {":12:", "a list of 2", "3 numbers"}},
      {"nan_position", problem_with("[0.7, -0.6, 0.82]", "[.nan, -0.6, 0.82]"), {":13:", "position", "finite"}},
      {"far_away", problem_with("[0.7, -0.6, 0.82]", "[1e9, -0.6, 0.82]"), {":13:", "position", "1000 m"}},
      {"no_shape", problem_with("shape: {sphere: {radius: 0.04}}, ", ""), {":14:", "'cup'", "'shape' or 'shapes'"}},
      {"two_shapes", problem_with("{sphere: {radius: 0.04}}", "{sphere: {radius: 0.04}, box: {size: [1, 1, 1]}}"), {":14:", "exactly one of"}},
      {"no_pose", problem_with(", pose: {position: [0.8, -0.4, 0.81]}", ""), {":14:", "'cup'", "misses the key 'pose'"}},
      {"quaternion_zero", problem_with("quaternion: [0, 0, 0, 1]", "quaternion: [0, 0, 0, 0]"), {":9:", "cannot be normalised"}},
      {"two_orientations", problem_with("rpy: [0, 0, 0]", "rpy: [0, 0, 0], quaternion: [0, 0, 0, 1]"), {":13:", "twice"}},
      {"duplicate_id", problem_with("id: cup", "id: can"), {":14:", "'can'", "unique"}},
      {"reserved_id", problem_with("id: cup", "id: robot"), {":14:", "'robot'", "taken"}},
      {"fixture_and_movable", problem_with("movable: true", "movable: true, fixture: true"), {":13:", "both fixture and movable"}},
      {"movable_is_a_number", problem_with("movable: true", "movable: 1"), {":13:", "expected true or false"}},
      {"movable_support", problem_with("movable: true", "movable: true, touch: support"), {":13:", "only a fixture"}},
      {"unknown_touch", problem_with("touch: support", "touch: never"), {":12:", "'never'", "allowed, robot, objects, forbidden"}},
      {"unknown_profile", problem_with("profile: full", "profile: strict"), {":10:", "'strict'", "contact-only, full or legacy"}},
      {"negative_limit", problem_with("{profile: full}", "{max_speed: -1}"), {":10:", "max_speed of constraints is -1"}},
      {"mesh_missing", problem_with("{sphere: {radius: 0.04}}", "{mesh: {file: no_such.obj}}"), {":14:", "'cup'", "no_such.obj", "no such file"}},
      {"mesh_scale_zero", problem_with("{sphere: {radius: 0.04}}", "{mesh: {file: no_such.obj, scale: 0}}"), {":14:", "positive scale"}},
      {"floating", problem_with("[0.8, -0.4, 0.81]", "[0.8, -0.4, 0.95]"), {":14:", "'cup'", "floats"}},
      {"no_robot", good.substr(0, good.find("robot:")) + good.substr(good.find("task:")), {"misses the key 'robot'"}},
      {"no_urdf", problem_with("  urdf: robots/pr2_right_arm.urdf\n", ""), {":3:", "misses the key 'urdf'"}},
      {"urdf_missing", problem_with("pr2_right_arm.urdf", "pr3.urdf"), {":3:", "pr3.urdf", "no such file", "tried"}},
      {"unknown_tip", problem_with("tip: r_gripper_tool_frame", "tip: r_gripper_tool_frme"), {":5:", "r_gripper_tool_frme", "r_gripper_tool_frame"}},
      {"no_tip", problem_with("  tip: r_gripper_tool_frame\n", ""), {":3:", "tip"}},
      {"no_start", problem_with("  start: {", "  fixd: {"), {":6:", "'fixd'"}},
      {"start_misses_a_joint", problem_with(", r_wrist_roll_joint: 1.41563", ""), {":6:", "r_wrist_roll_joint", "misses"}},
      {"start_unknown_joint", problem_with("r_wrist_roll_joint: 1.4", "r_wrist_rol_joint: 1.4"), {":7:", "r_wrist_rol_joint", "r_wrist_roll_joint"}},
      {"start_outside_limits", problem_with("r_elbow_flex_joint: -1.66215", "r_elbow_flex_joint: 1.0"), {":7:", "r_elbow_flex_joint", "limits"}},
      {"start_nan", problem_with("r_elbow_flex_joint: -1.66215", "r_elbow_flex_joint: .nan"), {":7:", "r_elbow_flex_joint", "finite"}},
      {"fixed_outside_limits", problem_with("r_gripper_l_finger_joint: 0.2", "r_gripper_l_finger_joint: 3"), {":8:", "r_gripper_l_finger_joint", "limits"}},
      {"group_without_srdf", problem_with("  base: base_footprint\n", "  group: right_arm\n"), {":4:", "right_arm", "SRDF"}},
      {"speed_scale_zero", problem_with("  fixed: {", "  speed_scale: 0\n  fixed: {"), {":8:", "speed_scale of robot is 0"}},
      {"no_task", good.substr(0, good.find("task:")) + good.substr(good.find("constraints:")), {"misses the key 'task'"}},
      {"unknown_task", problem_with("kind: reach", "kind: fetch"), {":9:", "'fetch'", "reach or retrieve"}},
      {"task_of_unknown_object", problem_with("target: cup", "target: cop"), {":9:", "'cop'", "'cup'"}},
      {"tolerance_zero", problem_with("{position: 0.01,", "{position: 0,"), {":9:", "position of tolerance of task is 0"}},
      {"retrieve_of_a_fixture",
       problem_with("kind: reach, pose: {position: [0.7, -0.4, 0.9], quaternion: [0, 0, 0, 1]}, tolerance: {position: 0.01, angle: 0.05}, target: cup",
                    "kind: retrieve, object: table, pregrasp: {position: [0.7, -0.4, 0.9]}, home: start"),
       {":9:", "fixture 'table'"}},
      {"goal_joint_outside_limits",
       problem_with("kind: reach, pose: {position: [0.7, -0.4, 0.9], quaternion: [0, 0, 0, 1]}, tolerance: {position: 0.01, angle: 0.05}, target: cup",
                    "kind: reach, joints: {torso_lift_joint: 0.1, r_shoulder_pan_joint: 7, r_shoulder_lift_joint: 0, r_upper_arm_roll_joint: 0, "
                    "r_elbow_flex_joint: -1, r_forearm_roll_joint: 0, r_wrist_flex_joint: -1, r_wrist_roll_joint: 0}"),
       {":9:", "'r_shoulder_pan_joint'", "is 7", "limits"}},
      {"iterations_fraction", good + "physics: {iterations: 2.5}\n", {":15:", "whole number"}},
      {"step_zero", good + "physics: {step: 0}\n", {":15:", "step of physics is 0"}},
      {"a_urdf", "<?xml version=\"1.0\"?>\n<robot name=\"r\"><link name=\"l\"/></robot>\n", {"robot description"}},
      {"a_result", "{\"schema\": \"mamo-result/1\", \"status\": \"solved\"}\n", {"result of mamo"}},
      {"a_moveit_scene", "scene\n* box\n1\nbox\n1 1 1\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n", {"MoveIt scene"}},
      {"a_motionbenchmaker_scene", "name: s\nrobot_model_name: panda\nfixed_frame_transforms: []\nworld: {collision_objects: []}\n", {"MotionBenchMaker scene", "not supported yet"}},
      {"a_motionbenchmaker_request", "group_name: arm\nstart_state: {}\ngoal_constraints: []\n", {"MotionBenchMaker request", "not supported yet"}},
  };
}

/// A whole shelf scene in the published layout, of our own making.
inline std::string good_shelf_scene() {
  return "O\n7\n"
         "1,0,-1,0.78,-0.5,0.75,0,0,0,0.3,0.4,0.02,0,0.8,False\n"
         "2,0,-1,1.1,-0.5,0.93,0,0,0,0.02,0.4,0.2,0,0.8,False\n"
         "3,0,-1,0.78,-0.5,1.11,0,0,0,0.3,0.4,0.02,0,0.8,False\n"
         "4,0,-1,0.8,-0.92,0.93,0,0,0,0.32,0.02,0.2,0,0.8,False\n"
         "5,0,-1,0.8,-0.08,0.93,0,0,0,0.32,0.02,0.2,0,0.8,False\n"
         "6,2,0,0.9,-0.4,0.85,0,0,0.5,0.035,0.035,0.16,0.25,0.9,False\n"
         "7,0,1,0.7,-0.6,0.87,0,0,1.5,0.03,0.05,0.1,0.2,0.8,True\n"
         "R\n0,0,0,0,0,0,1\nS\n1\ntorso_lift_joint,0\nG\n0.82,-0.4,0.85,0,0,0\nooi\n6\nA\nanything\n";
}

inline std::vector<BadInput> bad_shelf_scenes() {
  const std::string good = good_shelf_scene();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("bad_inputs: no such text: " + from);
    return text.replace(at, from.size(), to);
  };
  return {
      {"shelf_truncated_objects", good.substr(0, good.find("7,0,1")), {"truncated", "object 7 of 7"}},
      {"shelf_truncated_row", good.substr(0, good.find(",0.05,0.1,0.2")), {":9:", "10 fields", "expected 15"}},
      {"shelf_without_goal", good.substr(0, good.find("G\n")), {"truncated", "section G"}},
      {"shelf_without_target", good.substr(0, good.find("ooi\n")), {"truncated", "section ooi"}},
      {"shelf_count", with("O\n7\n", "O\nseven\n"), {":2:", "'seven'", "whole number"}},
      {"shelf_count_too_small", with("O\n7\n", "O\n6\n"), {":9:", "unknown section"}},
      {"shelf_nan_mass", with("0.25,0.9", "nan,0.9"), {":8:", "mass of object '6'", "'nan'"}},
      {"shelf_negative_size", with("0.035,0.035", "-0.035,0.035"), {":8:", "sx of object '6'", "positive length"}},
      {"shelf_duplicate_id", with("\n7,0,1", "\n6,0,1"), {":9:", "second object", "'6'"}},
      {"shelf_unknown_shape", with("6,2,0", "6,7,0"), {":8:", "shape of object '6'"}},
      {"shelf_unknown_target", with("ooi\n6", "ooi\n99"), {"'99'", "not among the objects"}},
      {"shelf_target_is_a_wall", with("ooi\n6", "ooi\n2"), {"'2'", "part of the shelf"}},
      {"shelf_goal_is_text", with("0.82,-0.4,0.85,0,0,0", "0.82,-0.4,high,0,0,0"), {":16:", "'high'"}},
      {"shelf_base_quaternion", with("0,0,0,0,0,0,1", "0,0,0,0,0,0,0"), {":11:", "cannot be normalised"}},
  };
}

/// Plans for good_problem() that cannot be read (not those that verification rejects).
inline std::vector<BadInput> bad_plans() {
  const std::string point = R"({"t": 0, "q": [0.1]})";
  const auto segment = [](const std::string& body) { return "{\"segments\": [{" + body + "}]}"; };
  const std::string rest = R"("joint_names": ["r_shoulder_pan_joint"], "points": [)" + point + "], \"objects_after\": {}";
  return {
      {"plan_empty", "", {"empty"}},
      {"plan_binary", std::string("\0\1\2", 3), {"binary"}},
      {"plan_truncated", "{\"segments\": [", {":1:", "ends too early"}},
      {"plan_not_json", "format: mamo-problem/1\n", {":1:", "bad JSON"}},
      {"plan_a_number", "3", {"'segments'"}},
      {"plan_without_segments", "{\"plan\": {}}", {"'segments'"}},
      {"plan_wrong_schema", R"({"schema": "mamo-verdict/1", "ok": true})", {"mamo-verdict/1", "expected mamo-result/1"}},
      {"plan_of_a_failure", R"({"schema": "mamo-result/1", "status": "timeout", "plan": {"segments": []}})", {"no plan", "'timeout'"}},
      {"plan_unknown_kind", segment("\"kind\": \"throw\", \"object\": null, " + rest), {"segment 0", "kind"}},
      {"plan_unknown_object", segment("\"kind\": \"push\", \"object\": \"cam\", " + rest), {"segment 0", "'cam'", "'can'"}},
      {"plan_null_in_q", segment(R"("kind": "reach", "object": null, "joint_names": ["j"], "points": [{"t": 0, "q": [null]}], "objects_after": {})"), {"segment 0", "q[0] of point 0", "expected a number"}},
      {"plan_overflow_in_q", segment(R"("kind": "reach", "object": null, "joint_names": ["j"], "points": [{"t": 0, "q": [1e999]}], "objects_after": {})"), {"bad JSON", "1e999"}},
      {"plan_q_too_long", segment(R"("kind": "reach", "object": null, "joint_names": ["j"], "points": [{"t": 0, "q": [1, 2]}], "objects_after": {})"), {"segment 0", "point 0", "one number per joint name"}},
      {"plan_pose_of_six", segment(R"("kind": "reach", "object": null, "joint_names": [], "points": [], "objects_after": {"can": [0, 0, 0, 0, 0, 1]})"), {"'can'", "7 numbers"}},
      {"plan_pose_not_normalisable", segment(R"("kind": "reach", "object": null, "joint_names": [], "points": [], "objects_after": {"can": [0, 0, 0, 0, 0, 0, 0]})"), {"'can'", "normalised"}},
  };
}

}  // namespace mamo::test
