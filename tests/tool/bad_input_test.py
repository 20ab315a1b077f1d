"""Bad input, end to end: exit code 3, one line that says where and what, no partial output file."""
import json
import os
import unittest

from support import TABLE, ToolTest, cup, main, mamo, planners, problem, urdf, wall

PLACE = r"problem\.yaml:\d+:\d+: "


def changed(old, new, text=None):
    text = problem() if text is None else text
    assert old in text, old
    return text.replace(old, new, 1)


def nested(depth):
    return problem(tail="physics: " + "[" * depth + "]" * depth + "\n")


# Name: (text of problem.yaml, words of the message). All have a place in the file.
PLACED = {
    "truncated": ("format: mamo-problem/1\nrobot: {urdf: planar.ur", []),
    "no yaml": ("format: mamo-problem/1\n  : [[\n", []),
    "unknown format": (changed("mamo-problem/1", "mamo-problem/9"), ["mamo-problem/1"]),
    "unknown key": (changed("task:", "tasks:"), ["tasks", "task"]),
    "unknown key of an object": (changed("mass:", "masss:"), ["masss", "mass"]),
    "unknown key of the robot": (changed("base:", "bass:"), ["bass", "base"]),
    "key given twice": (changed("mass: 0.3", "mass: 0.3, mass: 0.4"), ["mass"]),
    "mass that is no number": (changed("mass: 0.3", "mass: heavy"), ["heavy"]),
    "mass not a number": (changed("mass: 0.3", "mass: .nan"), ["mass"]),
    "mass infinite": (changed("mass: 0.3", "mass: .inf"), ["mass"]),
    "mass negative": (changed("mass: 0.3", "mass: -0.3"), ["mass"]),
    "mass zero": (changed("mass: 0.3", "mass: 0"), ["mass"]),
    "friction negative": (changed("friction: 0.8", "friction: -0.8"), ["friction"]),
    "radius zero": (changed("radius: 0.03", "radius: 0"), ["radius"]),
    "radius negative": (changed("radius: 0.03", "radius: -0.03"), ["radius"]),
    "length infinite": (changed("length: 0.12", "length: .inf"), ["length"]),
    "size with two numbers": (changed("size: [2, 2, 0.04]", "size: [2, 2]"), ["size"]),
    "size with a zero": (changed("size: [2, 2, 0.04]", "size: [2, 0, 0.04]"), ["size"]),
    "size that is a word": (changed("size: [2, 2, 0.04]", "size: large"), ["size"]),
    "unknown shape": (changed("cylinder:", "cilinder:"), ["cilinder", "cylinder"]),
    "position not finite": (changed("position: [0.45,", "position: [.nan,"), ["position"]),
    "quaternion of no length": (changed("position: [0.45, 0.45, 0.50], rpy: [0, 0, 0]",
                                        "position: [0.45, 0.45, 0.50], quaternion: [0, 0, 0, 0]"), ["quaternion"]),
    "rpy and quaternion": (changed("position: [0.45, 0.45, 0.50], rpy: [0, 0, 0]",
                                   "position: [0.45, 0.45, 0.50], rpy: [0, 0, 0], quaternion: [0, 0, 0, 1]"), []),
    "id given twice": (problem(TABLE + cup("mug") + cup("mug", -0.5, 0.3)), ["mug"]),
    "movable that is no truth value": (changed("movable: true", "movable: perhaps"), ["perhaps"]),
    "unknown touch": (changed("touch: support", "touch: suport"), ["suport", "support"]),
    "unknown profile": (changed("contact-only", "contact-onyl"), ["contact-onyl"]),
    "unknown task": (changed("kind: reach", "kind: dance"), ["dance"]),
    "tolerance zero": (changed("tolerance: 0.0175", "tolerance: 0"), ["tolerance"]),
    "alias": (changed("constraints: {profile: contact-only}", "constraints: *c"), []),
    "anchor": (changed("constraints: {", "constraints: &c {"), ["anchor"]),
    "nesting without end": (nested(2000), []),
    "nesting too deep": (nested(100), ["64"]),
    "unknown joint in the group": (changed("joints: [j1, j2, j3]", "joints: [j1, j2, j9]"), ["j9"]),
    "unknown tip": (changed("tip: tip", "tip: tipp"), ["tipp", "tip"]),
    "unknown joint at the start": (changed("start: {j1: 0", "start: {j8: 0"), ["j8"]),
    "start outside the limits": (changed("start: {j1: 0", "start: {j1: 3.5"), ["j1", "3.5"]),
    "unknown joint in the goal": (changed("joints: {j1: 1.2", "joints: {j7: 1.2"), ["j7"]),
    "goal outside the limits": (changed("joints: {j1: 1.2", "joints: {j1: 4.2"), ["j1", "4.2"]),
    "speed of zero": (changed("speed_scale: 0.1", "speed_scale: 0"), ["speed_scale"]),
    "step of zero": (problem(tail="physics: {step: 0}\n"), ["step"]),
    "target that is no object": (changed("tolerance: 0.0175", "target: plate", problem().replace(
        "joints: {j1: 1.2, j2: 0.1, j3: 0.1}", "pose: {position: [0.5, 0.5, 0.5], quaternion: [0, 0, 0, 1]}")), ["plate"]),
    "robot file that is not there": (changed("planar.urdf", "plannar.urdf"), ["plannar.urdf"]),
    "mesh file that is not there": (changed("cylinder: {radius: 0.03, length: 0.12}", "mesh: {file: no_mug.obj}"),
                                    ["no_mug.obj"]),
}

