#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Each machine of the gallery finds its known optimum, and its page says so. Usage: gallery_test.py CODESIGN"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import gallery_optima

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
GALLERY = os.path.join(ROOT, "gallery")
MACHINES = sorted(name for name in os.listdir(GALLERY) if os.path.isdir(os.path.join(GALLERY, name)))


def text_of(*path):
    with open(os.path.join(GALLERY, *path), encoding="utf-8") as file:
        return file.read()


def misses(known, found):
    """The numbers that are not within their tolerance."""
    return [f"{name}: {found[name]} in place of {value}" for name, (value, tolerance) in known.items()
            if abs(found[name] - value) > tolerance * abs(value)]


def shown(text, value):
    """Whether the text is the value, rounded to five digits; of numbers that are zero but for rounding, 0."""
    return abs(float(text) - value) <= 1e-4 * abs(value) + 1e-9


class Gallery(unittest.TestCase):
    def optimize(self, name):
        files = [os.path.join(GALLERY, name, file) for file in ("model.urdf", "study.yaml")]
        done = subprocess.run([sys.argv[1], "optimize", *files, "--json", "--quiet"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_each_machine_finds_its_optimum(self):
        for name in MACHINES:
            with self.subTest(machine=name):
                known, result = getattr(gallery_optima, name)(), self.optimize(name)
                start, end = ({**result[f"{side}parameters"], "objective": result[f"{side}objective"]} for side in ("initial_", ""))
                self.assertEqual(misses(known, end), [])
                self.assertNotEqual(misses(known, start), [], "the study starts at the answer")
                self.assertEqual(result["warnings"], [])
                tuned = {key for key, value in result["parameters"].items() if value != result["initial_parameters"][key]}
                self.assertTrue("objective" in known or tuned == set(known), f"{tuned} are tuned, {set(known)} are known")
                rows = re.findall(r"^\| `(\w+)` \| (\S+) \| (\S+) \| (\S+) \|$", text_of(name, "README.md"), re.MULTILINE)
                self.assertEqual([row[0] for row in rows], list(known))
                for key, *numbers in rows:
                    for number, value in zip(numbers, (start[key], end[key], known[key][0])):
                        self.assertTrue(shown(number, value), f"{key}: the page says {number}, not {value}")

    def test_each_machine_has_its_page(self):
        page = text_of("README.md")
        by_task, by_mechanism = page[:page.index("## By mechanism")], page[page.index("## By mechanism"):]
        for name in MACHINES:
            with self.subTest(machine=name):
                own = text_of(name, "README.md")
                self.assertTrue(own.startswith("# "))
                for part in ("(picture.svg)", "**Question.**", "**Answer.**", "**To change.**", f"--from {name}`"):
                    self.assertIn(part, own)
                title = own[2:own.index("\n")]
                self.assertIn(f'<a href="{name}/README.md"><img src="{name}/picture.svg"', by_task)
                self.assertIn(f"<br>{title}</a>", by_task)
                self.assertIn(f"({name}/README.md)", by_mechanism)
                self.assertIn("</svg>", text_of(name, "picture.svg"))
        self.assertEqual(set(re.findall(r"\(?(\w+)/README\.md", page)), set(MACHINES))

    def test_the_folder_stays_small(self):
        sizes = [os.path.getsize(os.path.join(place, file)) for place, _, files in os.walk(GALLERY) for file in files]
        self.assertLess(sum(sizes), 3e6)

    def test_a_project_of_ones_own_is_a_copy(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in MACHINES:
                subprocess.run([sys.argv[1], "new", name, "--from", name], cwd=folder, capture_output=True, check=True)
                for file in ("model.urdf", "study.yaml"):
                    with open(os.path.join(folder, name, file), encoding="utf-8") as copy:
                        self.assertEqual(copy.read(), text_of(name, file))


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main(argv=sys.argv[:1])
