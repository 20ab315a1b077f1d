"""`mamo train`: parameters that `--config` takes, the same whatever the number of jobs."""
import os
import unittest
import xml.dom.minidom

from support import SOURCE, ToolTest, main, mamo

SMALL = ("--scenes", 4, "--vertices", 12, "--collect-expansions", 40, "--collect-simulations", 300, "--try-expansions", 20,
         "--try-simulations", 100)


class Train(ToolTest):
    def test_parameters_come_out_and_go_into_a_plan(self):
        texts = []
        for jobs in (1, 3):
            out = self.path(f"p{jobs}.yaml")
            run = mamo("train", "--out", out, "--jobs", jobs, *SMALL, timeout=600)
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(out, encoding="utf-8") as file:
                texts.append(file.read())
            xml.dom.minidom.parse(out + ".svg")
        self.assertEqual(texts[0], texts[1])
        shelf = os.path.join(SOURCE, "bench/data/problems/shelf_1.yaml")
        plan = mamo("plan", shelf, "--planner", "em4m", "--config", self.path("p1.yaml"))
        self.assertEqual(plan.returncode, 0, plan.stderr + plan.stdout)

    def test_wrong_use_is_refused(self):
        self.assert_refused(mamo("train"), 64, "--out")
        self.assert_refused(mamo("train", "--out", self.path("no/p.yaml")), 73, "no/p.yaml")
        self.assert_refused(mamo("train", "--out", self.path("p.yaml"), "--scenes", 0), 64, "--scenes")


if __name__ == "__main__":
    main()
