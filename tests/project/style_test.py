#!/usr/bin/env python3
"""Habits a machine can hold: no hidden clocks or randomness in algorithms, no path of somebody's machine."""
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("MAMO_SOURCE_DIR", Path(__file__).resolve().parents[2]))
CODE = ("src/", "include/", "tools/", "bench/")
SUFFIXES = (".hpp", ".h", ".cpp", ".cc")

# What is banned in code, why, and where it is allowed after all (path prefix -> reason).
BANNED = [
    (re.compile(r"\brandom_device\b|\bs?rand\s*\(|\bmt19937|\bdefault_random_engine\b"),
     "randomness comes from RandomStream, keyed by what it is for", {}),
    (re.compile(r"\b(?:steady_clock|system_clock|high_resolution_clock|Clock)\s*::\s*now\b|\bclock_gettime\b"
                r"|\bgettimeofday\b|\btime\s*\(\s*(?:NULL|nullptr|0)\s*\)"),
     "no clock decides a result: only common/stop reads one",
     {"src/common/common.cpp": "StopSource, the one deadline",
      "include/mamo/common/stopwatch.hpp": "wall times that are reported and never read by an algorithm",
      "src/common/cpu_time.cpp": "CPU time of the thread, reported likewise",
      "include/mamo/search/parallel_search.hpp": "time stamps of the trace, written and never read by the search",
      "src/physics/evaluation.cpp": "Evaluator::simulation_s, reported and never read by an algorithm",
      "src/search/toy_": "toy domains with scripted delays: they wait and read no result off the clock",
      "src/experiments/": "when a run started, in its record",
      "tools/": "wall times of the report and of the progress line",
      "bench/": "measures"}),
    (re.compile(r"\bthread_local\b"), "scratch is passed in a context", {}),
    (re.compile(r"\bTODO\b|\bFIXME\b|\bXXX\b"), "an open end belongs in an issue", {}),
]
MACHINE_PATH = re.compile(r"(?<![\w.$}/~-])/(?:work|tmp|root|home)/\w")
PATH_ALLOWED = {"tests/project/style_test.py": "names them in order to forbid them"}


def tracked_files():
    listing = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z"], capture_output=True, check=False)
    if listing.returncode != 0:  # an export without .git: every file that is no build output
        return [str(p.relative_to(ROOT)) for p in sorted(ROOT.rglob("*"))
                if p.is_file() and p.relative_to(ROOT).parts[0] not in ("build", ".git", ".cache")]
    return [name for name in listing.stdout.decode().split("\0") if name]


def without_comment(line):
    return line.split("//")[0]


def code_findings(name, text):
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        for pattern, reason, allowed in BANNED:
            subject = line if "TODO" in pattern.pattern else without_comment(line)
            if pattern.search(subject) and not any(name.startswith(prefix) for prefix in allowed):
                found.append(f"{name}:{number}: {reason}: {line.strip()}")
        if "\t" in line or line != line.rstrip():
            found.append(f"{name}:{number}: tab or trailing blank")
    return found


def path_findings(name, text):
    if name in PATH_ALLOWED:
        return []
    return [f"{name}:{number}: a path of one machine: {line.strip()[:100]}"
            for number, line in enumerate(text.splitlines(), 1) if MACHINE_PATH.search(line)]


class Style(unittest.TestCase):
    def test_code_keeps_the_bans(self):
        found = []
        for name in tracked_files():
            if name.startswith(CODE) and name.endswith(SUFFIXES) and (ROOT / name).exists():
                found += code_findings(name, (ROOT / name).read_text(encoding="utf-8"))
        self.assertEqual(found, [], "\n" + "\n".join(found))

    def test_no_path_of_one_machine_is_tracked(self):
        found = []
        for name in tracked_files():
            path = ROOT / name
            if not path.is_file() or path.stat().st_size > 4_000_000:
                continue
            data = path.read_bytes()
            if b"\0" not in data[:4096]:
                found += path_findings(name, data.decode("utf-8", errors="replace"))
        self.assertEqual(found, [], "\n" + "\n".join(found))


class Planted(unittest.TestCase):
    def test_each_ban_is_noticed(self):
        for line in ("std::random_device d;", "int x = rand();", "auto t = std::chrono::steady_clock::now();",
                     "thread_local int x;", "int x;  // TODO later", "int x; "):
            self.assertEqual(len(code_findings("src/model/a.cpp", line)), 1, line)

    def test_words_that_only_look_alike_pass(self):
        for line in ("double operand(int x);", "// a random_device would not repeat", "stop.set_time_limit(1);"):
            self.assertEqual(code_findings("src/model/a.cpp", line), [], line)

    def test_allowed_places_pass(self):
        self.assertEqual(code_findings("bench/a.cpp", "auto t = steady_clock::now();"), [])

    def test_machine_paths_are_noticed_and_relative_ones_pass(self):
        for text in ("see /work" + "/shared", "open('/tmp" + "/x')", '"/root' + '/a"', "/home" + "/me/x"):
            self.assertEqual(len(path_findings("a.md", text)), 1, text)
        for text in ("../shared/work/x", "${DIR}/tmp/x", "$TMPDIR/tmp/y", "a/work/b", "https://a.org/home/x"):
            self.assertEqual(path_findings("a.md", text), [], text)


if __name__ == "__main__":
    sys.exit(unittest.main())
