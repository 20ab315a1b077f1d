"""tools/compare_results: ratios of the same work, and refusal of different work."""
import json
import os
import subprocess
import unittest

from support import SOURCE, ToolTest, main


def plan(problem, seconds, signature="00ab", status="solved", **more):
    return json.dumps({"problem": problem, "planner": "selsim", "seed": 1, "status": status, "signature": signature,
                       "stats": {"search_s": seconds, "wall_s": 2 * seconds}, **more})


def benchmarks(times, signature="00ab", unit="ms"):
    context = {} if signature is None else {"signature": signature}
    runs = [{"name": n, "run_name": n, "run_type": "iteration", "real_time": t, "cpu_time": t, "time_unit": unit}
            for n, all_times in times.items() for t in all_times]
    runs.append({"name": "x_mean", "run_name": "x", "run_type": "aggregate", "real_time": 1e9, "time_unit": unit})
    return json.dumps({"context": context, "benchmarks": runs}, indent=1)


class CompareResults(ToolTest):
    def compare(self, a, b, *options):
        command = [os.path.join(SOURCE, "tools/compare_results"), self.write("a", a), self.write("b", b), *options]
        return subprocess.run(command, capture_output=True, text=True)

    def last_lines(self, run):
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout.splitlines()

    def test_plans_are_joined_by_problem_and_repeats_give_medians(self):
        a = "\n".join([plan("p", 4), plan("p", 2), plan("p", 3), plan("q", 8)])
        b = "\n".join([plan("q", 4), plan("p", 1)])
        lines = self.last_lines(self.compare(a, b))
        self.assertRegex(lines[1], r"^p selsim seed 1 +3/1 +3 +1 +3\.000 +2 +1 +2\.000$")
        self.assertIn("medians: 2 rows, A / B of sums 2.200, geometric mean 2.449, median 2.500, from 2.000 to 3.000", lines)

    def test_another_metric_may_be_asked_for(self):
        self.assertRegex(self.last_lines(self.compare(plan("p", 4), plan("p", 2), "--metric", "stats.wall_s"))[1], r" 8 +4 +2\.000")
        self.assert_refused(self.compare(plan("p", 4), plan("p", 2), "--metric", "stats.x"), 3, "stats.x")

    def test_benchmarks_are_joined_by_name_in_any_unit(self):
        run = self.compare(benchmarks({"one": [2, 6, 4], "two": [1]}), "signature: 00ab\n" +
                           benchmarks({"one": [2000], "three": [1]}, None, "us"))
        lines = self.last_lines(run)
        self.assertRegex(lines[1], r"^one +3/1 +0\.004 +0\.002 +2\.000")
        self.assertIn("only in A: 1 rows (two)", lines)
        self.assertIn("only in B: 1 rows (three)", lines)

    def test_different_work_is_refused(self):
        self.assert_refused(self.compare(plan("p", 4), plan("p", 2, "00ac")), 1, "signatures differ")
        self.assert_refused(self.compare("\n".join([plan("p", 4), plan("p", 2, "00ac")]), plan("p", 2)), 1, "signatures differ")
        self.assert_refused(self.compare(benchmarks({"one": [2]}), benchmarks({"one": [2]}, "00ac")), 1, "signatures differ")

    def test_work_without_a_signature_is_refused(self):
        self.assert_refused(self.compare(benchmarks({"one": [2]}, None), benchmarks({"one": [2]}, None)), 1, "no signature")

    def test_runs_that_a_clock_stopped_are_left_out(self):
        a = plan("p", 4) + "\n" + plan("q", 9)
        lines = self.last_lines(self.compare(a, plan("p", 2) + "\n" + plan("q", 60, "00ac", "timeout")))
        self.assertIn("left out: 1 rows that a clock, a signal or memory stopped", lines)
        self.assertTrue(any(line.startswith("medians: 1 rows") for line in lines), lines)

    def test_what_is_no_result_is_refused(self):
        for text in ("", "{}", "[1]", "hello", '{"benchmarks": 3}', plan("p", 1) + "\n{"):
            self.assert_refused(self.compare(text, plan("p", 2)), 3, "a")
        self.assert_refused(self.compare(plan("p", 2), plan("q", 2)), 3, "no row in common")
        run = subprocess.run([os.path.join(SOURCE, "tools/compare_results"), "one"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 64)

    def test_commands_are_run_alternately(self):
        log = self.path("log")
        script = self.write("run.sh", f'echo "$1" >> {log}; cat "$2"\n')
        commands = [f"sh {script} {name} {self.write(name, plan('p', time))}" for name, time in (("A", 3), ("B", 2))]
        run = subprocess.run([os.path.join(SOURCE, "tools/compare_results"), "--run", *commands, "--repeat", "3"],
                             capture_output=True, text=True)
        self.assertRegex(self.last_lines(run)[1], r"3/3 +3 +2 +1\.500")
        with open(log, encoding="utf-8") as file:
            self.assertEqual(file.read().split(), ["A", "B", "B", "A", "A", "B"])


if __name__ == "__main__":
    main()
