#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What README.md tells a newcomer to paste works and prints what stands there. Usage: readme_test.py CODESIGN"""
import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as readme:
    TEXT = readme.read()


def numbers(text):
    return [float(word) for word in re.findall(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w.])", text)]


class Readme(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def test_the_example_is_pasted(self):
        block, printed = re.search(r"```bash\n(.*?)```\n\n```\n(.*?)```", TEXT, re.DOTALL).groups()
        self.assertIn(". devel/setup.bash\n", block)
        lines = [line for line in block.splitlines() if line]
        self.assertLessEqual(len(lines), 30, "a model and a study in about twenty lines, and what surrounds them")
        # The script runs in the environment of this test instead of a shell in the package's folder, and in a folder of its own.
        script = block.replace(". devel/setup.bash\n", "").replace("/tmp/pendulum", self.folder)
        environment = {**os.environ, "PATH": os.path.dirname(sys.argv[1]) + os.pathsep + os.environ["PATH"]}
        done = subprocess.run(["bash", "-e", "-c", script], capture_output=True, text=True, env=environment, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(os.path.exists(os.path.join(self.folder, "job", "tuned.urdf")))
        row, objective = (re.search(pattern, done.stdout).group(0) for pattern in (r"length .*", r"objective .* -> .*"))
        for found, shown in ((row, re.search(r"length .*", printed).group(0)), (objective, re.search(r"objective .* -> .*", printed).group(0))):
            for value, expected in list(zip(numbers(found), numbers(shown)))[:4]:
                self.assertAlmostEqual(value, expected, delta=1e-6 * max(1.0, abs(expected)), msg=f"{found} instead of {shown}")
        page = subprocess.run([sys.argv[1], "report", "job", "-o", "swing.html"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(page.returncode, 0, page.stderr)
        with open(os.path.join(self.folder, "swing.html"), encoding="utf-8") as file:
            pictures = re.findall(r'<g class="mechanism">.*?</g>', file.read(), re.DOTALL)
        self.assertEqual([(picture.count('class="body solid"'), ">500 mm<" in picture) for picture in pictures], 2 * [(3, True)],
                         "the joint, the rod and the bob, before and after")
        self.check_promise()

    def check_promise(self):
        """What the text promises, and the closed form that it names."""
        with open(os.path.join(self.folder, "job", "result.json"), encoding="utf-8") as file:
            length = json.load(file)["parameters"]["length"]
        with open(os.path.join(self.folder, "job", "tuned.csv"), encoding="utf-8") as file:
            last = list(csv.DictReader(file))[-1]
        self.assertEqual(float(last["time"]), 2.0)
        self.assertLess(abs(float(last["pivot/velocity"])), 1e-6)
        self.assertGreater(float(last["pivot/position"]), 0.045, "back where it was released, but for what friction took")
        self.assertLess(float(last["pivot/position"]), 0.0499)
        (shown,) = re.findall(r"g/π² = ([0-9.]+) m", TEXT)
        self.assertEqual(f"{9.81 / math.pi ** 2:.3f}", shown)
        self.assertEqual(f"{length:.3f}", shown)
        # Of a bob with moment of inertia I: length + I / (mass * length), in a swing of 0.05 rad.
        self.assertAlmostEqual(length + 1e-4 / length, 9.81 / math.pi ** 2 / (1.0 + 0.05 ** 2 / 16.0) ** 2, delta=2e-5)

    def test_what_it_names_exists(self):
        for path in re.findall(r"\]\((?!http)([^)#]+)", TEXT) + re.findall(r"\./(tools/\w+)", TEXT):
            self.assertTrue(os.path.exists(os.path.join(ROOT, path)), path)
        with open(os.path.join(ROOT, "CONTRIBUTING.md"), encoding="utf-8") as file:
            row = next(line for line in file if line.startswith("| `scripts/` |"))
        for script in re.findall(r"`(\w+)`", row):
            self.assertTrue(os.access(os.path.join(ROOT, "scripts", script), os.X_OK), script)
        for file in re.findall(r"mechanism_codesign (\w+\.launch)", TEXT):
            self.assertTrue(os.path.exists(os.path.join(ROOT, "launch", file)), file)

    def test_the_two_commands_stand_where_tools_fresh_finds_them(self):
        self.assertEqual(re.findall(r"^\./tools/\w+", TEXT, re.MULTILINE), ["./tools/demo", "./tools/test"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
