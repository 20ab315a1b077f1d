#!/usr/bin/env python3
"""The page of `mamo report` in a headless Chromium: it sorts, it searches, and every run leads to its playback."""
import os
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(os.path.dirname(HERE), "tool")]
import browser  # noqa: E402
from support import mamo  # noqa: E402

SUITE = """format: mamo-suite/1
problems:
  - {generate: tabletop, movable: 3, immovable: 1, count: 7, seed: 1, constraints: contact-only}
  - {generate: tabletop, movable: 6, immovable: 1, count: 7, seed: 1, constraints: contact-only}
planners:
  - {name: selsim}
limits: {time: 20, simulations: 300}
"""


@unittest.skipUnless(browser.PROGRAM, "no Chromium on this machine (Debian: chromium)")
class Report(unittest.TestCase):
    def test_a_report_sorts_searches_and_leads_to_playback(self):
        with tempfile.TemporaryDirectory() as folder, browser.Browser() as chromium:
            path = lambda *names: os.path.join(folder, *names)
            with open(path("suite.yaml"), "w", encoding="utf-8") as file:
                file.write(SUITE)
            run = mamo("bench", path("suite.yaml"), "--out", path("r.jsonl"), "--pages", path("report", "pages"), timeout=400)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(len(os.listdir(path("report", "pages"))), 14)
            run = mamo("report", path("r.jsonl"), "--out", path("report"))
            self.assertEqual(run.returncode, 0, run.stderr)
            page = path("report", "index.html")
            chromium.open(page)

            chromium.run("document.querySelector('details').open = true")
            cells = "[...document.querySelectorAll('details tbody tr')].filter((r) => !r.hidden).map((r) => Number(r.cells[6].textContent))"
            before = chromium.run(cells)
            self.assertEqual(len(before), 14)
            heading = "document.querySelectorAll('details th')[6]"
            chromium.run(f"{heading}.querySelector('button').click()")
            self.assertEqual(chromium.run(cells), sorted(before))
            self.assertEqual(chromium.run(f"{heading}.getAttribute('aria-sort')"), "ascending")
            chromium.run(f"{heading}.querySelector('button').click()")
            self.assertEqual(chromium.run(cells), sorted(before, reverse=True))
            chromium.run("(() => { const f = document.querySelector('.search'); f.value = '6'; f.dispatchEvent(new Event('input')); f.value = ''; f.dispatchEvent(new Event('input')); })()")
            self.assertEqual(len(chromium.run(cells)), 14)

            shots = os.environ.get("MAMO_SCREENSHOTS")
            if shots:
                os.makedirs(shots, exist_ok=True)
                for theme in ("light", "dark"):
                    chromium.theme(theme)
                    chromium.screenshot(os.path.join(shots, f"report-{theme}.png"))
                chromium.run("document.querySelector('details').scrollIntoView()")
                chromium.screenshot(os.path.join(shots, "report-runs.png"))
            self.assertEqual(chromium.problems, [])
            self.assertEqual([u for u in chromium.requests if not u.startswith("data:")], ["file://" + page])

            links = chromium.run("[...document.querySelectorAll('details a')].map((a) => a.href)")
            self.assertEqual(len(links), 14)
            chromium.open(links[0].removeprefix("file://"))
            self.assertIn(chromium.run("document.getElementById('badge').className"), ("badge holds", "badge failed"))
            self.assertEqual(chromium.problems, [])

    def test_the_page_fits_a_phone(self):
        with tempfile.TemporaryDirectory() as folder, browser.Browser(390, 780) as chromium:
            suite = SUITE.replace("count: 7", "count: 1")
            with open(os.path.join(folder, "suite.yaml"), "w", encoding="utf-8") as file:
                file.write(suite)
            lines = os.path.join(folder, "r.jsonl")
            self.assertEqual(mamo("bench", os.path.join(folder, "suite.yaml"), "--out", lines).returncode, 0)
            self.assertEqual(mamo("report", lines, "--out", folder).returncode, 0)
            chromium.open(os.path.join(folder, "index.html"))
            self.assertLessEqual(chromium.run("document.documentElement.scrollWidth"), 390)
            self.assertEqual(chromium.run("document.querySelectorAll('details a').length"), 0, "no pages, no links")


if __name__ == "__main__":
    unittest.main(verbosity=2)
