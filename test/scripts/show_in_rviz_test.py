#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""show_in_rviz gives the shipped configurations prefix, camera and grid, and changes nothing else."""
import importlib.machinery
import importlib.util
import math
import os
import pathlib
import tempfile
import types
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

    def changed(self, name, scene):
        before = yaml.safe_load((ROOT / "rviz" / name).read_text(encoding="utf-8"))
        return before, yaml.safe_load(SCRIPT.with_scene((ROOT / "rviz" / name).read_text(encoding="utf-8"), scene))

    def test_camera_and_grid_are_those_of_the_scene(self):
        scene = types.SimpleNamespace(smallest=[1.0, 2.0, -0.5], largest=[3.1, 2.5, 1.0], floor=-0.4, grid_cell=0.2, focal_point=[2.0, 2.2, 0.3],
                                      distance=5.5, yaw=0.6, pitch=0.8)
        for name in ("simulate.rviz", "replay.rviz", "overlay.rviz", "identify.rviz"):
            with self.subTest(name):
                before, after = self.changed(name, scene)
                view = after["Visualization Manager"]["Views"]["Current"]
                self.assertEqual((view["Distance"], view["Yaw"], view["Pitch"]), (5.5, 0.6, 0.8))
                self.assertEqual(view["Focal Point"], {"X": 2.0, "Y": 2.2, "Z": 0.3})
                grid, = (one for one in after["Visualization Manager"]["Displays"] if one["Class"] == "rviz/Grid")
                self.assertEqual((grid["Cell Size"], grid["Offset"]["Z"]), (0.2, -0.4))
                # The lines lie at multiples of a cell, and the grid reaches beyond the mechanism on every side.
                self.assertAlmostEqual(math.remainder(grid["Offset"]["X"], 0.2), 0.0)
                self.assertAlmostEqual(grid["Offset"]["X"], 2.05, delta=0.1)
                self.assertGreater(grid["Plane Cell Count"] * 0.2, 2 * 5.4)
                for key, value in before["Visualization Manager"].items():
                    if key not in ("Views", "Displays"):
                        self.assertEqual(after["Visualization Manager"][key], value)
                self.assertEqual(after["Window Geometry"], before["Window Geometry"], "a text of digits stays a text")
                self.assertEqual([one["Class"] for one in after["Visualization Manager"]["Displays"]],
                                 [one["Class"] for one in before["Visualization Manager"]["Displays"]])

    def test_a_configuration_of_the_users_own_and_a_bag_without_a_scene_change_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            own = os.path.join(folder, "own.rviz")
            text = (ROOT / "rviz" / "replay.rviz").read_text(encoding="utf-8")
            pathlib.Path(own).write_text(text, encoding="utf-8")
            bag = os.path.join(folder, "old.bag")
            import rosbag
            rosbag.Bag(bag, "w").close()
            parameters = {"scene": "scene", "bag": os.path.join(folder, "missing.bag"), "frame_prefix": ""}
            self.assertEqual(SCRIPT.changed(own, parameters), text)
            self.assertEqual(SCRIPT.changed(str(ROOT / "rviz" / "replay.rviz"), {**parameters, "bag": bag}), text)
            with self.assertRaisesRegex(SystemExit, "missing.bag"):
                SCRIPT.changed(str(ROOT / "rviz" / "replay.rviz"), parameters)

    def test_overlay_differs_from_replay_in_the_ghost_alone(self):
        replay, overlay = (yaml.safe_load((ROOT / "rviz" / name).read_text(encoding="utf-8")) for name in ("replay.rviz", "overlay.rviz"))
        for config in (replay, overlay):
            for display in config["Visualization Manager"]["Displays"]:
                if display["Name"] == "Initial mechanism":
                    self.assertEqual(display.pop("Alpha"), 1 if config is replay else 0.3)
                if display["Name"] in ("Initial friction", "Initial events"):
                    self.assertEqual((display.pop("Enabled"), display.pop("Value")), (config is replay,) * 2)
        self.assertEqual(overlay, replay)


if __name__ == "__main__":
    unittest.main()
