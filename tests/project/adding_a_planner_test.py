"""docs/adding_a_planner.md is true: its file and its line, added to the registry, make a planner that plans."""
import json
import os
import re
import subprocess
import tempfile
import unittest

SOURCE = os.environ.get("MAMO_SOURCE_DIR", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
BUILD = os.environ.get("MAMO_BUILD_DIR", os.path.join(SOURCE, "build/release"))

PROBLEM = """format: mamo-problem/1
robot: {urdf: robots/pr2_right_arm.urdf, srdf: robots/pr2_right_arm.srdf, group: right_arm,
        start: {r_shoulder_pan_joint: -1.68651, r_shoulder_lift_joint: -0.184315, r_upper_arm_roll_joint: -1.67611,
                r_elbow_flex_joint: -1.66215, r_forearm_roll_joint: 0.285096, r_wrist_flex_joint: -0.658798,
                r_wrist_roll_joint: 1.41563}}
task: {kind: reach, joints: {r_shoulder_pan_joint: -1.4, r_shoulder_lift_joint: -0.1, r_upper_arm_roll_joint: -1.6,
                             r_elbow_flex_joint: -1.5, r_forearm_roll_joint: 0.3, r_wrist_flex_joint: -0.6,
                             r_wrist_roll_joint: 1.4}, tolerance: 0.0175}
objects: []
"""


def blocks():
    with open(os.path.join(SOURCE, "docs/adding_a_planner.md"), encoding="utf-8") as file:
        return re.findall(r"```cpp\n(.*?)```", file.read(), re.S)


def compile_commands():
    """Source -> command line, from ninja's own data base of this build."""
    run = subprocess.run(["ninja", "-C", BUILD, "-t", "compdb"], capture_output=True, text=True)
    return json.loads(run.stdout) if run.returncode == 0 else []


class AddingAPlanner(unittest.TestCase):
    def test_the_file_and_the_line_make_a_planner(self):
        file, line = blocks()
        link = subprocess.run(["ninja", "-C", BUILD, "-t", "commands", "mamo"], capture_output=True, text=True)
        if link.returncode != 0:
            self.skipTest("the build folder is not one of ninja: " + BUILD)
        registry = [c["command"] for c in compile_commands() if c["file"].endswith("src/planners/registry.cpp")
                    and "mamo.dir" in c["output"]][0]
        final = link.stdout.strip().splitlines()[-1]
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "planners"))
            with open(os.path.join(folder, "planners/one_file_planners.inc"), "w", encoding="utf-8") as out:
                out.write(line)
            with open(os.path.join(folder, "straight.cpp"), "w", encoding="utf-8") as out:
                out.write(file)
            with open(os.path.join(folder, "problem.yaml"), "w", encoding="utf-8") as out:
                out.write(PROBLEM)
            objects = []
            for source in (os.path.join(SOURCE, "src/planners/registry.cpp"), os.path.join(folder, "straight.cpp")):
                target = os.path.join(folder, os.path.basename(source) + ".o")
                command = re.sub(r" -MD -MT \S+ -MF \S+ -o \S+ -c \S+", f" -o {target} -c {source}", registry)
                command = re.sub(r" -I\S*/src(?= )", lambda found: f" -I{folder}{found.group(0)}", command, count=1)
                self.run_command(command)
                objects.append(target)
            # The new registry stands before the library that holds the old one.
            tool = os.path.join(folder, "mamo")
            command = re.sub(r" -o mamo ", f" -o {tool} {' '.join(objects)} ", final)
            self.assertIn(tool, command)
            self.run_command(command)
            self.assertIn("straight", subprocess.run([tool, "plan", "--help"], capture_output=True, text=True).stdout)
            plan = subprocess.run([tool, "plan", os.path.join(folder, "problem.yaml"), "--planner", "straight", "--set",
                                   "straight_bend=0.05"], capture_output=True, text=True,
                                  env={**os.environ, "MAMO_DATA_DIR": os.path.join(SOURCE, "bench/data")})
            self.assertEqual(plan.returncode, 0, plan.stdout + plan.stderr)
            self.assertIn("verified     yes", plan.stdout)

    def run_command(self, command):
        run = subprocess.run(command, shell=True, capture_output=True, text=True, cwd=BUILD)
        self.assertEqual(run.returncode, 0, command + "\n" + run.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
