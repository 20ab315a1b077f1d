#!/usr/bin/env python3
"""Opens playback pages from the disk in a headless Chromium: plays, scrubs, switches every layer, takes screenshots.

Screenshots stay in the folder named by MAMO_SCREENSHOTS, if it is set.
"""
import json
import os
import sys
import tempfile
import time
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(os.path.dirname(HERE), "tool")]
import browser  # noqa: E402
import retrieval  # noqa: E402
from support import SOURCE, mamo  # noqa: E402

LARGEST_PAGE = 5_000_000  # bytes
PROBLEMS = os.path.join(SOURCE, "bench/data/problems")


@unittest.skipUnless(browser.PROGRAM, "no Chromium on this machine (Debian: chromium)")
class Playback(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.shots = os.environ.get("MAMO_SCREENSHOTS") or cls.folder.name
        os.makedirs(cls.shots, exist_ok=True)
        cls.chromium = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.chromium.__exit__()
        cls.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def made(self, *arguments):
        """A page of `mamo view`, opened."""
        page = self.path("page.html")
        run = mamo("view", *arguments, "--out", page)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertLess(os.path.getsize(page), LARGEST_PAGE)
        self.chromium.open(page)
        self.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        return page

    def value(self, script):
        return self.chromium.run(script)

    def shot(self, name):
        path = self.chromium.screenshot(os.path.join(self.shots, name + ".png"))
        self.assertGreater(os.path.getsize(path), 10_000, "the picture is hardly more than one colour")

    def assert_clean(self, page):
        """Nothing on the console, nothing fetched but the page."""
        self.assertEqual(self.chromium.problems, [])
        self.assertEqual([url for url in self.chromium.requests if not url.startswith("data:")], ["file://" + page])

    def image(self):
        """The canvas as it is drawn now."""
        self.value("player.stage.invalidate(); player.stage.frame(0)")
        return self.value("(player.stage.invalidate(), player.stage.frame(0), document.getElementById('canvas').toDataURL())")

    def wait_until_played(self, seconds):
        """A busy machine draws few frames: what counts is that playback gets there."""
        patience = time.monotonic() + 30
        while self.value("player.time") <= seconds and time.monotonic() < patience:
            time.sleep(0.1)
        self.assertGreater(self.value("player.time"), seconds)

    def play_and_scrub(self):
        duration = self.value("player.replay.duration")
        self.assertGreater(duration, 1)
        self.value("player.seek(0)")
        first = self.image()
        self.chromium.click_on("#play")
        self.wait_until_played(0.2)
        self.chromium.press(" ", 32)
        self.assertFalse(self.value("player.playing"))
        box = self.value("(() => { const b = document.getElementById('timeline').getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()")
        self.chromium.mouse("mousePressed", box[0] + box[2] * 0.3, box[1] + 8, "left", 1)
        self.chromium.mouse("mouseMoved", box[0] + box[2] * 0.75, box[1] + 8, "left", 1)
        self.chromium.mouse("mouseReleased", box[0] + box[2] * 0.75, box[1] + 8, "left", 0)
        self.assertAlmostEqual(self.value("player.time"), 0.75 * duration, delta=0.02 * duration)
        self.assertTrue(self.image() != first, "the scene did not change")
        self.chromium.press("End", 35)
        self.assertAlmostEqual(self.value("player.time"), duration, places=3)
        self.chromium.press("[")
        self.assertLess(self.value("player.time"), duration)

    def toggle_every_layer(self):
        names = self.value("player.layers.layers.map((layer) => layer.name)")
        for index, name in enumerate(names):
            before = self.value(f"player.layers.layers[{index}].group.visible")
            on, off = (self.image(), None) if before else (None, self.image())
            self.chromium.press(str(index + 1))
            self.assertEqual(self.value(f"player.layers.layers[{index}].group.visible"), not before, name)
            on, off = (on, self.image()) if before else (self.image(), off)
            self.assertTrue(on != off, f"layer '{name}' shows nothing")
        for box in range(self.value("document.querySelectorAll('.layers input').length")):
            self.value(f"document.querySelectorAll('.layers input')[{box}].click()")
            self.value(f"document.querySelectorAll('.layers input')[{box}].click()")
        return names

    def test_a_tabletop_plan(self):
        plan = self.path("plan.json")
        problem = os.path.join(PROBLEMS, "demo.yaml")
        self.assertEqual(mamo("plan", problem, "--explain", "--threads", 1, "--out", plan).returncode, 0)
        page = self.made(problem, plan)
        self.assertEqual(self.value("document.getElementById('badge').textContent"), "holds in full physics")
        self.play_and_scrub()
        for theme in ("light", "dark"):
            self.chromium.theme(theme)
            self.value("player.seek(player.replay.contacts[0].from + 0.1)")
            self.shot("tabletop-" + theme)
        self.chromium.theme("light")
        names = self.toggle_every_layer()
        self.assertEqual(set(names), {"tip path", "motion of objects", "swept volume", "relevant objects", "failed motions", "heuristic"})
        # The replay of the page is that of the verification: where the plan says the objects are at the end.
        with open(plan, encoding="utf-8") as file:
            result = json.load(file)
        after = result["plan"]["segments"][-1]["objects_after"]
        silent = json.loads(mamo("plan", problem, "--json", "--threads", 2).stdout)
        self.assertEqual(result["signature"], silent["signature"], "--explain changes nothing")
        self.assertNotIn("notes", silent)
        shown = self.value("(player.seek(1e9), Object.fromEntries(player.data.objects.map((o, i) => [o.id, player.bodies.objects[i].position.toArray()])))")
        for name, pose in after.items():
            for a, b in zip(shown[name], pose):
                self.assertAlmostEqual(a, b, delta=1e-4, msg=name)
        self.assertGreater(self.value("player.replay.contacts.length"), 0)
        self.assertGreater(self.value("document.querySelectorAll('.curve').length"), 1)
        self.assert_clean(page)

    def test_names_appear_under_the_pointer(self):
        self.made(os.path.join(PROBLEMS, "demo.yaml"))
        at = self.value("(() => { const o = player.bodies.objects[1].position.clone().project(player.stage.camera);"
                        " const b = player.stage.canvas.getBoundingClientRect();"
                        " return [b.x + (o.x + 1) / 2 * b.width, b.y + (1 - o.y) / 2 * b.height]; })()")
        self.chromium.mouse("mouseMoved", *at)
        self.assertFalse(self.value("document.getElementById('tip').hidden"))
        text = self.value("document.getElementById('tip').textContent")
        self.assertTrue(any(text.startswith(name) for name in self.value("player.data.objects.map((o) => o.id)")), text)

    def test_a_shelf_retrieval(self):
        problem, plan = retrieval.write(self.folder.name)
        page = self.made(problem, plan)
        self.assertEqual(self.value("document.getElementById('badge').textContent"), "holds in full physics",
                         self.value("document.getElementById('reason').textContent"))
        self.assertEqual(self.value("player.data.segments.map((s) => s.kind)"), ["approach", "grasp", "extract"])
        self.play_and_scrub()
        self.value("player.seek(0.75 * player.replay.duration)")
        self.shot("shelf")
        self.toggle_every_layer()
        moved = self.value("(player.seek(1e9), player.bodies.objects[player.data.objects.findIndex((o) => o.role === 'target')].position.toArray())")
        self.assertGreater(moved[2], 0.9, "the object of interest was not lifted")
        self.assert_clean(page)

    def test_a_shelf_retrieval_that_pushes_what_is_in_the_way(self):
        problem, plan = os.path.join(PROBLEMS, "shelf_2.yaml"), self.path("pushes.json")
        run = mamo("plan", problem, "--explain", "--threads", 1, "--out", plan)
        self.assertEqual(run.returncode, 0, run.stderr)
        page = self.made(problem, plan)
        self.assertEqual(self.value("document.getElementById('badge').textContent"), "holds in full physics",
                         self.value("document.getElementById('reason').textContent"))
        kinds = self.value("player.data.segments.map((s) => s.kind)")
        self.assertGreaterEqual(kinds.count("push"), 2)
        self.assertEqual(kinds[-3:], ["approach", "grasp", "extract"])
        layers = self.value("document.body.textContent")
        for name in ("negative goal region", "object paths", "failed pushes"):
            self.assertIn(name, layers.lower())
        self.play_and_scrub()
        self.shot("pushes")
        self.toggle_every_layer()
        self.assertGreater(self.value("player.replay.contacts.length"), 0)
        self.assert_clean(page)

    def test_a_plan_that_does_not_hold_says_why_and_where(self):
        problem, plan = retrieval.write(self.folder.name, deep=True)
        page = self.made(problem, plan)
        self.assertEqual(self.value("document.getElementById('badge').textContent"), "does not hold")
        self.assertIn("board", self.value("document.getElementById('reason').textContent"))
        self.assertTrue(self.value("player.contacts.failure !== null && player.contacts.failure.ring.visible"))
        self.assertTrue(self.value("player.data.outcome.findings.length > 0"))
        self.shot("does-not-hold")
        self.assert_clean(page)

    def test_a_run_without_a_plan_shows_its_reason(self):
        plan = self.path("none.json")
        problem = os.path.join(PROBLEMS, "demo.yaml")
        run = mamo("plan", problem, "--max-expansions", 1, "--explain", "--threads", 1, "--out", plan)
        self.assertEqual(run.returncode, 1, run.stderr)
        page = self.made(problem, plan)
        self.assertIn("no plan", self.value("document.getElementById('badge').textContent"))
        self.assertIn("expansions", self.value("document.getElementById('reason').textContent"))
        self.assertTrue(self.value("document.getElementById('transport').hidden"))
        self.toggle_every_layer()
        self.shot("no-plan")
        self.assert_clean(page)

    def test_a_phone_sees_the_scene_and_can_play(self):
        self.chromium.resize(390, 780, mobile=True)
        try:
            plan = self.path("plan.json")
            problem = os.path.join(PROBLEMS, "demo.yaml")
            self.assertEqual(mamo("plan", problem, "--threads", 1, "--out", plan).returncode, 0)
            self.made(problem, plan)
            self.assertLessEqual(self.value("document.documentElement.scrollWidth"), 390)
            self.assertGreater(self.value("document.getElementById('canvas').getBoundingClientRect().height"), 250)
            self.chromium.click_on("#play")
            self.wait_until_played(0.05)
            self.shot("phone")
            self.chromium.click_on("#column")
            self.shot("phone-details")
        finally:
            self.chromium.resize(1280, 800)

    def test_twenty_objects_stay_small_and_play(self):
        run = mamo("generate", "tabletop", "--movable", 18, "--immovable", 2, "--count", 1, "--seed", 3, "--out", self.folder.name)
        self.assertEqual(run.returncode, 0, run.stderr)
        problem = next(os.path.join(self.folder.name, n) for n in sorted(os.listdir(self.folder.name)) if n.endswith(".yaml") and "tabletop" in n)
        plan = self.path("twenty.json")
        mamo("plan", problem, "--explain", "--threads", 1, "--max-expansions", 3000, "--out", plan)
        page = self.made(problem, plan)
        size = os.path.getsize(page)
        self.value("player.play(true)")
        time.sleep(2)  # until the page has found out what the machine can do
        before, start = self.value("player.frames"), time.monotonic()
        self.value("player.seek(0); player.play(true)")
        time.sleep(3)
        rate = (self.value("player.frames") - before) / (time.monotonic() - start)
        details = self.value("`pixel ratio ${player.stage.ratio}, shadows ${player.stage.renderer.shadowMap.enabled}, ${player.stage.renderer.info.render.triangles} triangles, status ${player.data.outcome.kind}`")
        print(f"20 objects: {size} bytes, {rate:.0f} frames/s drawn in software ({details})")
        self.assertTrue(self.value("player.moves"))
        self.assertGreater(rate, 1, "measured on a machine that may be busy: only a page that stands still fails")
        self.assert_clean(page)


class Picture(unittest.TestCase):
    def test_a_picture_is_a_png_of_the_size_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.png")
            run = mamo("view", os.path.join(PROBLEMS, "demo.yaml"), "--image", path, "--width", 320, "--height", 200)
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(path, "rb") as file:
                data = file.read()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual((int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")), (320, 200))
            again = os.path.join(folder, "b.png")
            mamo("view", os.path.join(PROBLEMS, "demo.yaml"), "--image", again, "--width", 320, "--height", 200)
            with open(again, "rb") as file:
                self.assertEqual(file.read(), data)

    def test_nothing_to_write_is_wrong_usage(self):
        run = mamo("view", os.path.join(PROBLEMS, "demo.yaml"))
        self.assertEqual(run.returncode, 64)
        self.assertIn("--out", run.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
