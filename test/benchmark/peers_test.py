#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Tests of benchmark/peers: what it makes of measurements, its tables, and what it says without PyPI. No other program is needed."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "benchmark"), str(ROOT / "benchmark" / "peers")]
import codes  # noqa: E402
import race  # noqa: E402
import table  # noqa: E402
import update_tables  # noqa: E402
import worker  # noqa: E402


def points(*rows):
    return [table.Point(*row) for row in rows]


class AtErrorTest(unittest.TestCase):
    def test_lies_on_a_line_between_logarithms(self):
        found = table.at_error(points((1e-2, 1e-2, 10, 1.0), (1e-4, 1e-4, 1000, 4.0), (1e-5, 1e-5, 5000, 9.0)), 1e-3)
        self.assertAlmostEqual(found.setting, 1e-3)
        self.assertAlmostEqual(found.steps, 100.0)
        self.assertAlmostEqual(found.seconds, 2.0)

    def test_a_chance_result_at_a_loose_setting_does_not_count(self):
        chance = points((1e-2, 1e-7, 1, 1.0), (1e-3, 1e-2, 2, 2.0), (1e-4, 1e-6, 3, 3.0))
        self.assertEqual(table.bracket(chance, 1e-6)[0].seconds, 3.0)

    def test_the_loosest_setting_may_be_good_enough(self):
        self.assertEqual(table.at_error(points((1e-2, 1e-5, 7, 1.0), (1e-3, 1e-6, 8, 2.0)), 1e-3), table.Point(1e-2, 1e-5, 7, 1.0))

    def test_an_error_that_is_not_reached_has_no_point(self):
        self.assertIsNone(table.at_error(points((1e-2, 1e-2, 1, 1.0), (1e-3, 2e-3, 1, 2.0)), 1e-3))
        self.assertIsNone(table.at_error(points((1e-2, math.nan, 1, 1.0)), 1e-3))

    def test_no_line_goes_to_a_run_that_failed(self):
        self.assertEqual(table.at_error(points((1e-2, math.inf, 0, math.inf), (1e-3, 1e-4, 5, 2.0)), 1e-3).seconds, 2.0)


class DifferenceTest(unittest.TestCase):
    def test_is_the_largest_and_relative_to_large_references(self):
        self.assertAlmostEqual(table.difference([1.0, 2.5], [1.0, 2.0]), 0.25)
        self.assertAlmostEqual(table.difference([0.1, 0.2], [0.1, 0.1]), 0.1)

    def test_what_is_no_answer_is_infinitely_wrong(self):
        self.assertEqual(table.difference([1.0], [1.0, 2.0]), math.inf)
        self.assertEqual(table.difference([math.nan, 1.0], [1.0, 2.0]), math.inf)


class TablesTest(unittest.TestCase):
    def test_a_row_has_ratios_and_names_the_fastest(self):
        row = table.row_of_times({"ours": 2e-3, "a": 5e-3, "b": None}, "ours", ["a", "b"], {"b": "cannot"})
        self.assertEqual(row, ["2.00 ms", "5.00 ms, 2.50 x", "cannot", "ours"])

    def test_a_peer_that_wins_is_named(self):
        row = table.row_of_times({"ours": 2e-3, "a": 1e-3}, "ours", ["a"], {})
        self.assertEqual(row[-2:], ["1.00 ms, 0.500 x", "**a**"])

    def test_without_a_time_of_ours_there_is_no_ratio(self):
        self.assertEqual(table.row_of_times({"a": 1e-3}, "ours", ["a"], {"ours": "least error 1e-02"}), ["least error 1e-02", "1.00 ms", "**a**"])
        self.assertEqual(table.row_of_times({}, "ours", ["a"], {}), ["-", "-", "-"])

    def test_a_brief_table_has_the_ratios_at_the_smallest_error(self):
        rows = [["t", "1e-03", "1.00 ms", "2.00 ms, 2.00 x", "cannot", "ours"], ["t", "1e-06", "4.00 ms", "2.00 ms, 0.500 x", "-", "**a**"],
                ["u", "1e-06", "1.00 ms", "1234 ms, 1234 x", "9.00 ms, 9.00 x", "ours"]]
        self.assertEqual(table.brief_of_times(["task", "error", "ours", "a", "b", "fastest"], rows),
                         (["task", "error", "ours", "a", "b"], [["t", "1e-06", "4.00 ms", "**0.500**", "-"], ["u", "1e-06", "1.00 ms", "1234", "9.00"]]))

    def test_digits(self):
        self.assertEqual([table.three_digits(x) for x in (0.0, 0.012345, 12.345, 1234.5, math.inf)], ["0.00", "0.0123", "12.3", "1234", "-"])

    def test_markdown_finds_its_place(self):
        text = table.to_markdown("t", ["a", "b"], [["1", "2"]])
        self.assertEqual(text.splitlines()[1:4], ["| a | b |", "|---|---|", "| 1 | 2 |"])
        self.assertEqual(len(update_tables.TABLE.findall(text)), 1)

    def test_text_is_aligned(self):
        self.assertEqual(table.to_text("T", ["a", "b"], [["long", "2"]]), "T\na     b\nlong  2\n")


