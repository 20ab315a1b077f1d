"""Threads, schedules and batches do not show in what `mamo plan` says: each run in a process of its own.

A handful of generated problems; all 30 with MAMO_LONG (tools/check --long)."""
import json
import os
import unittest

from support import SOURCE, ToolTest, main, mamo, planners

LONG = "MAMO_LONG" in os.environ
SHIPPED = os.path.join(SOURCE, "bench/data/problems")
# What may differ between runs: times, memory, what was evaluated besides, and the option itself.
VARYING = {"wall_s", "found_s", "load_s", "search_s", "tracking_s", "verification_s", "simulation_s", "simulations",
           "peak_memory_mb", "mapf_s", "push_planning_s"}


def facts(run):
    result = json.loads(run.stdout)
    stats = {name: value for name, value in result["stats"].items() if name not in VARYING}
    return {**result, "stats": stats, "threads": None}


@unittest.skipUnless("selsim" in planners(), "this build has no planner selsim (mamo plan --help lists none)")
class Threads(ToolTest):
    def problems(self):
        """Paths of generated problems: (movable, immovable, how many of them)."""
        sizes = [(8, 1, 10), (12, 2, 10), (16, 3, 10)] if LONG else [(10, 2, 2), (14, 2, 1)]
        for movable, immovable, count in sizes:
            folder = self.path(f"p{movable}")
            run = mamo("generate", "tabletop", "--movable", movable, "--immovable", immovable, "--count", count, "--seed", 13,
                       "--out", folder)
            self.assertEqual(run.returncode, 0, run.stderr)
            yield from sorted(os.path.join(folder, name) for name in os.listdir(folder) if name.startswith("tabletop-"))

    def same(self, path, fixed, variants):
        """The facts of a run with one thread, which those of all variants are compared with."""
        base = ("plan", path, "--json", "--quiet", "--time-limit", 600, *fixed)
        serial = facts(mamo(*base, "--threads", 1, timeout=900))
        for variant in variants:
            with self.subTest(problem=os.path.basename(path), fixed=fixed, variant=variant):
                self.assertEqual(facts(mamo(*base, *variant, timeout=900)), serial)
        return serial

    def test_threads_and_batches_change_nothing(self):
        variants = [("--threads", threads, "--batch", batch) for threads in (1, 2, 3, 8) for batch in (1, 4, 16)]
        count = 0
        for count, path in enumerate(self.problems(), 1):
            planner = "fullsim" if count % 3 == 0 else "selsim"
            self.same(path, ("--planner", planner, "--max-simulations", 150, "--max-expansions", 400),
                      variants if LONG else variants[count % 2::2])
        self.assertEqual(count, 30 if LONG else 3)

    def test_a_process_that_plans_them_all_gives_the_same_signatures(self):
        suite = self.write("suite.yaml", "format: mamo-suite/1\nproblems:\n"
                           "  - {generate: tabletop, movable: 10, immovable: 2, count: %d, seed: 13}\n"
                           "planners: [{name: selsim, weight: 10}]\n"
                           "limits: {time: 600, expansions: 400, simulations: 150}\n" % (30 if LONG else 5))
        alone = {}
        folder = self.path("alone")
        mamo("generate", "tabletop", "--movable", 10, "--immovable", 2, "--count", 30 if LONG else 5, "--seed", 13, "--out", folder)
        for name in os.listdir(folder):
            if name.startswith("tabletop-"):
                run = mamo("plan", os.path.join(folder, name), "--json", "--quiet", "--weight", 10, "--time-limit", 600,
                           "--max-expansions", 400, "--max-simulations", 150, "--threads", 1)
                alone[name] = json.loads(run.stdout)["signature"]
        for threads, jobs in ((1, 1), (3, 2), (8, 1)):
            out = self.path(f"{threads}.jsonl")
            run = mamo("bench", suite, "--out", out, "--no-plans", "--threads", threads, "--jobs", jobs, timeout=900)
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(out, encoding="utf-8") as lines:
                together = {os.path.basename(line["problem"]): line["signature"] for line in map(json.loads, lines)}
            self.assertEqual(together, alone)

    def test_schedules_change_nothing_on_the_shipped_problems(self):
        for name in sorted(os.listdir(SHIPPED)):
            variants = [("--threads", 2, "--schedule", schedule) for schedule in ("runahead", "window", "batch")]
            serial = self.same(os.path.join(SHIPPED, name), (), variants)
            self.assertEqual(serial["status"], "solved")


if __name__ == "__main__":
    main()