# Name: (text of problem.yaml, words). The file as a whole is wrong, or the place is in another file.
UNPLACED = {
    "empty": ("", ["problem.yaml"]),
    "generated and truncated": (problem(tail="generated: {seed: 1}\n"), ["problem.yaml", "end"]),
    "no robot": ("format: mamo-problem/1\nobjects: []\n", ["problem.yaml", "robot"]),
}

# Name: (text of planar.urdf, words).
ROBOTS = {
    "urdf empty": ("", ["planar.urdf"]),
    "urdf no xml": ("robot: arm\n", ["planar.urdf"]),
    "urdf truncated": (urdf()[:300], ["planar.urdf"]),
    "urdf of another kind": ("<sdf/>\n", ["planar.urdf", "robot"]),
    "urdf joint without a parent link": (urdf().replace('<parent link="l1"/>', '<parent link="l9"/>'), ["l9"]),
    "urdf link given twice": (urdf().replace('<link name="tip"/>', '<link name="l1"/><link name="tip"/>'), ["l1"]),
    "urdf limits the wrong way round": (urdf([(1.0, -1.0), (-2, 2), (-2, 2)]), ["j1"]),
    "urdf axis of no length": (urdf().replace('<axis xyz="0 0 1"/>', '<axis xyz="0 0 0"/>', 1), ["j1", "axis"]),
    "urdf size negative": (urdf().replace('size="0.26', 'size="-0.26', 1), ["planar.urdf:1", "-0.26"]),
    "urdf mesh that is not there": (urdf().replace('<box size="0.26 0.04 0.04"/>', '<mesh filename="no_link.stl"/>', 1),
                                    ["no_link.stl"]),
    "urdf mesh in an unknown package": (
        urdf().replace('<box size="0.26 0.04 0.04"/>', '<mesh filename="package://nowhere/no_link.stl"/>', 1),
        ["nowhere"]),
    "urdf mesh without volume": (urdf().replace('<box size="0.26 0.04 0.04"/>', '<mesh filename="flat.obj"/>', 1),
                                 ["flat.obj"]),
    "urdf mesh that is no mesh": (urdf().replace('<box size="0.26 0.04 0.04"/>', '<mesh filename="noise.stl"/>', 1),
                                  ["noise.stl"]),
    "urdf joint that mimics itself": (urdf().replace('<axis xyz="0 0 1"/>', '<axis xyz="0 0 1"/><mimic joint="j1"/>', 1),
                                      ["j1", "mimic"]),
    "urdf joint that mimics nothing": (urdf().replace('<axis xyz="0 0 1"/>', '<axis xyz="0 0 1"/><mimic joint="j5"/>', 1),
                                       ["j5"]),
    "urdf limit that is no number": (urdf().replace('velocity="2"', 'velocity="fast"', 1), ["planar.urdf:1", "fast"]),
}

# Name: (text of problem.yaml, words). Found by the collision checker and inverse kinematics, before any planner starts.
WORLDS = {
    "start in collision with a fixture": (problem(TABLE + wall("post", 0.5, 0.0, 0.1, 0.1)), ["post"]),
    "start in collision with an object": (problem(TABLE + cup("mug", 0.5, 0.0)), ["mug"]),
    "objects that overlap": (problem(TABLE + cup("mug") + cup("jar", 0.46, 0.46)), ["mug", "jar"]),
    "object that floats": (problem(TABLE + cup("mug").replace("0.50]", "0.80]")), ["mug"]),
    "object inside a fixture": (problem(TABLE + cup("mug").replace("0.50]", "0.45]")), ["mug"]),
    "goal pose out of reach": (problem().replace("joints: {j1: 1.2, j2: 0.1, j3: 0.1}, tolerance: 0.0175",
                                                 "pose: {position: [5, 5, 0.5], quaternion: [0, 0, 0, 1]}"), ["goal"]),
}

