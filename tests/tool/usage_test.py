"""Wrong usage ends in 64 and outputs that cannot be written in 73, each with one line that says what was expected."""
import os

from support import ToolTest, main, mamo

SUBCOMMANDS = ("plan", "verify", "generate", "info", "convert", "bench", "report", "train", "view")

# Arguments, and words of the one line. PROBLEM stands for a problem that is fine.
WRONG = [
    ((), ["no subcommand"]),
    (("paln", "PROBLEM"), ["paln", "plan"]),
    (("train", "config.yaml"), ["train"]),
    (("train",), ["train"]),
    (("plan",), ["PROBLEM"]),
    (("plan", "PROBLEM", "another"), ["another"]),
    (("plan", "PROBLEM", "--tim-limit", "3"), ["--tim-limit", "--time-limit"]),
    (("plan", "PROBLEM", "--time-limit", "0"), ["--time-limit", "above 0", "'0'"]),
    (("plan", "PROBLEM", "--time-limit", "-1"), ["--time-limit", "'-1'"]),
    (("plan", "PROBLEM", "--time-limit", "nan"), ["--time-limit", "nan"]),
    (("plan", "PROBLEM", "--time-limit", "inf"), ["--time-limit", "inf"]),
    (("plan", "PROBLEM", "--time-limit", "ten"), ["--time-limit", "ten"]),
    (("plan", "PROBLEM", "--time-limit"), ["--time-limit"]),
    (("plan", "PROBLEM", "--threads", "-3"), ["--threads", "'-3'"]),
    (("plan", "PROBLEM", "--threads", "0"), ["--threads", "'0'"]),
    (("plan", "PROBLEM", "--threads", "2.5"), ["--threads", "2.5"]),
    (("plan", "PROBLEM", "--threads", "99999999999999999999"), ["--threads"]),
    (("plan", "PROBLEM", "--seed", "-1"), ["--seed"]),
    (("plan", "PROBLEM", "--weight", "0.5"), ["--weight", "0.5"]),
    (("plan", "PROBLEM", "--max-simulations", "-1"), ["--max-simulations"]),
    (("plan", "PROBLEM", "--max-expansions", "0"), ["--max-expansions"]),
    (("plan", "PROBLEM", "--memory-limit", "0"), ["--memory-limit"]),
    (("plan", "PROBLEM", "--planner", "selsin"), ["selsin"]),
    (("plan", "PROBLEM", "--planner", ""), ["--planner"]),
    (("plan", "PROBLEM", "--set", "nothing"), ["--set", "KEY=VALUE"]),
    (("plan", "PROBLEM", "--set", "no_such_option=1"), ["no_such_option"]),
    (("plan", "PROBLEM", "--task", "dance"), ["--task", "dance", "retrieve"]),
    (("plan", "PROBLEM", "--package-path", "here"), ["--package-path", "NAME=DIR"]),
    (("plan", "PROBLEM", "--default-mass", "0"), ["--default-mass"]),
    (("plan", "PROBLEM", "--default-friction", "-1"), ["--default-friction"]),
    (("plan", "PROBLEM", "--out", ""), ["--out"]),
    (("plan", "PROBLEM", "--out", "PROBLEM"), ["overwrite"]),
    (("verify", "PROBLEM"), ["PLAN"]),
    (("verify", "PROBLEM", "plan.json", "--robust"), ["--robust"]),
    (("generate",), ["tabletop"]),
    (("generate", "tabeltop"), ["tabeltop", "tabletop"]),
    (("generate", "tabletop"), ["--out"]),
    (("generate", "tabletop", "--movable", "-1", "--out", "d"), ["--movable"]),
    (("generate", "tabletop", "--count", "0", "--out", "d"), ["--count"]),
    (("generate", "tabletop", "--constraints", "some", "--out", "d"), ["--constraints", "some"]),
    (("convert", "PROBLEM"), ["OUTPUT"]),
    (("convert", "PROBLEM", "out.xyz"), ["out.xyz", "--to"]),
    (("convert", "PROBLEM", "out.csv"), ["problem"]),
    (("convert", "PROBLEM", "PROBLEM"), ["overwrite"]),
    (("convert", "PROBLEM", "out.yaml", "--to", "pdf"), ["--to", "pdf"]),
    (("view",), ["PROBLEM"]),
    (("view", "PROBLEM"), ["--out", "--image"]),
    (("view", "PROBLEM", "--out", "PROBLEM"), ["overwrite"]),
    (("view", "PROBLEM", "--image", "a.png", "--at", "-1"), ["--at", "'-1'"]),
    (("view", "PROBLEM", "--image", "a.png", "--width", "3"), ["--width", "'3'"]),
    (("info",), ["FILE"]),
    (("info", "PROBLEM", "--svgg", "x.svg"), ["--svgg", "--svg"]),
]


