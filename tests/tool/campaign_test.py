"""Campaigns: results that survive kill -9 at any moment, shards on a real Slurm and under GNU parallel, lists of problem
files, and logs that OMPL's own tool accepts."""
import json
import os
import random
import shutil
import signal
import socket
import sqlite3
import subprocess
import sys
import time
import unittest

from support import SOURCE, TOOL, ToolTest, main, mamo

SUITE = """format: mamo-suite/1
problems: {generate: tabletop, movable: 2, immovable: 1, count: 12, seed: 1}
planners:
  - {name: selsim, weight: 50}
  - {name: fullsim, weight: 50}
limits: {time: 60, expansions: 2}
"""
RUNS = 24
RETRIEVALS = """format: mamo-suite/1
problems: {generate: refrigerator, count: 2, seed: 1}
planners:
  - {name: em4m}
  - {name: em4m-nodb}
limits: {time: 60, expansions: 3}
"""


def content(path):
    try:
        with open(path, "rb") as file:
            return file.read()
    except FileNotFoundError:
        return b""


def runs_of(path):
    return [json.loads(line)["run"] for line in content(path).splitlines()]


def wait_for(condition, seconds):
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.2)
    return True


class Kills(ToolTest):
    def test_twenty_kills_lose_repeat_and_tear_no_line(self):
        seed = random.randrange(10**6)
        print(f"seed {seed}", file=sys.stderr)
        moments = random.Random(seed)
        suite = self.write("many.yaml", SUITE)
        whole = self.path("whole.jsonl")
        self.assertEqual(mamo("bench", suite, "--out", whole, "--no-plans").returncode, 0)
        out = self.path("killed.jsonl")
        for _ in range(20):
            before = content(out)
            process = subprocess.Popen([TOOL, "bench", suite, "--out", out, "--resume", "--jobs", "2", "--no-plans"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            # A moment between the start and a few finished runs; killed in the middle of whatever it does then.
            wanted = len(before) + moments.randrange(1, 4000)
            deadline = time.monotonic() + moments.choice((0.05, 0.5, 20))
            while process.poll() is None and len(content(out)) < wanted and time.monotonic() < deadline:
                pass
            process.send_signal(signal.SIGKILL)
            process.communicate()
            after = content(out)
            complete = before[:before.rfind(b"\n") + 1]
            self.assertTrue(after.startswith(complete), "a line that was on the disk is gone")
            found = runs_of_text(after[:after.rfind(b"\n") + 1])
            self.assertEqual(len(found), len(set(found)), "a run stands twice")
            if len(found) == RUNS:  # all is done: begin again, so that twenty kills happen
                os.remove(out)
        run = mamo("bench", suite, "--out", out, "--resume", "--no-plans")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(content(out).endswith(b"\n"))
        self.assertEqual(sorted(runs_of(out)), sorted(runs_of(whole)))


def runs_of_text(text):
    return [json.loads(line)["run"] for line in text.splitlines()]


class Lists(ToolTest):
    def test_a_list_of_files_stands_for_a_suites_problems(self):
        suite = self.write("r.yaml", RETRIEVALS)
        self.assertEqual(mamo("generate", "refrigerator", "--count", 2, "--out", self.path("p")).returncode, 0)
        names = sorted(os.listdir(self.path("p")))
        listed = self.write("rows.txt", f"# chosen\np/{names[0]} hard\n\np/{names[1]}\n")
        out = self.path("a.jsonl")
        run = mamo("bench", suite, "--problems", "@" + listed, "--out", out, "--time-limit", 50, "--no-plans")
        self.assertEqual(run.returncode, 0, run.stderr)
        found = [json.loads(line) for line in content(out).splitlines()]
        self.assertEqual(len(found), 4)
        for line in found:
            self.assertEqual(line["difficulty_listed"], "hard" if line["problem"] == names[0] else None)
            self.assertIn(line["difficulty"], ("easy", "medium", "hard"))
            self.assertEqual(line["limits"]["time"], 50)
            self.assertEqual(line["setting"], "@rows.txt")
        self.write("rows.txt", "p/no.yaml\n")
        self.assert_refused(mamo("bench", suite, "--problems", "@" + listed), 3, "rows.txt:1", "no.yaml")


class OmplLogs(ToolTest):
    def setUp(self):
        super().setUp()
        suite = self.write("r.yaml", RETRIEVALS)
        out = self.path("a.jsonl")
        self.assertEqual(mamo("bench", suite, "--out", out, "--no-plans").returncode, 0)
        run = mamo("report", out, "--ompl-logs", "--out", self.path("report"))
        self.assertEqual(run.returncode, 0, run.stderr)
        self.log = self.path("report/r_refrigerator_full.log")

    def test_a_report_has_the_papers_tables_and_figures(self):
        files = set(os.listdir(self.path("report")))
        self.assertLessEqual({"r-solved.csv", "r-difficulty.csv", "r-order.csv", "r-time.svg", "r-simulation.svg",
                              "r-parts.svg", "r-cactus.svg"}, files)
        with open(self.path("report/r-solved.csv"), encoding="utf-8") as table:
            head = table.readline().strip()
        self.assertEqual(head, "difficulty,em4m,paper,em4m-nodb,paper")

    def test_ompls_own_tool_accepts_the_log(self):
        tool = shutil.which("ompl_benchmark_statistics")
        if not tool:
            self.skipTest("ompl_benchmark_statistics (Debian: ompl-demos) is not installed")
        base = self.path("benchmark.db")
        run = subprocess.run([tool, self.log, "-d", base], capture_output=True, text=True, cwd=self.path(""))
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        connection = sqlite3.connect(base)
        self.addCleanup(connection.close)
        self.assertEqual(connection.execute("SELECT name FROM experiments").fetchall(), [("r_refrigerator_full",)])
        names = {row[0] for row in connection.execute("SELECT name FROM plannerConfigs")}
        self.assertEqual(len(names), 2)
        rows = connection.execute("SELECT time, solved, status, simulations FROM runs").fetchall()
        self.assertEqual(len(rows), 4)
        for seconds, solved, status, _ in rows:
            self.assertGreater(seconds, 0)
            self.assertEqual(solved == 1, status == 0)


class GnuParallel(ToolTest):
    def test_shards_side_by_side_are_the_whole(self):
        parallel = shutil.which("parallel")
        if not parallel:
            self.skipTest("GNU parallel is not installed")
        suite = self.write("many.yaml", SUITE)
        run = subprocess.run(f"seq 3 | {parallel} --will-cite -j2 {TOOL} bench {suite} --shard {{}}/3 --no-plans "
                             f"--out {self.path('part')}-{{}}.jsonl --resume", shell=True, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        parts = [runs_of(self.path(f"part-{i}.jsonl")) for i in (1, 2, 3)]
        self.assertEqual(len({name for part in parts for name in part}), RUNS)
        self.assertEqual(sum(map(len, parts)), RUNS)


def slurm_program(name):
    """Debian calls them slurmctld-wlm; an alternative links the plain name."""
    places = os.environ["PATH"] + ":/usr/sbin:/usr/local/sbin"
    return shutil.which(name, path=places) or shutil.which(name + "-wlm", path=places)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Slurm(ToolTest):
    """A controller and a node of our own on this machine, with everything they write in the test's folder."""

    def setUp(self):
        super().setUp()
        self.programs = {name: slurm_program(name) for name in ("slurmctld", "slurmd", "slurmstepd", "sbatch", "squeue")}
        missing = [name for name, path in self.programs.items() if not path]
        if missing:
            self.skipTest("not installed: " + ", ".join(missing) + " (Debian: slurm-wlm)")
        if os.geteuid() != 0:
            self.skipTest("a slurmd of our own needs root")
        self.node = socket.gethostname().split(".")[0]
        for folder in ("state", "spool"):
            os.mkdir(self.path(folder))
        plugins = os.path.join(os.path.dirname(self.programs["sbatch"]), "../lib/x86_64-linux-gnu/slurm-wlm")
        self.conf = self.write("slurm.conf", f"""ClusterName=mamotest
SlurmctldHost=localhost
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
StateSaveLocation={self.path('state')}
SlurmdSpoolDir={self.path('spool')}
SlurmctldPidFile={self.path('ctld.pid')}
SlurmdPidFile={self.path('d.pid')}
SlurmctldLogFile={self.path('ctld.log')}
SlurmdLogFile={self.path('d.log')}
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
PluginDir={os.path.realpath(plugins)}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/builtin
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
NodeName={self.node} NodeAddr=localhost CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=all Nodes={self.node} Default=YES State=UP
""")
        self.environment = {**os.environ, "SLURM_CONF": self.conf, "MAMO": os.path.realpath(TOOL)}
        self.start("slurmctld", "-D", "-i", "-f", self.conf)
        time.sleep(1)
        self.start("slurmd", "-D", "-N", self.node, "-f", self.conf, "-d", self.programs["slurmstepd"])

    def start(self, name, *arguments):
        process = subprocess.Popen([self.programs[name], *arguments], env=self.environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        def stop():
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

        self.addCleanup(stop)

    def submit(self, array, *arguments):
        run = subprocess.run([self.programs["sbatch"], "--array=" + array, "--cpus-per-task=1",
                              "--output=" + self.path("log-%a.txt"), os.path.join(SOURCE, "tools/slurm_bench"),
                              *arguments], env=self.environment, capture_output=True, text=True, cwd=self.path(""))
        self.assertEqual(run.returncode, 0, run.stderr + content(self.path("ctld.log")).decode(errors="replace"))

    def queue_is_empty(self):
        run = subprocess.run([self.programs["squeue"], "--noheader"], env=self.environment, capture_output=True, text=True)
        return run.returncode == 0 and not run.stdout.strip()

    def logs(self):
        return "".join(content(self.path(n)).decode(errors="replace") for n in sorted(os.listdir(self.path("")))
                       if n.startswith("log-") or n in ("ctld.log", "d.log"))

    def test_an_array_job_runs_a_suite_and_can_be_submitted_again(self):
        suite = self.write("many.yaml", SUITE)
        results = self.path("results")
        self.submit("1-3", "4", suite, results, "--no-plans")  # three of four tasks
        self.assertTrue(wait_for(self.queue_is_empty, 180), self.logs())
        self.submit("1-4", "4", suite, results, "--no-plans")  # the same again, and the one that is missing
        self.assertTrue(wait_for(self.queue_is_empty, 180), self.logs())
        parts = [runs_of(os.path.join(results, name)) for name in sorted(os.listdir(results))]
        self.assertEqual(len(parts), 4, self.logs())
        merged = [name for part in parts for name in part]
        self.assertEqual(len(merged), RUNS, self.logs())
        self.assertEqual(len(set(merged)), RUNS)


if __name__ == "__main__":
    main()