# Name: (text of plan.json, words).
PLANS = {
    "plan empty": ("", ["plan.json"]),
    "plan no json": ("segments: []\n", ["plan.json"]),
    "plan truncated": ('{"segments": [{"kind": "reach", ', ["plan.json"]),
    "plan of another schema": ('{"schema": "mamo-result/9", "plan": {"segments": []}}', ["plan.json", "mamo-result/1"]),
    "plan without segments": ('{"schema": "mamo-result/1"}', ["plan.json"]),
    "plan with a list of numbers": ("[1, 2, 3]", ["plan.json"]),
    "plan of a segment that is a word": ('{"segments": ["reach"]}', ["plan.json"]),
    "plan with unknown segment kind": (
        '{"segments": [{"kind": "jump", "object": null, "joint_names": ["j1"], "points": [{"t": 0, "q": [0]}],'
        ' "objects_after": {}}]}', ["plan.json", "kind"]),
    "plan with a missing value": (
        '{"segments": [{"kind": "reach", "object": null, "joint_names": ["j1", "j2", "j3"], "points": [{"t": 0, "q": [0]}],'
        ' "objects_after": {}}]}', ["plan.json"]),
}


class BadInput(ToolTest):
    def refuse(self, command, text_words, place=None, name=""):
        before = self.files()
        run = mamo(*command, cwd=self.folder)
        self.assert_refused(run, 3, *text_words)
        self.assertNotIn("bug", run.stderr)
        self.assertLess(len(run.stderr), 2000)
        if place:
            self.assertRegex(run.stderr.splitlines()[-1], place)
        self.assertEqual(self.files(), before, name)

    def plan(self, words, place=None, name=""):
        self.refuse(("plan", self.problem, "--out", self.path("out.json")), words, place, name)

    def test_there_are_at_least_forty_cases(self):
        self.assertGreaterEqual(len(PLACED) + len(UNPLACED) + len(ROBOTS), 40)

    def test_problems_with_a_place(self):
        for name, (text, words) in PLACED.items():
            with self.subTest(name):
                self.write("problem.yaml", text)
                self.plan(words, PLACE, name)

    def test_problems_without_a_place(self):
        for name, (text, words) in UNPLACED.items():
            with self.subTest(name):
                self.write("problem.yaml", text)
                self.plan(words, name=name)

    def test_robots(self):
        self.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.write("noise.stl", "\x01\x02 no mesh \x03" * 50)
        for name, (text, words) in ROBOTS.items():
            with self.subTest(name):
                self.write("planar.urdf", text)
                self.plan(words, name=name)

    def test_files_that_are_no_text(self):
        with open(self.problem, "wb") as file:
            file.write(bytes(range(256)) * 64)
        self.plan(["problem.yaml"])
        with open(self.problem, "wb") as file:  # sparse: 200 MB of nothing
            file.truncate(200_000_000)
        self.plan(["problem.yaml"])
        os.remove(self.problem)
        self.plan(["problem.yaml"])
        os.mkdir(self.problem)
        self.plan(["problem.yaml"])

    @unittest.skipUnless(os.getuid(), "root reads everything")
    def test_an_unreadable_file(self):
        os.chmod(self.problem, 0)
        self.plan(["problem.yaml"])

    def test_a_shelf_scene_that_is_truncated(self):
        rows = ["O", "2", "1,0,-1,0.78,-0.5,0.75,0,0,0,0.3,0.4,0.02,0,0.8,False"]
        self.problem = self.write("plan_1_SCENE.txt", "\n".join(rows) + "\n")
        self.plan(["plan_1_SCENE.txt"])
        self.problem = self.write("plan_1_SCENE.txt", "\n".join(rows).replace("0.78", "nan") + "\n")
        self.plan(["plan_1_SCENE.txt"])

    def test_plans(self):
        for name, (text, words) in PLANS.items():
            with self.subTest(name):
                plan = self.write("plan.json", text)
                self.refuse(("verify", self.problem, plan), words, name=name)
        self.refuse(("verify", self.problem, self.path("none.json")), ["none.json"])

    def test_a_plan_with_a_place(self):
        plan = self.write("plan.json", json.dumps({"segments": []}, indent=1)[:-3] + "@@")
        self.refuse(("verify", self.problem, plan), [], r"plan\.json:\d+:\d+: ")

    @unittest.skipUnless(planners(), "this build has no planner, and the checks of the world come with planners")
    def test_worlds(self):
        for name, (text, words) in WORLDS.items():
            with self.subTest(name):
                self.write("problem.yaml", text)
                self.plan(["problem.yaml", *words], name=name)


if __name__ == "__main__":
    main()
