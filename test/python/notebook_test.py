#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""How objects show themselves in a notebook: complete HTML, pictures that any browser reads, numbers that are those of the object."""
import base64
import re
import unittest
import warnings
import xml.etree.ElementTree as ElementTree

from fixture import ARM, FIT, PENDULUM, SWING, case, recorded

import mechanism_codesign as codesign


def pictures(html):
    """The captions and the trees of the images; their XML is complete."""
    found = re.findall(r'<img alt="([^"]*)"[^>]*src="data:image/svg\+xml;base64,([^"]*)"', html)
    return {caption: ElementTree.fromstring(base64.b64decode(data)) for caption, data in found}


def cells(html):
    return re.findall(r"<td[^>]*>([^<]*)</td>", html)


class Notebook(unittest.TestCase):
    def test_a_problem_lists_its_parameters(self):
        html = codesign.Problem(PENDULUM, SWING)._repr_html_()
        self.assertEqual(cells(html)[:6], ["length", "0.5", "0.3", "0.8", "m", "tuned"])

    def test_a_problem_says_what_it_computes(self):
        postures = "positions: {pivot: [0.0, 0.5, 1.0]}\n"
        runs, uncertain = "runs: {near: {initial_state: {pivot: {position: 0.5}}}, far: {}}\n", "uncertain: {length: {normal: [0.5, 0.01]}}\nrobust: {samples: 8}\n"
        untuned = SWING.replace("parameters: {length: {}}\n", "")
        for study, words in ((SWING, "2 s"), (postures, "3 postures"), ("positions: {pivot: [0.5]}\n", "1 posture"), (SWING + runs, "2 runs of 2 s"),
                             (SWING + 'until: "${pivot/velocity > 0}"\n', "at most 2 s"), (None, "no study"),
                             (untuned + uncertain, "2 s, 8 samples"), (untuned + runs + uncertain, "2 runs of 2 s, 8 samples of each")):
            problem = codesign.Problem(PENDULUM) if study is None else codesign.Problem(PENDULUM, study)
            self.assertIn(f"</b>, {words}</p>", problem._repr_html_())
            self.assertIn(f": {words}, ", repr(problem))

    def test_a_run_has_ranges_curves_and_the_mechanism(self):
        run = codesign.Problem(PENDULUM, SWING).simulate(length=0.4)
        html = run._repr_html_()
        self.assertIn(f"objective {run.objective:.10g}", html)
        position = cells(html)[cells(html).index("pivot/position"):][:5]
        y = run["pivot/position"]
        self.assertEqual(position, ["pivot/position", f"{y.min():.6g}", f"{y.max():.6g}", f"{y[-1]:.6g}", "rad"])
        found = pictures(html)
        self.assertIn("pivot/position", found)
        mechanism = found["at the start; faint: later"]
        self.assertGreater(len(mechanism.findall(".//{http://www.w3.org/2000/svg}polygon")), 1)
        for picture in found.values():
            self.assertEqual(picture.tag, "{http://www.w3.org/2000/svg}svg")
            self.assertIn("--after", picture.find("{http://www.w3.org/2000/svg}style").text)

    def test_a_run_of_postures_speaks_of_postures(self):
        html = codesign.Problem(PENDULUM, "positions: {pivot: [0.0, 0.5, 1.0]}\n").simulate()._repr_html_()
        self.assertIn("in the first posture; faint: in others", pictures(html))
        self.assertIn("<th style=\"text-align:right\">in the last posture</th>", html)
        texts = {text.text for text in pictures(html)["pivot/position"].iter("{http://www.w3.org/2000/svg}text")}
        self.assertIn("posture", texts)
        self.assertNotIn("time [s]", texts)

    def test_a_result_has_both_designs_and_the_search(self):
        result = codesign.Problem(PENDULUM, SWING).optimize()
        html = result._repr_html_()
        self.assertEqual(cells(html)[:6], ["length", "0.5", f"{result.rho[0]:.6g}", "0.3", "0.8", "m"])
        self.assertEqual(set(pictures(html)), {"before", "after", "best objective by evaluation"})
        failed = codesign.Problem(PENDULUM, SWING + "solver: {maximum_steps: 20}\n").optimize()
        self.assertIn("too_many_steps", failed._repr_html_())

    def test_a_fit_has_its_numbers(self):
        fit = codesign.Problem(ARM, FIT).identify(*recorded())
        self.assertEqual(cells(fit._repr_html_())[:3], ["mass", "1", f'{fit.numbers["mass"].value:.6g}'])
        self.assertEqual(len(pictures(fit._repr_html_())), 1)

    def test_a_mechanism_with_loops_and_names_from_files(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", codesign.Warning)
            problem = codesign.Problem(*case("slider_crank_haug"))
        self.assertIn("at the start; faint: later", pictures(problem.simulate(samples=11)._repr_html_()))
        odd = codesign.Problem(PENDULUM.replace('"pivot"', '"a&amp;b"'), SWING.replace("pivot", "a&b"))
        html = odd.simulate()._repr_html_()
        self.assertIn("<td style=\"text-align:left\">a&amp;b/position</td>", html)
        self.assertNotIn("a&b", html)
        self.assertIn("a&amp;b/position", pictures(html))


if __name__ == "__main__":
    unittest.main()
