#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""show_in_rviz gives every robot of the shipped configurations its prefix, and nothing else."""
import importlib.machinery
import importlib.util
import pathlib
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]


def load_script(name):
    loader = importlib.machinery.SourceFileLoader(name, str(ROOT / "scripts" / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


SCRIPT = load_script("show_in_rviz")


def robots(text):
    displays = yaml.safe_load(text)["Visualization Manager"]["Displays"]
    return [display for display in displays if display["Class"] == "rviz/RobotModel"]


class ShowInRviz(unittest.TestCase):
    def test_the_shipped_configuration_takes_the_prefix_without_its_slash(self):
        text = (ROOT / "rviz" / "simulate.rviz").read_text(encoding="utf-8")
        self.assertEqual([robot["TF Prefix"] for robot in robots(text)], [""])
        changed = SCRIPT.with_prefix(text, "left/")
        self.assertEqual([robot["TF Prefix"] for robot in robots(changed)], ["left"])
        self.assertEqual(changed.replace('TF Prefix: "left"', 'TF Prefix: ""'), text)

    def test_a_prefix_that_is_there_stays(self):
        text = 'a:\n  TF Prefix: right\nb:\n  TF Prefix: ""\nc:\n  TF Prefix:\nd:\n  Value: true\n'
        changed = yaml.safe_load(SCRIPT.with_prefix(text, "2/"))
        self.assertEqual(changed, {"a": {"TF Prefix": "right"}, "b": {"TF Prefix": "2"}, "c": {"TF Prefix": "2"}, "d": {"Value": True}})

    def test_a_prefix_that_rviz_cannot_know_is_refused(self):
        with self.assertRaisesRegex(SystemExit, "left_"):
            SCRIPT.with_prefix("", "left_")


if __name__ == "__main__":
    unittest.main()
