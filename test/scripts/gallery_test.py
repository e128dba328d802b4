#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Each machine of the gallery finds its known optimum, and its page and picture say so. Usage: gallery_test.py CODESIGN"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader

import gallery_optima

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
GALLERY = os.path.join(ROOT, "gallery")
MACHINES = sorted(name for name in os.listdir(GALLERY) if os.path.isdir(os.path.join(GALLERY, name)))


def load(script):
    loader = SourceFileLoader(os.path.basename(script), os.path.join(ROOT, script))
    module = module_from_spec(spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


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


def is_rounded(text, value):
    """Whether the text is the value, rounded to the last digit that is not a zero before the point."""
    places = len(text.partition(".")[2]) if "." in text else len(text.rstrip("0")) - len(text)
    return abs(float(text) - value) <= 0.5001 * 10.0 ** -places


def shapes(picture):
    """What a picture shows, without the order: kind, class, text, and numbers; of an outline the box around it."""
    found = []
    for part in ElementTree.fromstring(picture).iter():
        kind = part.tag.partition("}")[2]
        if kind not in ("svg", "title", "style", "g"):
            at = [float(x) for key in ("cx", "cy", "x", "y", "d", "points") for x in re.findall(r"-?[0-9.]+", part.get(key, ""))]
            box = [f(at[k::2]) for f in (min, max) for k in (0, 1)] if kind == "polygon" else at
            found.append((kind, part.get("class"), part.text, box))
    return found


def differences(first, second):
    """Shapes of the first picture that the second one has not, within a third of a pixel."""
    rest, missing = list(second), []
    for shape in first:
        same = next((s for s in rest if s[:3] == shape[:3] and len(s[3]) == len(shape[3]) and all(abs(a - b) < 0.34 for a, b in zip(s[3], shape[3]))), None)
        if same:
            rest.remove(same)
        else:
            missing.append(shape)
    return missing


class Gallery(unittest.TestCase):
    def run_program(self, command, *arguments):
        done = subprocess.run([sys.argv[1], command, *arguments], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def optimize(self, model, study, *options):
        return json.loads(self.run_program("optimize", model, study, "--json", "--quiet", *options))

    def changed(self, name, *changes):
        """The result of a machine's study with other texts in it."""
        study = text_of(name, "study.yaml")
        for old, new in changes:
            self.assertIn(old, study)
            study = study.replace(old, new)
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "study.yaml"), "w", encoding="utf-8") as file:
                file.write(study)
            return self.optimize(os.path.join(GALLERY, name, "model.urdf"), file.name)

    def compare_picture(self, name, folder):
        drawn, kept = shapes(load("tools/gallery").picture(folder)), shapes(text_of(name, "picture.svg"))
        self.assertGreater(len(kept), 3)
        self.assertEqual(differences(drawn, kept) + differences(kept, drawn), [], "tools/gallery draws it again")

    def test_each_machine_finds_its_optimum(self):
        for name in MACHINES:
            with self.subTest(machine=name), tempfile.TemporaryDirectory() as folder:
                known = getattr(gallery_optima, name)()
                result = self.optimize(*(os.path.join(GALLERY, name, file) for file in ("model.urdf", "study.yaml")), "--output", folder)
                self.compare_picture(name, folder)
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

    def test_further_numbers_of_the_pages(self):
        for name, numbers in gallery_optima.FURTHER.items():
            page = text_of(name, "README.md")
            for before, value in numbers().items():
                with self.subTest(machine=name, text=before):
                    self.assertIn(before, page)
                    (text,) = re.findall(re.escape(before) + r"([0-9]+(?:\.[0-9]+)?)", page)
                    self.assertTrue(is_rounded(text, value), f"{text} in place of {value}")

    def test_the_curve_of_the_goods_lift(self):
        study, (longest, _) = text_of("goods_lift", "tradeoff.yaml"), gallery_optima.goods_lift()["T"]
        term, measure = "terminal: [{signal: end_time, loss: absolute}]", "maximum: [{signal: end_time}]"
        self.assertIn(term, study)
        for text in (study, study.replace(term, measure)):  # two ways to say it
            with self.subTest(text=text), tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
                file.write(text)
                file.flush()
                curve = json.loads(self.run_program("tradeoff", os.path.join(GALLERY, "goods_lift", "model.urdf"), file.name, "--json", "--quiet"))
                self.assertEqual({point["kind"] for point in curve["points"]}, {"on_curve"})
                self.assertEqual(len(curve["points"]), 11)
                for point in curve["points"]:
                    time, heat = (point["objectives"][name] for name in ("time", "heat"))
                    self.assertTrue(1.499 < time < longest * 1.001)
                    self.assertAlmostEqual(heat / gallery_optima.lift_heat(time), 1.0, 3)

    def test_a_leg_that_swings_far_needs_stiffer_springs(self):
        springs = self.changed("swinging_leg", ("0.02", "0.4"), ("0.01", "0.2"))["parameters"]
        share = re.search(r"0.4 rad: the springs must be ([0-9.]+) % and ([0-9.]+) % stiffer", text_of("swinging_leg", "README.md"))
        for text, (name, (known, _)) in zip(share.groups(), gallery_optima.swinging_leg().items()):
            self.assertTrue(is_rounded(text, 100.0 * (springs[name] / known - 1.0)), f"{name}: {text} %")

    def test_the_way_points_of_the_delta_robot(self):
        """The page's study of postures gives the motors' angles in the machine's own study."""
        (postures,) = re.findall(r"```yaml\n(.*?)```", text_of("delta_robot", "README.md"), re.DOTALL)
        motors = [f"motor_{k}" for k in (1, 2, 3)]
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as study:
            study.write(postures)
            study.flush()
            table = self.run_program("simulate", os.path.join(GALLERY, "delta_robot", "model.urdf"), study.name,
                                     "--signals", ",".join(f"{motor}/position" for motor in motors))
        rows = list(csv.DictReader(table.splitlines()))
        for motor in motors:
            (text,) = re.findall(motor + r": \{position: .*positions: \[(.*)\]", text_of("delta_robot", "study.yaml"))
            self.assertEqual([round(float(row[f"{motor}/position"]), 6) for row in rows], [float(x) for x in text.split(",")])

    def test_pictures_that_differ(self):
        kept = text_of("toggle_press", "picture.svg")
        (corner,) = re.findall(r'class="ground solid" points="([0-9.]+),', kept)
        self.assertEqual(differences(shapes(kept), shapes(kept)), [])
        moved = kept.replace(f'class="ground solid" points="{corner},', f'class="ground solid" points="{float(corner) - 1.0},')
        self.assertNotEqual(differences(shapes(kept), shapes(moved)), [])

    def test_each_machine_has_its_page(self):
        page = text_of("README.md")
        halves = page[:page.index("## By mechanism")], page[page.index("## By mechanism"):page.index("## Add one")]
        for name in MACHINES:
            with self.subTest(machine=name):
                own = text_of(name, "README.md")
                self.assertTrue(own.startswith("# "))
                for part in ("(picture.svg)", "**Question.**", "**Answer.**", "**To change.**", f"--from {name}`"):
                    self.assertIn(part, own)
                title = own[2:own.index("\n")]
                for half in halves:
                    cells = re.findall(rf'<a href="{name}/README.md"><img src="{name}/picture.svg" width="[0-9]+" alt="[^"]+"><br>(.*)</a>', half)
                    self.assertEqual(set(cells), {title})
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
