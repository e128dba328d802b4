#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""scripts/identify_then_tune with two robots. Usage: identify_then_tune_test.py CODESIGN"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPT = os.path.join(ROOT, "scripts", "identify_then_tune")


class IdentifyThenTune(unittest.TestCase):
    def test_the_whole_way(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [SCRIPT, "--codesign", sys.argv[1], "--robots", "2", "--samples", "4", "--fresh", "16", "--output", folder]
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("| each robot its own recording, tuning and bound |", done.stdout)
            with open(os.path.join(folder, "robots.json"), encoding="utf-8") as file:
                robots = json.load(file)
            self.assertEqual(len(robots), 2)
            for k, robot in enumerate(robots):
                self.assertGreater(robot["bound"], 0.0)
                self.assertGreater(robot["objective"], 0.0)
                for name in ("mu", "viscous"):
                    self.assertLess(abs(robot["errors"][name]), 5.0, "far off its stated deviation")
                self.assertTrue(os.path.exists(os.path.join(folder, f"robot_{k}", "identified_overlay.urdf")))
            self.assertNotEqual(robots[0]["mu"], robots[1]["mu"])
            mask = os.umask(0o022)
            os.umask(mask)
            for name in ("robots.json", os.path.join("truth", "run.yaml"), os.path.join("robot_0", "recording.csv")):
                self.assertEqual(os.stat(os.path.join(folder, name)).st_mode & 0o777, 0o666 & ~mask, name)
            self.assertEqual([name for name in os.listdir(os.path.join(folder, "truth")) if name.startswith(".")], [])

    def test_says_what_failed(self):
        done = subprocess.run([SCRIPT, "--codesign", "false", "--robots", "1"], stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("codesign simulate", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