class RaceTest(unittest.TestCase):
    """A race of made-up programs, whose error is the tolerance and whose time is its inverse root, times a factor."""

    class Made:
        def __init__(self, factor):
            self.factor, self.asked = factor, []

        def ask(self, task, method, setting):
            self.asked.append((task, method, setting))
            if method == "broken":
                raise race.Failed("it does not work")
            return 10.0, self.factor * setting ** -0.5, [1.0 + setting, 0.5]

    def run_race(self, **factors):
        programs = {name: self.Made(factor) for name, factor in factors.items()}
        programs[codes.OWN].ask = lambda task, method, setting: (1.0, setting ** -0.5, [1.0 + (0.0 if method == "exact" else setting), 0.5])
        task = codes.Task("t", "a task", (1e-3, 1e-6), ("exact", 1e-12))
        made = [codes.Code(name, (), "", "", "", {"t": [("broken", codes.TOLERANCES), ("good", codes.TOLERANCES)]}, {}) for name in programs]
        made.append(codes.Code("other", (), "", "", "", {}, {"t": "no wheels"}))
        kept, codes.CODES = codes.CODES, made
        try:
            found = race.Race(task, programs, {}, 1e9)
            found.measure_again()
            return race.tables_of([found])
        finally:
            codes.CODES = kept

    def test_times_are_taken_at_the_same_error(self):
        (columns, rows), (_, settings) = self.run_race(**{codes.OWN: 1.0, "slow": 4.0})
        self.assertEqual(columns, ["task", "error", codes.OWN, "slow", "other", "fastest"])
        self.assertEqual([row[1] for row in rows], ["1e-03", "1e-06"])
        self.assertTrue(all(row[3].endswith("4.00 x") and row[4] == "no wheels" and row[5] == codes.OWN for row in rows), rows)
        self.assertIn(["t", "1e-03", "slow", "good", "1.0e-03", "10", "126491 ms"], settings)

    def test_a_faster_one_wins(self):
        (_, rows), _ = self.run_race(**{codes.OWN: 1.0, "quick": 0.5})
        self.assertEqual([row[-1] for row in rows], ["**quick**", "**quick**"])


class CodesTest(unittest.TestCase):
    def test_every_program_does_every_task_or_says_why_not(self):
        names = {task.name for task in codes.TASKS}
        for code in codes.CODES:
            self.assertEqual(set(code.methods) | set(code.cannot), names, code.name)
            self.assertFalse(set(code.methods) & set(code.cannot), code.name)

    def test_settings_go_from_loose_to_tight(self):
        for code in codes.CODES:
            for methods in code.methods.values():
                for _, settings in methods:
                    self.assertEqual(settings, sorted(settings, reverse=True))

    def test_modules_are_there(self):
        for code in codes.CODES:
            if code.module:
                self.assertTrue(any((ROOT / "benchmark/peers" / (code.module + end)).exists() for end in (".py", ".cc")), code.module)


class WorkerTest(unittest.TestCase):
    def test_answers_with_steps_time_and_values(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            (path / "c.json").write_text(json.dumps({"duration": 1.0, "joints": ["a"], "start": [0.5], "parameters": []}), encoding="utf-8")
            (path / "c.urdf").write_text('<joint name="a" type="continuous"></joint>', encoding="utf-8")

            def prepare(case, method, setting):
                self.assertIn('type="revolute"><limit', case.urdf_text("revolute"))
                return lambda: (7, [case.start[0], setting])
            words = worker.answer(types.SimpleNamespace(prepare=prepare), folder, "c\tm\t0.25\n").split()
        self.assertEqual(words[:2] + words[3:], ["ok", "7", "0.5", "0.25"])
        self.assertGreaterEqual(float(words[2]), 0.0)

    def test_a_program_that_is_missing_says_so(self):
        done = subprocess.run([sys.executable, str(ROOT / "benchmark/peers/worker.py"), "no_such_program", "."], stdout=subprocess.PIPE, text=True, check=True)
        self.assertEqual(done.stdout.split()[:2], ["no", "ModuleNotFoundError"])


class WithoutPypiTest(unittest.TestCase):
    def test_says_in_one_sentence_what_is_not_measured(self):
        self.assertEqual(table.unmeasured_sentence(["Drake", "CasADi"]), "PyPI cannot be reached, so that these are not measured: Drake, CasADi.")

    def test_a_package_that_cannot_be_installed_is_reported(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            pip = path / "venv" / "bin" / "python"
            pip.parent.mkdir(parents=True)
            pip.write_text("#!/bin/sh\necho 'no matching distribution'\nexit 1\n", encoding="utf-8")
            pip.chmod(0o755)
            python, failed = race.install(path, ["drake", "pin"])
        self.assertEqual(python, pip)
        self.assertEqual(failed, {"drake": "no matching distribution", "pin": "no matching distribution"})


if __name__ == "__main__":
    unittest.main()
