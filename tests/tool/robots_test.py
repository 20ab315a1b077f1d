"""Robots of others, unmodified: the PR2 and the Panda of the shared data plan a reach. Skips where that is absent."""
import json
import os
import subprocess
import tempfile
import unittest

from support import SOURCE, TOOL

DATA = os.environ.get("MAMO_SHARED_DATA", os.path.join(SOURCE, "..", "shared", "data"))
ROBOTS = os.path.join(DATA, "robots")
PANDA = os.path.join(ROBOTS, "moveit_resources_panda_description")

PANDA_PROBLEM = f"""format: mamo-problem/1
robot:
  urdf: {PANDA}/urdf/panda.urdf
  srdf: {PANDA}/panda.srdf
  group: panda_arm
  tip: panda_link8
  start: {{panda_joint1: 0, panda_joint2: -0.785, panda_joint3: 0, panda_joint4: -2.356, panda_joint5: 0, panda_joint6: 1.571, panda_joint7: 0.785}}
  speed_scale: 0.1
task: {{kind: reach, pose: {{position: [0.5, 0.25, 0.35], rpy: [3.14159, 0, 0]}}}}
constraints: {{profile: full}}
objects:
  - {{id: table, shape: {{box: {{size: [0.6, 1.2, 0.04]}}}}, pose: {{position: [0.6, 0, 0.18]}}, fixture: true, touch: support}}
  - {{id: can, shape: {{cylinder: {{radius: 0.033, length: 0.12}}}}, pose: {{position: [0.5, 0.1, 0.26]}}, mass: 0.3, friction: 0.8, movable: true}}
  - {{id: vase, shape: {{cylinder: {{radius: 0.04, length: 0.25}}}}, pose: {{position: [0.45, -0.2, 0.325]}}, mass: 0.3, friction: 0.8}}
"""


def plan(*arguments):
    return subprocess.run([TOOL, "plan", *arguments, "--json", "--quiet", "--time-limit", "60"], capture_output=True,
                          text=True, timeout=120)


@unittest.skipUnless(os.path.isdir(ROBOTS), f"no shared data at {DATA}")
class RobotsOfOthers(unittest.TestCase):
    def check_solved(self, run):
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        result = json.loads(run.stdout)
        self.assertTrue(result["verified"])

    def test_the_panda_with_its_srdf_and_package_paths_plans_a_reach(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "panda.yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(PANDA_PROBLEM)
            self.check_solved(plan(path, "--package-path", f"moveit_resources_panda_description={PANDA}"))

    def test_the_published_pr2_plans_a_reach_in_a_shipped_problem(self):
        shipped = os.path.join(SOURCE, "bench", "data", "problems", "tabletop_1.yaml")
        self.check_solved(plan(shipped, "--robot", os.path.join(ROBOTS, "pr2", "pr2.urdf")))


if __name__ == "__main__":
    unittest.main()
