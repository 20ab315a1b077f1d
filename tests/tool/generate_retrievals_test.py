"""`mamo generate shelf` and `refrigerator` from the command line: files, classes, limits."""
import os
import unittest

from support import ToolTest, main, mamo


class GenerateRetrievals(ToolTest):
    def files(self, folder):
        found = {}
        for name in sorted(os.listdir(self.path(folder))):
            with open(self.path(folder + "/" + name), encoding="utf-8") as file:
                found[name] = file.read()
        return found

    def test_a_file_does_not_depend_on_the_count(self):
        for kind, more in (("shelf", ("--movable", 4, "--immovable", 2)), ("refrigerator", ())):
            with self.subTest(kind):
                for count in (1, 2):
                    run = mamo("generate", kind, *more, "--count", count, "--out", self.path(f"{kind}{count}"))
                    self.assertEqual(run.returncode, 0, run.stderr)
                    self.assertIn(f"{count} problems in", run.stdout)
                one, two = self.files(f"{kind}1"), self.files(f"{kind}2")
                self.assertEqual(len(two), 2)
                self.assertEqual({name: two[name] for name in one}, one)
                for text in two.values():
                    self.assertTrue(text.rstrip().endswith("end: true"))
                    self.assertIn("profile: full", text)

    def test_a_difficulty_that_is_asked_for_is_what_comes(self):
        run = mamo("generate", "shelf", "--movable", 5, "--difficulty", "medium", "--count", 2, "--out", self.path("m"))
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("0 easy, 2 medium, 0 hard", run.stdout)
        for text in self.files("m").values():
            self.assertIn("difficulty: medium", text)
            self.assertIn("movables_in_the_way: 2", text)

    def test_wrong_use_is_refused(self):
        self.assert_refused(mamo("generate", "shelf", "--difficulty", "none", "--out", self.path("x")), 64, "difficulty")
        self.assert_refused(mamo("generate", "shelf", "--movable", 1, "--difficulty", "hard", "--out", self.path("x")), 64,
                            "1 movable")
        self.assert_refused(mamo("generate", "shelf", "--movable", 100, "--out", self.path("x")), 64, "at most")
        self.assertFalse(os.path.exists(self.path("x")))


if __name__ == "__main__":
    main()
