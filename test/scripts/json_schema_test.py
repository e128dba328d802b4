#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What every command prints with --json has the keys and types of doc/schema/codesign.schema.json, and no others; and doc/json.md is made from it.
Usage: json_schema_test.py CODESIGN [unittest arguments]"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "doc/schema/codesign.schema.json").read_text())
CODESIGN = sys.argv.pop(1)

EXCITE = """
identify: {joints: {shoulder: {offset: {}}}, intervals: {noise: white}}
excite: {joints: {shoulder: {position: [-1.6, 1.6]}, elbow: {position: [-2.0, 2.0]}}, noise: 0.1, period: 4.0, harmonics: 2, periods: 1}
parameters: {counterweight: {}}
"""
MOTION = """
duration: 4.0
initial_state: {shoulder: {position: 0.3}, elbow: {position: -0.5}}
controllers:
  shoulder_servo: {type: computed_torque, output: shoulder, gains: {p: 400, d: 40}, setpoint: {type: waypoints, times: [0, 1, 2, 4], positions: [0.3, 1.0, -0.4, 0.3]}}
  elbow_servo: {type: computed_torque, output: elbow, gains: {p: 400, d: 40}, setpoint: {type: waypoints, times: [0, 1, 2, 4], positions: [-0.5, 0.8, -0.2, 0.5]}}
"""


def validator(command):
    return jsonschema.Draft202012Validator({**SCHEMA, "$ref": f"#/$defs/command_{command}"})


class Outputs(unittest.TestCase):
    def check(self, command, *arguments, code=0, schema=None):
        done = subprocess.run([CODESIGN, command, *map(str, arguments), "--json", "--quiet"], capture_output=True, text=True, check=False, cwd=ROOT)
        self.assertEqual(done.returncode, code, done.stderr)
        output = json.loads(done.stdout)
        faults = [f"{list(fault.absolute_path)}: {fault.message[:300]}" for fault in validator(schema or command).iter_errors(output)]
        self.assertEqual(faults, [], f"{command} {arguments}")
        return output

    def case(self, name):
        return [f"urdf/{name}.urdf", f"config/{name}.yaml"]

    def test_every_shipped_case_can_be_checked(self):
        for study in sorted((ROOT / "config").glob("*.yaml")):
            # A study with recordings needs these.
            if "identify:" not in study.read_text():
                self.check("check", *self.case(study.stem))

    def test_a_run(self):
        output = self.check("simulate", *self.case("slider_crank"))
        self.assertEqual(len(output["series"]["time"]), len(next(iter(output["series"].values()))))
        self.check("urdf", "urdf/slider_crank.urdf")

    def test_statics(self):
        self.check("efforts", *self.case("two_link_arm"))
        with tempfile.TemporaryDirectory() as folder:
            study = pathlib.Path(folder) / "study.yaml"
            study.write_text("duration: 1.0\nefforts: {grid: {shoulder: {from: -1.5, to: 1.5, count: 3}, elbow: [0.0, 1.0]}}\n")
            self.check("efforts", "urdf/two_link_arm.urdf", study)
            study.write_text("duration: 2.0\n")
            self.check("equilibrium", "urdf/governor.urdf", study)

    def test_postures_and_measures(self):
        self.check("simulate", *self.case("four_bar_path"))
        self.check("optimize", *self.case("six_bar_dwell"))

    def test_a_gradient(self):
        self.check("gradient", *self.case("slider_crank"), "--verify")
        self.check("gradient", *self.case("slider_crank"), "--verify=ridders")

    def test_searches(self):
        self.check("optimize", *self.case("slider_crank"))
        self.check("optimize", *self.case("pendulum_robust"))
        self.check("optimize", *self.case("governor_multistart"))

    def test_a_fit_and_a_trajectory(self):
        with tempfile.TemporaryDirectory() as folder:
            study, recording, model = pathlib.Path(folder) / "study.yaml", pathlib.Path(folder) / "run.csv", "urdf/arm_limits.urdf"
            study.write_text(EXCITE)
            self.check("excite", model, study)
            moving = pathlib.Path(folder) / "moving.yaml"
            moving.write_text(MOTION)
            signals = ",".join(f"{joint}/{quantity}" for joint in ("shoulder", "elbow") for quantity in ("position", "velocity", "effort"))
            subprocess.run([CODESIGN, "simulate", model, moving, "--signals", signals, "--csv", recording, "--samples", "400"], check=True, cwd=ROOT, capture_output=True)
            study.write_text(MOTION + "identify: {data: [{csv: run.csv}], holdout: [{csv: run.csv}]}\nparameters: {counterweight: {initial: 1.8}}\n")
            self.check("check", model, study)
            self.check("identify", model, study)

    def test_a_project_from_the_gallery(self):
        self.assertTrue(self.check("new")["machines"])
        with tempfile.TemporaryDirectory() as folder:
            output = self.check("new", pathlib.Path(folder) / "press", "--from", "toggle_press")
        self.assertEqual(len(output["files"]), 2)

    def test_faults(self):
        self.check("simulate", "urdf/absent.urdf", "config/slider_crank.yaml", code=2, schema="error")
        self.check("simulate", code=2, schema="error")

    def test_an_unknown_key_is_noticed(self):
        output = self.check("urdf", "urdf/slider_crank.urdf")
        output["unknown"] = 1
        self.assertTrue(list(validator("urdf").iter_errors(output)))
        del output["unknown"], output["version"]
        self.assertTrue(list(validator("urdf").iter_errors(output)))


class Page(unittest.TestCase):
    def test_it_is_made_from_the_schema(self):
        made = subprocess.run([ROOT / "tools/json_page"], capture_output=True, text=True, check=True).stdout
        self.assertEqual((ROOT / "doc/json.md").read_text(), made, "run tools/json_page > doc/json.md")


if __name__ == "__main__":
    unittest.main()
