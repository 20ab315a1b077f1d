"""`mamo bench` and `mamo report` end to end: lines, resuming after a kill, shards, jobs, and the files of a report."""
import json
import os
import signal
import subprocess
import time
import unittest
import xml.dom.minidom

from support import TOOL, ToolTest, main, mamo, problem

SUITE = """format: mamo-suite/1
problems:
  - {generate: tabletop, movable: 3, immovable: 1, count: 4, seed: 1}
  - {generate: tabletop, movable: 4, immovable: 2, count: 2, seed: 1}
planners:
  - {name: selsim, weight: 50}
  - {name: fullsim, weight: 50, count: 2}
limits: {time: 60, expansions: 20}
"""
RUNS = 4 + 2 + 2 + 2
VARYING = {"wall_s", "found_s", "load_s", "search_s", "tracking_s", "verification_s", "simulation_s", "simulations",
           "peak_memory_mb", "mapf_s", "push_planning_s"}


def lines(path):
    with open(path, encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def content(path):
    with open(path, "rb") as file:
        return file.read()


def facts(path):
    """What of a results file does not depend on clock, jobs or threads: run -> line."""
    by_run = {}
    for line in lines(path):
        assert line["run"] not in by_run, line["run"] + " stands twice"
        by_run[line["run"]] = {**{k: v for k, v in line.items() if k not in ("started", "threads")},
                               "stats": {k: v for k, v in line["stats"].items() if k not in VARYING}}
    return by_run


class Bench(ToolTest):
    def setUp(self):
        super().setUp()
        self.suite = self.write("tiny.yaml", SUITE)

    def bench(self, out, *more):
        run = mamo("bench", self.suite, "--out", self.path(out), "--threads", 1, *more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return self.path(out)

    def test_every_run_is_one_line_that_says_how_it_was_made(self):
        found = lines(self.bench("a.jsonl"))
        self.assertEqual(len(found), RUNS)
        for line in found:
            self.assertEqual(line["schema"], "mamo-result/1")
            self.assertEqual(line["suite"], "tiny")
            self.assertIn(line["status"], ("solved", "limit"))
            self.assertEqual(line["reason"] == "", line["status"] == "solved")
            self.assertEqual(line["limits"], {"time": 60, "simulations": None, "expansions": 20})
            self.assertEqual(line["weight"], 50)
            self.assertTrue({"processor", "cores", "compiler", "libraries"} <= set(line["machine"]))
            self.assertRegex(line["commit"], "^([0-9a-f]{40}(-dirty)?|unknown)$")
            self.assertRegex(line["started"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
            self.assertRegex(line["signature"], "^[0-9a-f]{16}$")

    def test_jobs_and_shards_change_nothing_but_times(self):
        whole = facts(self.bench("whole.jsonl"))
        self.assertEqual(facts(self.bench("jobs.jsonl", "--jobs", 3)), whole)
        parts = {}
        for i in (1, 2, 3):
            part = facts(self.bench(f"part{i}.jsonl", "--shard", f"{i}/3"))
            self.assertTrue(part)
            self.assertFalse(set(part) & set(parts))
            parts.update(part)
        self.assertEqual(parts, whole)

    def test_a_line_is_what_generate_and_plan_give(self):
        line = lines(self.bench("a.jsonl"))[0]
        mamo("generate", "tabletop", "--movable", 3, "--immovable", 1, "--out", self.path("g"))
        plan = mamo("plan", self.path("g/" + line["problem"]), "--planner", line["planner"], "--weight", 50,
                    "--max-expansions", 20, "--json", "--threads", 1)
        result = json.loads(plan.stdout)
        for key in ("problem_sha256", "signature", "cost", "status", "plan"):
            self.assertEqual(line[key], result[key], key)

    def test_a_killed_bench_resumes_without_losing_or_repeating_a_run(self):
        whole = facts(self.bench("whole.jsonl"))
        out = self.path("killed.jsonl")
        for wanted in (2, 5):
            process = subprocess.Popen([TOOL, "bench", self.suite, "--out", out, "--resume", "--jobs", "2"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            deadline = time.monotonic() + 60
            while process.poll() is None and time.monotonic() < deadline:
                if os.path.exists(out) and os.path.getsize(out) > 0 and content(out).count(b"\n") >= wanted:
                    break
                time.sleep(0.001)
            process.send_signal(signal.SIGKILL)
            process.wait()
            with open(out, "ab") as file:
                file.write(b'{"schema": "mamo-res')  # as a kill in the middle of a line leaves it
        self.bench("killed.jsonl", "--resume")
        self.assertEqual(facts(out), whole)
        again = os.path.getsize(out)
        self.bench("killed.jsonl", "--resume")
        self.assertEqual(os.path.getsize(out), again)

    def test_an_interrupted_bench_keeps_what_is_finished_and_ends_within_a_second(self):
        self.write("tiny.yaml", SUITE.replace("count: 4", "count: 400"))
        out = self.path("a.jsonl")
        process = subprocess.Popen([TOOL, "bench", self.suite, "--out", out, "--threads", "1"], stderr=subprocess.PIPE,
                                   stdout=subprocess.DEVNULL, text=True)
        while not os.path.exists(out) or os.path.getsize(out) == 0:
            time.sleep(0.005)
        process.send_signal(signal.SIGINT)
        started = time.monotonic()
        _, errors = process.communicate(timeout=30)
        self.assertLess(time.monotonic() - started, 2)
        self.assertEqual(process.returncode, 1)
        self.assertIn("interrupted", errors)
        for line in lines(out):
            self.assertNotEqual(line["status"], "interrupted")

    def test_problem_files_run_without_a_suite(self):
        self.write("other.yaml", problem(goal=(0.5, 0.1, 0.1)))
        self.write("tiny.yaml", "x")
        run = mamo("bench", "--problems", self.path("[po]*.yaml"), "--planners", "selsim,fullsim", "--time-limit", 30)
        self.assertEqual(run.returncode, 0, run.stderr)
        found = [json.loads(line) for line in run.stdout.splitlines()]
        self.assertEqual(len({line["run"] for line in found}), 4)
        self.assertEqual({line["problem"] for line in found}, {"problem.yaml", "other.yaml"})

    def test_a_problem_that_cannot_be_read_is_a_failure_and_not_the_end(self):
        self.write("bad.yaml", "format: mamo-problem/1\n")
        run = mamo("bench", "--problems", self.path("*[bd]*.yaml"), "--planners", "selsim", "--no-plans")
        self.assertEqual(run.returncode, 0, run.stderr)
        status = {line["problem"].split("/")[-1]: line for line in map(json.loads, run.stdout.splitlines())}
        self.assertEqual(status["bad.yaml"]["status"], "invalid")
        self.assertIn("bad.yaml", status["bad.yaml"]["reason"])
        self.assertEqual(status["problem.yaml"]["status"], "solved")
        self.assertIsNone(status["problem.yaml"]["plan"])

    def test_wrong_use_is_refused_in_one_line(self):
        out = self.path("a.jsonl")
        for arguments, words in ((("bench",), ["--problems"]),
                                 (("bench", self.suite, "--shard", "3/2"), ["3/2", "I/N"]),
                                 (("bench", self.suite, "--resume"), ["--out"]),
                                 (("bench", self.suite, "--planners", "selsim"), ["--planners"]),
                                 (("bench", "--problems", self.problem), ["--planners"]),
                                 (("bench", "--problems", self.problem, "--planners", "selsym"), ["selsym"])):
            with self.subTest(arguments):
                self.assert_refused(mamo(*arguments), 64, *words)
        self.write("tiny.yaml", SUITE.replace("weight: 50}", "weight: 50, set: {padding: 7}}", 1))
        self.assert_refused(mamo("bench", self.suite, "--out", out), 64, "padding", "7")
        self.write("tiny.yaml", SUITE + "planets: 3\n")
        self.assert_refused(mamo("bench", self.suite), 3, "tiny.yaml:9:1", "planets", "planners")
        self.write("tiny.yaml", SUITE)
        self.assert_refused(mamo("bench", self.suite, "--out", self.path("no/a.jsonl")), 73, "no/a.jsonl")

    def test_a_results_file_is_neither_overwritten_nor_mixed(self):
        out = self.bench("a.jsonl", "--shard", "1/6")
        self.assert_refused(mamo("bench", self.suite, "--out", out), 64, "--resume")
        self.write("tiny.yaml", SUITE.replace("expansions: 20", "expansions: 21"))
        self.assert_refused(mamo("bench", self.suite, "--out", out, "--resume"), 64, "suite has changed")


class Report(ToolTest):
    def test_a_report_has_tables_charts_and_a_page(self):
        suite = self.write("tiny.yaml", SUITE.replace("movable: 4, immovable: 2", "movable: 10, immovable: 2"))
        out = self.path("a.jsonl")
        self.assertEqual(mamo("bench", suite, "--out", out, "--no-plans").returncode, 0)
        notes = self.write("notes.md", "Looked at <two> of them.")
        run = mamo("report", out, out, "--out", self.path("r"), "--notes", notes)
        self.assertEqual(run.returncode, 0, run.stderr)
        files = set(os.listdir(self.path("r")))
        self.assertLessEqual({"index.html", "report.md", "tiny-results.csv", "tiny-comparison.csv", "tiny-objects.svg",
                              "tiny-immovable.svg", "tiny-budget.svg", "tiny-cactus.svg"}, files)
        for name in files:
            if name.endswith(".svg"):
                xml.dom.minidom.parse(self.path("r/" + name))
        page = content(self.path("r/index.html")).decode()
        for words in ("62.342", "prefers-color-scheme", "Looked at &lt;two&gt;", "0.01 m, 0.05 rad", "weight 50",
                      "published (Table I)"):
            self.assertIn(words, page)
        self.assertNotIn("http-equiv", page)
        with open(self.path("r/tiny-results.csv"), encoding="utf-8") as table:
            rows = table.read().splitlines()
        self.assertEqual(len(rows), 1 + 2 * 2)
        self.assertTrue(any(row.startswith("tabletop 3+1 contact-only,fullsim,") and "/2," in row for row in rows), rows)

    def test_what_is_no_results_file_is_refused(self):
        bad = self.write("bad.jsonl", "{}\n")
        self.assert_refused(mamo("report", bad, "--out", self.path("r")), 3, "bad.jsonl:1")
        self.assert_refused(mamo("report", self.path("no.jsonl"), "--out", self.path("r")), 3, "no.jsonl")


if __name__ == "__main__":
    main()
