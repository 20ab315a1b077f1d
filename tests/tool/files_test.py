"""`generate`, `info` and `convert`: what they write, and that it is read back as what it was."""
import os
import re
import xml.etree.ElementTree

from support import ToolTest, main, mamo

# A published-format scene: two shelf parts, a target, one more immovable, one movable (EM4M's text format).
SCENE = """O
5
1,0,-1,0.78,-0.5,0.75,0.0,0.0,0.0,0.3,0.4,0.02,0,0.8,False
2,0,-1,1.1,-0.5,0.93,0.0,0.0,0.0,0.02,0.4,0.2,0,0.8,False
6,0,0,0.9,-0.39,0.86,0.0,0.0,3.2,0.03,0.07,0.09,0.25,0.84,False
7,2,0,0.85,-0.6,0.845,0.0,0.0,0.24,0.03,0.03,0.15,0.1,0.83,False
8,2,1,0.65,-0.45,0.845,0.0,0.0,0.0,0.04,0.04,0.15,0.2,0.9,True
R
0.0,0.0,0.0,0.0,0.0,0.0,1.0
S
8
torso_lift_joint,0
r_shoulder_pan_joint,-1.69017
r_shoulder_lift_joint,-0.0788625
r_upper_arm_roll_joint,-1.69017
r_elbow_flex_joint,-1.2717
r_forearm_roll_joint,-0.151824
r_wrist_flex_joint,-1.25254
r_wrist_roll_joint,0.675062
G
0.78,-0.6,0.85,0.0,0.0,0.0
ooi
7
"""


class Generate(ToolTest):
    def generate(self, folder, count, *options):
        run = mamo("generate", "tabletop", "--movable", 4, "--immovable", 1, "--count", count, "--seed", 5, "--out",
                   self.path(folder), *options)
        self.assertEqual(run.returncode, 0, run.stderr)
        texts = {}
        for name in sorted(os.listdir(self.path(folder))):
            with open(os.path.join(self.path(folder), name), encoding="utf-8") as file:
                texts[name] = file.read()
        return run, texts

    def test_exactly_count_files_and_file_i_does_not_depend_on_the_count(self):
        few = self.generate("few", 2)[1]
        more = self.generate("more", 4)[1]
        self.assertEqual((len(few), len(more)), (2, 4))
        for name, text in few.items():
            self.assertTrue(name.endswith(".yaml"))
            self.assertEqual(text, more[name])
            self.assertTrue(text.rstrip().endswith("end: true"))
            self.assertIn("goal_redraws", text)
            self.assertIn("contact-only", text)
        self.assertIn("profile: full", next(iter(self.generate("full", 1, "--constraints", "full")[1].values())))

    def test_it_says_how_many_are_solvable_touching_nothing(self):
        self.assertRegex(self.generate("some", 3)[0].stdout, r"of 3 problems \d+ (is|are) solvable touching nothing")

    def test_what_it_writes_loads(self):
        for name in self.generate("some", 3)[1]:
            run = mamo("info", self.path("some/" + name))
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.assertIn("4 movable", run.stdout)
            self.assertIn("1 immovable", run.stdout)

    def test_files_of_others_are_left_alone_and_warned_of(self):
        os.mkdir(self.path("used"))
        self.write("used/mine.yaml", "mine")
        run, texts = self.generate("used", 1)
        self.assertEqual(texts["mine.yaml"], "mine")
        self.assertIn("1 other .yaml", run.stderr)


class Info(ToolTest):
    def test_robot_problem_and_picture(self):
        self.assertIn("planar", mamo("info", self.path("planar.urdf")).stdout)
        run = mamo("info", self.problem, "--svg", self.path("top.svg"))
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        for word in ("cup", "table", "j1", "reach", "contact-only"):
            self.assertIn(word, run.stdout)
        self.assertTrue(xml.etree.ElementTree.parse(self.path("top.svg")).getroot().tag.endswith("svg"))

    def test_a_picture_of_a_robot_is_wrong_usage(self):
        self.assert_refused(mamo("info", self.path("planar.urdf"), "--svg", self.path("x.svg")), 64, "--svg")
        self.assertNotIn("x.svg", self.files())


class Convert(ToolTest):
    def info(self, path, *options):
        """Without the lines that name the file."""
        run = mamo("info", path, *options)
        self.assertEqual(run.returncode, 0, run.stderr)
        return [line for line in run.stdout.splitlines() if not re.match(r"problem |  from |  sha256 ", line)]

    def test_a_shelf_scene_becomes_the_same_native_problem(self):
        scene = self.write("plan_5_SCENE.txt", SCENE)
        for task in ("reach", "retrieve"):
            run = mamo("convert", scene, self.path(task + ".yaml"), "--task", task)
            self.assertEqual((run.returncode, run.stdout), (0, self.path(task + ".yaml") + "\n"), run.stderr)
            self.assertEqual(self.info(self.path(task + ".yaml")), self.info(scene, "--task", task))

    def test_converting_a_native_problem_again_changes_nothing(self):
        self.assertEqual(mamo("convert", self.problem, self.path("a.yaml")).returncode, 0)
        self.assertEqual(mamo("convert", self.path("a.yaml"), self.path("b.yaml")).returncode, 0)
        with open(self.path("a.yaml"), encoding="utf-8") as a, open(self.path("b.yaml"), encoding="utf-8") as b:
            self.assertEqual(a.read(), b.read())
        self.assertEqual(self.info(self.path("a.yaml")), self.info(self.problem))


if __name__ == "__main__":
    main()