class Usage(ToolTest):
    def test_wrong_usage_is_64_with_one_line(self):
        for arguments, words in WRONG:
            with self.subTest(arguments=arguments):
                full = [self.problem if a == "PROBLEM" else a for a in arguments]
                before = self.files()
                self.assert_refused(mamo(*full, cwd=self.folder), 64, *words)
                self.assertEqual(self.files(), before)

    def test_help_shows_an_example_per_subcommand_on_standard_output(self):
        for command in SUBCOMMANDS:
            run = mamo(command, "--help")
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.assertIn(f"mamo {command}", run.stdout.partition("Example")[2], command)
        self.assertIn("mamo plan", mamo("--help").stdout)

    def test_help_names_only_subcommands_that_exist(self):
        text = mamo("--help").stdout
        for command in SUBCOMMANDS:
            self.assertIn(f"  {command} ", text)

    def test_version(self):
        run = mamo("--version")
        self.assertEqual(run.returncode, 0)
        self.assertRegex(run.stdout, r"^mamo \d+\.\d+\.\d+\n$")

    def test_config_file_errors_have_their_place(self):
        cases = [
            ("time-limit: 0\n", "config.yaml:1:13", "above 0"),
            ("threads: 1\nno_such_option: 3\n", "config.yaml:2:", "no_such_option"),
            ("a: &x 1\nb: *x\n", "config.yaml:1:", "anchor"),
            ("a: [1, 2]\n", "config.yaml:1:", "list"),
            ("a: {b: 1}\n", "config.yaml:1:", "mapping"),
            ("seed: 1\nseed: 2\n", "config.yaml:2:1", "twice"),
            ("seed: \"1\n", "config.yaml:", ""),
            ("just words\n", "config.yaml:1:1", "option: value"),
        ]
        for text, *words in cases:
            with self.subTest(text=text):
                config = self.write("config.yaml", text)
                self.assert_refused(mamo("plan", self.problem, "--config", config), 3, *words)
        self.assert_refused(mamo("plan", self.problem, "--config", self.path("none.yaml")), 3, "none.yaml")


class Outputs(ToolTest):
    def test_outputs_are_tested_before_anything_else(self):
        # A missing problem would be 3: the output is looked at first.
        missing = self.path("none.yaml")
        nowhere = self.path("no/such/folder/out.json")
        self.assert_refused(mamo("plan", missing, "--out", nowhere), 73, nowhere)
        self.assert_refused(mamo("plan", missing, "--out", self.folder), 73, self.folder)
        self.assert_refused(mamo("convert", missing, self.path("no/out.yaml")), 73, "no/out.yaml")
        self.assert_refused(mamo("info", missing, "--svg", self.path("no/top.svg")), 73, "no/top.svg")
        self.assert_refused(mamo("view", missing, "--out", self.path("no/page.html")), 73, "no/page.html")
        self.assert_refused(mamo("generate", "tabletop", "--out", self.problem), 73, self.problem)
        self.assertEqual(self.files(), ["planar.urdf", "problem.yaml"])

    def test_a_failed_run_leaves_no_output_and_keeps_an_old_one(self):
        out = self.write("out.json", "old")
        self.assert_refused(mamo("plan", self.path("none.yaml"), "--out", out), 3, "none.yaml")
        with open(out, encoding="utf-8") as file:
            self.assertEqual(file.read(), "old")
        self.assertEqual(self.files(), ["out.json", "planar.urdf", "problem.yaml"])

    def test_standard_output_that_cannot_be_written_is_73(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        import subprocess
        from support import TOOL
        with open("/dev/full", "w") as full:
            run = subprocess.run([TOOL, "info", self.problem], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(run.returncode, 73, run.stderr)


if __name__ == "__main__":
    main()
