#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The parts of the page of `codesign report`: numbers, charts, rotations."""
import math
import os
import re
import sys
import types
import unittest

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
from codesign_report import asked, charts, drawing, geometry, numbers, signals  # noqa: E402


class Parts(unittest.TestCase):
    def test_numbers(self):
        self.assertEqual(numbers.short(-0.223582684817), "\u22120.223583")
        self.assertEqual(numbers.short(1.25e-8), "1.25e\u22128")
        self.assertEqual(numbers.short(None), "\u2013")
        self.assertIn('value="0.1"', numbers.number(0.1))
        self.assertEqual(numbers.ticks(0.0, 2.0), [0.0, 0.5, 1.0, 1.5, 2.0])
        self.assertLessEqual(len(numbers.ticks(-1.57e-5, 0.0)), 7)

    def test_rows_and_group_of_contacts(self):
        def of(name, smallest, largest):
            return {"name": name, "smallest": smallest, "largest": largest}

        sides = {"initial": [of("pin/gap", -1e-5, 1e-4), of("pin/normal_force", 0.0, 30.0), of("hinge/normal_force", 0.0, 5.0)], "tuned": [of("pin/gap", -2e-5, 1e-4), of("pin/normal_force", 0.0, 60.0)]}
        job = types.SimpleNamespace(details={side: {"signals": rows} for side, rows in sides.items()}, runs={})
        self.assertEqual(signals.contacts(job), [("pin", -1e-5, -2e-5, 30.0, 60.0)])
        groups = {name: signals.GROUPS[signals.group_of(name, (), (), {"pin"})][0] for name in ("pin/normal_force", "pin/gap", "hinge/normal_force", "hinge/position", "mechanism/friction_power")}
        self.assertEqual(list(groups.values()), ["Contacts", "Contacts", "Friction", "Motion", "Powers of the mechanism"])

    def test_ticks_of_a_small_range_differ(self):
        for low, high in ((58.0001, 58.0004), (1e-12, 1.0), (-2e-5, 1e-5), (1e6, 1e6 + 3), (0.1, 0.1000000001)):
            axis = charts.Axis([low, high], 0.0, 300.0)
            self.assertEqual(len(set(axis.labels)), len(axis.ticks), axis.labels)
            self.assertLessEqual(max(map(len, axis.labels)), 10, axis.labels)
        self.assertEqual(numbers.tick_labels([58.0001, 58.0002, 58.0003]), (["58.0001", "58.0002", "58.0003"], ""))
        self.assertEqual(numbers.tick_labels([0.1, 0.1 + 1e-9]), (["0", "+1e\u22129"], "0.1"))
        self.assertEqual(charts.Axis([1, 2, 3], 0.0, 300.0).labels, ["1", "2", "3"], "there is no trial point 1.5")

    def test_labels_neither_touch_nor_leave_the_picture(self):
        svg = charts.line_chart("t", [charts.Series("a", "tuned", [0.0, 1.23456e-5], [-1.23456e-7, -1.2345e-7])], "time [s]", "[N]")
        at = [(float(x), len(text)) for x, text in re.findall(r'class="tick" x="([0-9.]+)" y="190" text-anchor="middle">([^<]*)<', svg)]
        self.assertGreater(len(at), 1)
        for (x, length), (following, other) in zip(at, at[1:]):
            self.assertGreater(following - x, 0.5 * charts.LETTER * (length + other) - 1e-9)
        self.assertLessEqual(at[-1][0] + 0.5 * charts.LETTER * at[-1][1], charts.WIDTH)
        log = charts.line_chart("t", [charts.Series("a", "tuned", [1, 2], [1.9, 75.5])], "trial point", "objective", log=True)
        heights = [float(y) for y in re.findall(r'class="tick" x="[0-9.]+" y="([0-9.]+)" text-anchor="end">', log)]
        self.assertGreater(len(heights), 1)
        self.assertTrue(all(a - b >= 13.9 for a, b in zip(heights, heights[1:])), heights)
        for x, text in re.findall(r'class="tick" x="([0-9.]+)" y="[0-9.]+" text-anchor="end">([^<]*)<', svg):
            self.assertGreater(float(x) - charts.LETTER * len(text), 18.0, "beside the name of the axis")

    def test_intervals_are_on_one_scale_relative_to_their_values(self):
        intervals = [(0.98, 1.02, 1.0), (190.0, 210.0, 200.0), (-4.2e-5, -3.8e-5, -4e-5)]
        self.assertAlmostEqual(charts.interval_scale(intervals), 0.05)

        def bar(low, high, value, scale, start=None):
            svg = charts.interval_chart("t", low, high, value, start, scale)
            (ends,) = re.findall(r'class="interval" d="M([0-9.]+) 10H([0-9.]+)"', svg)
            return float(ends[1]) - float(ends[0]), svg

        self.assertEqual([round(bar(*each, 0.1)[0], 6) for each in intervals], [28.0, 70.0, 70.0])
        self.assertEqual([bar(*each, 0.1)[1].count("beyond") for each in ((0.95, 1.2, 1.0), (0.5, 1.5, 1.0), (-1.0, 1.0, 0.0))], [1, 2, 2])
        self.assertEqual([bar(0.9, 1.1, 1.0, 0.1, start)[1].count("initial") for start in (1.05, 3.0)], [1, 0])
        self.assertEqual(charts.interval_scale([(None, None, 2.0), (0.0, 9.0, 1.0)]), 1.0)
        self.assertEqual(charts.interval_scale([]), 1.0)

    def test_all_terms_of_an_objective_and_all_bounds_are_told(self):
        study = {"positions": {"crank": [0, 1]}, "final": [{"signal": "a", "between": [1, 2]}],
                 "objective": {"sum": [{"signal": "s", "reference": [1, 2.5]}, {"signal": "e", "reference": "${x}"}], "terminal": [{"signal": "t"}],
                               "stroke": [{"signal": "d", "weight": -1, "after": 2, "before": 3}]},
                 "constraints": [{"stroke": "o", "at_least": 0.5}, {"dwell": "p", "band": [0, 1], "at_least": 0.3}, {"expression": "${a+b}", "at_most": 1}]}
        self.assertEqual([(term.signal, term.kind) for term in asked.objective_terms(study)],
                         [("s", "sum over the postures of " + asked.SQUARE), ("e", "sum over the postures of " + asked.SQUARE),
                          ("t", "in the last posture, " + asked.SQUARE),
                          ("d", "weight \u00b7 (largest minus smallest signal \u2212 reference), after 2, before 3")])
        self.assertEqual(asked.bounds(study), [("a in the last posture", "between [1, 2]"), ("stroke of o", "at least 0.5"),
                                               ("dwell of p, band [0, 1]", "at least 0.3"), ("${a+b}", "at most 1")])
        self.assertEqual(asked.numbers_asked(study), {"s": [1.0, 2.5]})

    def test_losses_loops_and_poles_are_told(self):
        study = {"objective": {"integral": [{"signal": "e", "loss": "huber"}], "loop": [{"loop": "servo", "measure": "bandwidth", "weight": -1}],
                               "poles": [{"measure": "growth"}]},
                 "constraints": [{"loop": "servo", "measure": "phase_margin", "at_least": 0.9}, {"poles": "damping_ratio", "at_least": 0.5}]}
        self.assertEqual([(term.signal, term.weight) for term in asked.objective_terms(study)],
                         [("e", "1"), ("loop servo, bandwidth", "-1"), ("poles, growth", "1")])
        self.assertEqual(asked.objective_terms(study)[0].kind, "integral over the run of weight \u00b7 huber of (signal \u2212 reference)")
        self.assertEqual(asked.bounds(study), [("loop servo, phase_margin", "at least 0.9"), ("poles, damping_ratio", "at least 0.5")])

    def test_each_kind_of_term_is_told(self):
        for key in ("integral", "sum", "terminal", *asked.MEASURES):
            self.assertEqual(len(asked.objective_terms({"objective": {key: [{"signal": "s"}]}})), 1, key)
            self.assertEqual(signals.used_signals({"constraints": [{key: "s"}]}), {"s"} if key in asked.MEASURES else set())

    def test_names_of_correlations_are_whole(self):
        name = "data[0].start.crank_joint"
        svg = charts.matrix_chart("t", [name, "b"], [[1.0, 0.5], [0.5, 1.0]])
        x = float(re.search(r'class="tick" x="([0-9.]+)"[^>]*>' + re.escape(name) + "<", svg)[1])
        self.assertGreater(x, 6.5 * len(name))

    def test_a_thinned_curve_keeps_its_peaks(self):
        ys = [0.0] * 5000
        ys[1234], ys[4001] = 7.0, -3.0
        points = charts.thin(list(range(5000)), ys, 200)
        self.assertLessEqual(len(points), 210)
        self.assertIn((1234, 7.0), points)
        self.assertIn((4001, -3.0), points)
        self.assertEqual([points[0][0], points[-1][0]], [0, 4999])

    def test_rotations(self):
        quarter = geometry.from_rpy(0.0, 0.0, math.pi / 2)
        self.assertEqual([round(x, 12) for x in geometry.apply(quarter, (1.0, 0.0, 0.0), (1.0, 0.0, 0.0))], [1.0, 1.0, 0.0])
        same = geometry.from_quaternion(math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))
        self.assertLess(max(abs(a - b) for r, s in zip(quarter, same) for a, b in zip(r, s)), 1e-12)

    def test_a_plane_mechanism_is_seen_from_its_side(self):
        right, up, towards = drawing.view_of([(x, 0.0, z) for x in (0.0, 1.0) for z in (0.0, 2.0)])
        self.assertEqual([tuple(map(abs, v)) for v in (right, up, towards)], [(1, 0, 0), (0, 0, 1), (0, 1, 0)])

    def test_rods_without_mass_and_springs_are_drawn(self):
        ends = '<predecessor link="ground"><origin xyz="1 0 0"/></predecessor><successor link="arm"><origin xyz="0.5 0 1"/></successor>'
        urdf = f"""<robot name="r" xmlns:codesign="urn:mechanism_codesign"><link name="ground"/><link name="arm"/>
            <joint name="j" type="continuous"><parent link="ground"/><child link="arm"/></joint>
            <loop name="rod" type="codesign:distance">{ends}</loop> <loop name="pin" type="codesign:spherical">{ends}</loop>
            <codesign:spring_damper name="spring">{ends}</codesign:spring_damper></robot>"""
        robot = geometry.Robot(urdf)
        self.assertEqual(robot.rods, 2 * [[("ground", (1.0, 0.0, 0.0)), ("arm", (0.5, 0.0, 1.0))]])
        pose = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]
        scene = drawing.Scene([(robot, {"times": [0.0], "links": {"ground": [pose], "arm": [pose]}})])
        (ax, ay), (bx, by) = scene.place((1.0, 0.0, 0.0)), scene.place((0.5, 0.0, 1.0))
        self.assertEqual(scene.picture(0, "t").count(f'<path class="body stick" d="M{ax} {ay}L{bx} {by}"/>'), 2)

    def test_links_without_shapes_have_the_sticks_that_rviz_shows(self):
        """The same model and numbers as in the test of the viewers' sticks."""
        with open(os.path.join(ROOT, "test/reading/urdf/stick_figure_test.cc"), encoding="utf-8") as file:
            bare = re.search(r'kBare = R"\((.*?)\)";', file.read(), re.DOTALL)[1]
        solids = geometry.Robot(bare).solids
        box = {name: [[(min(p[k] for p in s.points), max(p[k] for p in s.points)) for k in range(3)] for s in solids[name]] for name in solids}
        self.assertEqual([[s.kind for s in solids[name]] for name in ("ground", "cart", "rod", "bob", "tool")],
                         [[], ["box"], ["cylinder", "sphere"], ["sphere", "cylinder", "sphere"], []])
        self.assertEqual(box["cart"][0], 3 * [(-0.05, 0.05)])
        for found, known in zip(box["rod"][0], ((0.0, 1.0), (-0.02, 0.02), (-0.02, 0.02))):
            self.assertLess(max(abs(a - b) for a, b in zip(found, known)), 1e-12)
        self.assertLess(max(abs(a - b) for a, b in zip(box["bob"][2][2], (-0.56, -0.44))), 1e-12, "a sphere at the centre of mass")
        ends = '<predecessor link="ground"><origin xyz="3 0 0"/></predecessor><successor link="bob"><origin xyz="0 2 0"/></successor>'
        closed = geometry.Robot(bare.replace("</robot>", f'<loop name="pin" type="revolute">{ends}</loop></robot>')).solids
        self.assertEqual([s.kind for name in ("ground", "bob") for s in closed[name]], ["cylinder", "cylinder", "sphere"])
        mesh = '<link name="rod"><visual><geometry><mesh filename="package://a/b.stl"/></geometry></visual>'
        self.assertEqual([s.kind for s in geometry.Robot(bare.replace('<link name="rod">', mesh)).solids["rod"]], ["cylinder", "sphere"])

    def test_a_pendulum_without_shapes_is_seen_from_its_side_with_a_true_scale(self):
        robot = geometry.Robot("""<robot name="r"><link name="ground"/><link name="bob"><inertial><origin xyz="0 0 -1"/><mass value="1"/></inertial></link>
            <joint name="j" type="continuous"><parent link="ground"/><child link="bob"/><axis xyz="0 1 0"/></joint></robot>""")
        poses = [[0.0, 0.0, 0.0, math.cos(0.5 * a), 0.0, math.sin(0.5 * a), 0.0] for a in (0.3, -0.3)]
        scene = drawing.Scene([(robot, {"times": [0.0, 1.0], "links": {"ground": poses, "bob": poses}})])
        self.assertEqual(tuple(map(abs, scene.towards)), (0, 1, 0))
        picture = scene.picture(0, "t")
        self.assertEqual([picture.count(f'class="{kind} solid"') for kind in ("body", "ghost")], [3, 3])
        self.assertIn(">500 mm<", picture)
        bar = re.search(r'<path class="frame" d="M14 [0-9]+V[0-9]+H([0-9.]+)', picture)
        self.assertAlmostEqual(float(bar[1]) - 14.0, 0.5 * scene.scale, delta=0.1)
        self.assertGreater(scene.scale, 150.0, "it fills the picture")

    def test_the_scale_of_a_small_mechanism_has_a_unit_that_fits(self):
        for size, text in ((2.0, ">1 m<"), (2e-6, ">1 \u00b5m<"), (2e-9, ">1 nm<")):
            robot = geometry.Robot(f"""<robot name="r"><link name="ground"/><link name="a"><visual><geometry><box size="{size} {size} {size}"/></geometry></visual></link>
                <joint name="j" type="continuous"><parent link="ground"/><child link="a"/></joint></robot>""")
            pose = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]
            self.assertIn(text, drawing.Scene([(robot, {"times": [0.0], "links": {"a": [pose]}})]).picture(0, "t"))

    def test_a_fixed_body_is_whole_unless_the_mechanism_became_small(self):
        def scene(height):
            box = f'<visual><origin xyz="0 0 {-0.5 * height}"/><geometry><box size="0.1 0.1 {height}"/></geometry></visual>'
            arm = '<visual><origin xyz="0.5 0 0.5"/><geometry><box size="1 0.02 1"/></geometry></visual>'
            robot = geometry.Robot(f"""<robot name="r"><link name="ground">{box}</link><link name="arm">{arm}</link>
                <joint name="j" type="continuous"><parent link="ground"/><child link="arm"/></joint></robot>""")
            pose = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]
            return drawing.Scene([(robot, {"times": [0.0], "links": {"ground": [pose], "arm": [pose]}})])

        alone, near, far = scene(0.001), scene(0.5), scene(5.0)
        self.assertLess(near.place((0.0, 0.0, -0.5))[1], near.height - 24)
        self.assertLess(near.scale, alone.scale)
        self.assertAlmostEqual(far.scale, alone.scale, delta=0.01 * alone.scale)

    def test_a_picture_of_its_own_has_the_style_that_it_uses(self):
        chart = charts.standalone(charts.line_chart("t", [charts.Series("a", "tuned", [0.0, 1.0], [2.0, 3.0])], "time [s]", "[N]"))
        self.assertTrue(chart.startswith(f'<svg xmlns="http://www.w3.org/2000/svg" width="{charts.WIDTH}" height="{charts.HEIGHT}" '))
        for rule, there in (("svg .line.tuned {", True), ("svg text {", True), ("--after:", True), ("svg .solid {", False), ("svg {", False), (".hue0", False)):
            self.assertEqual(rule in chart, there, rule)
        self.assertIn("svg { background: var(--paper); }", charts.standalone(charts.svg("", "t"), background=True))

    def test_the_outline_of_a_square(self):
        self.assertEqual(len(drawing.hull([(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0.5)])), 4)


if __name__ == "__main__":
    unittest.main()
