#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The page of `codesign report` for a trade-off: curve, designs, points that are none. Usage: tradeoff_report_test.py"""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from codesign_report import efforts, linear, page, tradeoff  # noqa: E402


def point(kind, objectives=None, parameters=None, anchor=False, status="success"):
    made = {"kind": kind, "anchor": anchor, "place": [0.5, 0.5], "status": {"code": status, "message": "" if status == "success" else "no point <met> it"},
            "termination": "success", "stationarity": 1e-7, "iterations": 1, "evaluations": 4, "failed_evaluations": 0, "warnings": []}
    return {**made, "objectives": objectives, "parameters": parameters} if objectives else made


def regulators(count=9):
    """Of the double integrator: error = (k1 + k2^2)/(2 k1 k2), effort = k1^2/(2 k2), k2^2 = 2 k1."""
    for k in range(count):
        k1 = 5.0 * 0.04 ** (k / (count - 1))
        k2 = math.sqrt(2.0 * k1)
        yield point("on_curve", {"error": (k1 + k2 * k2) / (2.0 * k1 * k2), "effort": k1 * k1 / (2.0 * k2)}, {"k1": k1, "k2": k2}, k in (0, count - 1))


def result(points, names=("error", "effort")):
    return {"version": "1.0.0", "objectives": list(names), "tuned": ["k1", "k2"], "points": points, "smallest_gap": 0.1, "largest_gap": 0.2,
            "evaluations": 36, "failed_evaluations": 1, "warnings": []}


def rendered(of):
    return page.render(tradeoff.Tradeoff("/somewhere/curve.json", of))


def circles(html, title):
    """[(class, x, y, title)] of the dots of the picture with this title."""
    for svg in re.findall(r"<svg.*?</svg>", html, re.DOTALL):
        root = ElementTree.fromstring(svg)
        if root.get("aria-label") == title:
            return [(dot.get("class"), float(dot.get("cx")), float(dot.get("cy")), "".join(dot.itertext())) for dot in root.iter("circle")]
    raise AssertionError(f"no picture {title}")


class Page(unittest.TestCase):
    def test_the_curve_falls_from_the_left_to_the_right(self):
        dots = circles(rendered(result(list(regulators()))), "effort over error")
        self.assertEqual(len(dots), 9)
        for (_, x, y, _), (_, next_x, next_y, _) in zip(dots, dots[1:]):
            self.assertLess(x, next_x)
            self.assertLess(y, next_y, "downwards in the picture")

    def test_points_that_are_none_are_told_and_not_joined(self):
        points = list(regulators())
        points[3]["kind"], points[5]["kind"] = "dominated", "stopped_early"
        html = rendered(result([*points, point("failed", status="infeasible")]))
        self.assertIn("dominated, 1:", html)
        self.assertIn("failed, 1:", html)
        self.assertIn("no point &lt;met&gt; it", html)
        curve = re.search(r'<path class="tuned line" d="([^"]*)"', html).group(1)
        self.assertEqual(len(re.findall("L", curve)), 7, "between 8 points")
        kinds = [dot[0] for dot in circles(html, "effort over error")]
        self.assertEqual(kinds[3], "initial dot")
        self.assertEqual(kinds.count("tuned dot"), 7)

    def test_numbers_are_whole(self):
        points = list(regulators())
        html = rendered(result(points))
        for shown in (points[2]["objectives"]["error"], points[7]["parameters"]["k2"]):
            self.assertIn(f'value="{shown!r}"', html)

    def test_three_objectives_have_a_picture_per_pair(self):
        points = [point("on_curve", {"a": i, "b": j, "c": 4 - i - j}, {"k1": i, "k2": j}) for i in range(5) for j in range(5 - i)]
        html = rendered(result(points, "abc"))
        for title in ("b over a", "c over a", "c over b"):
            self.assertEqual(len(circles(html, title)), 15)

    def test_a_job_without_points_has_a_page(self):
        html = rendered({**result([]), "smallest_gap": None, "largest_gap": None, "error": {"code": "cancelled", "message": "cancelled; nothing"}})
        self.assertIn("cancelled; nothing", html)

    def test_the_file_is_known_by_its_keys(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "curve.json")
            pathlib.Path(path).write_text(json.dumps(result(list(regulators()))))
            self.assertIsInstance(page.find(path), tradeoff.Tradeoff)
            done = subprocess.run([ROOT / "scripts/report", path, "-o", path], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertIn("would replace the trade-off", done.stderr)
        self.assertFalse(tradeoff.is_one({"joints": {}, "series": {}}))
        self.assertFalse(linear.is_one(result([])))
        with self.assertRaises(page.ReportError):
            efforts.Efforts("x.json", result([]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
