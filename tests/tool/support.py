"""Running the built tool, and small problems to run it on. Standard library only."""
import json
import os
import subprocess
import tempfile
import unittest

SOURCE = os.environ.get("MAMO_SOURCE_DIR", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
TOOL = os.environ.get("MAMO_TOOL", os.path.join(SOURCE, "build/release/mamo"))

# Seen from above: three links of 0.3 m turn about vertical axes, 0.5 m above the floor; the goal is reached by joints.
#
#        y
#        |   [cup on the table]
#        o===o===o===>  x          o: joints j1, j2, j3; the table is below the arm, the cup stands in its plane
#
LIMITS = [(-3.0, 3.0), (-2.5, 2.5), (-2.5, 2.5)]


def urdf(limits=None):
    limits = limits or LIMITS
    links = ['<link name="base"><collision><origin xyz="0 0 0.19"/><geometry><box size="0.1 0.1 0.36"/></geometry>'
             "</collision></link>"]
    joints = []
    parent, offset = "base", "0 0 0.5"
    for i, (low, high) in enumerate(limits, 1):
        links.append(f'<link name="l{i}"><collision><origin xyz="0.16 0 0"/><geometry><box size="0.26 0.04 0.04"/>'
                     "</geometry></collision></link>")
        joints.append(f'<joint name="j{i}" type="revolute"><parent link="{parent}"/><child link="l{i}"/>'
                      f'<origin xyz="{offset}"/><axis xyz="0 0 1"/>'
                      f'<limit lower="{low}" upper="{high}" velocity="2" effort="10"/></joint>')
        parent, offset = f"l{i}", "0.3 0 0"
    links.append('<link name="tip"/>')
    joints.append('<joint name="tip_joint" type="fixed"><parent link="l3"/><child link="tip"/><origin xyz="0.3 0 0"/></joint>')
    return '<robot name="planar">' + "".join(links + joints) + "</robot>\n"


TABLE = ("  - {id: table, shape: {box: {size: [2, 2, 0.04]}}, pose: {position: [0, 0, 0.42], rpy: [0, 0, 0]},"
         " fixture: true, touch: support}\n")


def cup(name="cup", x=0.45, y=0.45, movable=True):
    return (f"  - {{id: {name}, shape: {{cylinder: {{radius: 0.03, length: 0.12}}}}, pose: {{position: [{x}, {y}, 0.50],"
            f" rpy: [0, 0, 0]}}, mass: 0.3, friction: 0.8, movable: {str(movable).lower()}}}\n")


def wall(name, x, y, sx, sy):
    return (f"  - {{id: {name}, shape: {{box: {{size: [{sx}, {sy}, 0.2]}}}}, pose: {{position: [{x}, {y}, 0.54],"
            " rpy: [0, 0, 0]}, fixture: true, touch: forbidden}\n")


def problem(objects=None, goal=(1.2, 0.1, 0.1), start=(0, 0, 0), urdf_name="planar.urdf", tail=""):
    objects = TABLE + cup() if objects is None else objects
    joints = lambda q: "{" + ", ".join(f"j{i}: {v}" for i, v in enumerate(q, 1)) + "}"
    return ("format: mamo-problem/1\n"
            f"robot: {{urdf: {urdf_name}, base: base, tip: tip, joints: [j1, j2, j3], start: {joints(start)},"
            " speed_scale: 0.1}\n"
            f"task: {{kind: reach, joints: {joints(goal)}, tolerance: 0.0175}}\n"
            f"objects:\n{objects}"
            "constraints: {profile: contact-only}\n" + tail)


def mamo(*arguments, timeout=120, cwd=None, env=None):
    """The finished process, output as text."""
    return subprocess.run([TOOL, *map(str, arguments)], capture_output=True, text=True, timeout=timeout, cwd=cwd,
                          env={**os.environ, **(env or {})}, stdin=subprocess.DEVNULL)


def planners():
    """Names that `mamo plan --help` lists."""
    text = mamo("plan", "--help").stdout
    return [name for name in ("selsim", "selsim-wastar", "fullsim", "fullsim-wastar") if name in text.replace(",", " ").split()]


class ToolTest(unittest.TestCase):
    """A folder of its own for each test, with the arm and a problem in it."""
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.write("planar.urdf", urdf())
        self.problem = self.write("problem.yaml", problem())

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def read_json(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return json.load(file)

    def files(self):
        return sorted(os.listdir(self.folder))

    def assert_refused(self, run, code, *words):
        """One line on standard error that holds the words, nothing on standard output, the exit code."""
        self.assertEqual(run.returncode, code, run.stderr + run.stdout)
        self.assertEqual(run.stdout, "")
        lines = [line for line in run.stderr.splitlines() if not line.startswith("warning: ")]
        self.assertEqual(len(lines), 1, run.stderr)
        for word in words:
            self.assertIn(word, lines[0])


def main():
    unittest.main(verbosity=2)
