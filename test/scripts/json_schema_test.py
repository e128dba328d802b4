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
PENDULUM = """
<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="length" value="0.5" lower="0.3" upper="0.8"/>
  <codesign:parameter name="damping" value="0.1" lower="0" upper="1"/>
  <link name="ground"/>
  <link name="rod"><inertial>
    <origin xyz="0 0 -0.25" codesign:xyz="0 0 ${-length/2}"/><mass codesign:value="${2*length}"/><inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.001"/>
  </inertial></link>
  <joint name="pivot" type="continuous"><parent link="ground"/><child link="rod"/><axis xyz="0 1 0"/><dynamics damping="0.1" codesign:damping="${damping}"/></joint>
</robot>
"""
SWING = """
duration: 1.0
initial_state: {pivot: {position: 1.0}}
parameters: {length: {}}
objective: {terminal: [{signal: pivot/position, reference: 0.0}]}
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
        self.assertIn("<codesign:actuator", self.check("overlay", "urdf/vendor_arm.urdf")["overlay"])

    def test_events(self):
        with tempfile.TemporaryDirectory() as folder:
            files = self.pendulum(folder, 'loads: [{joint: pivot, effort: "${t < 0.5 ? 0 : pivot/velocity < 0 ? 0.1 : -0.1}"}]')
            for command in ("simulate", "gradient", "optimize"):
                output = self.check(command, *files)
                self.assertGreaterEqual(output["event_count"], 1)
                self.assertEqual(output["events"][0]["expression"], "t < 0.5")

    def test_statics(self):
        self.check("efforts", *self.case("two_link_arm"))
        with tempfile.TemporaryDirectory() as folder:
            study = pathlib.Path(folder) / "study.yaml"
            study.write_text("duration: 1.0\nefforts: {grid: {shoulder: {from: -1.5, to: 1.5, count: 3}, elbow: [0.0, 1.0]}}\n")
            self.check("efforts", "urdf/two_link_arm.urdf", study)
            study.write_text("duration: 2.0\n")
            self.check("equilibrium", "urdf/governor.urdf", study)

    def test_linearizations(self):
        arm = self.check("linearize", *self.case("two_link_arm"), "--signals", "elbow/position")
        self.assertEqual(arm["outputs"], ["elbow/position"])
        self.assertEqual(len(arm["A"]), len(arm["states"]))
        self.assertEqual(arm["stability"], "stable")
        sampled = self.check("linearize", *self.case("feed_axis"))
        self.assertGreater(sampled["period"], 0.0)
        self.assertEqual(sampled["loops"]["velocity_loop"]["samples"], 4)
        self.check("linearize", *self.case("slider_crank"), "--at", "0.5")
        self.check("linearize", *self.case("slider_crank"), "--at", "50", code=2, schema="error")

    def test_a_trade_off(self):
        curve = self.check("tradeoff", "gallery/goods_lift/model.urdf", "gallery/goods_lift/tradeoff.yaml", "--points", "3")
        self.assertEqual([point["anchor"] for point in curve["points"]], [True, False, True])

    def test_choices(self):
        with tempfile.TemporaryDirectory() as folder:
            study = pathlib.Path(folder) / "study.yaml"
            study.write_text("duration: 0.3\nparameters: {gear: {choice: [6, 14, 30]}}\n"
                             "controllers: {motor: {type: state_feedback, output: lift, feedforward: \"${20*gear/0.1}\"}}\n"
                             "objective: {terminal: [{signal: lift/position, reference: 2.0}]}\n")
            result = self.check("optimize", "gallery/hoist_gear/model.urdf", study)
        self.assertEqual(result["choice"]["chosen"], {"gear": "14"})
        self.assertEqual((result["termination"], result["choice"]["searched"]), ("all_combinations_searched", 3))

    def test_postures_and_measures(self):
        self.check("simulate", *self.case("four_bar_path"))
        self.check("optimize", *self.case("six_bar_dwell"))

    def test_a_gradient(self):
        self.check("gradient", *self.case("slider_crank"), "--verify")
        self.check("gradient", *self.case("slider_crank"), "--verify=ridders")

    def test_searches(self):
        self.check("optimize", *self.case("slider_crank"))
        with tempfile.TemporaryDirectory() as folder:
            # Few samples and starts have all keys; what searches of the shipped cases find is tested in test/cases.
            uncertain = "uncertain: {damping: {uniform: [0.0, 0.2]}}"
            robust = self.check("optimize", *self.pendulum(folder, uncertain, "robust: {measure: worst, samples: 4, validate: 2}"))
            self.assertLessEqual({"scenarios", "worst_scenario", "validation"}, robust.keys())
            self.assertEqual(len(robust["scenarios"]), 7)  # four samples, and what the worst case adds
            starts = self.check("optimize", *self.pendulum(folder, "multistart: {starts: 2, screen: 4}"))
            self.assertIn("multistart", starts)

    def pendulum(self, folder, *further):
        """The paths of a model and of the study above with further lines."""
        model, study = pathlib.Path(folder) / "pendulum.urdf", pathlib.Path(folder) / "swing.yaml"
        model.write_text(PENDULUM.replace("<mass ", '<mass value="1" '))
        study.write_text("\n".join([SWING, *further]))
        return [model, study]

    def test_a_model_that_is_filled(self):
        with tempfile.TemporaryDirectory() as folder:
            model = pathlib.Path(folder) / "pendulum.urdf"
            model.write_text(PENDULUM)
            self.check("urdf", model, code=2, schema="error")
            self.assertIn('value="1"', self.check("urdf", model, "--fill")["urdf"])

    def test_one_run_of_a_study(self):
        with tempfile.TemporaryDirectory() as folder:
            files = self.pendulum(folder, "runs: {near: {initial_state: {pivot: {position: 0.5}}}, far: {initial_state: {pivot: {position: 1.5}}}}")
            starts = [self.check("simulate", *files, "--run", run)["series"]["pivot/position"][0] for run in ("near", "far")]
            self.assertEqual(starts, [0.5, 1.5])
            self.check("gradient", *files, "--run", "near")
            self.check("simulate", *files, "--run", "nearest", code=2, schema="error")

    def test_a_run_that_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            files = self.pendulum(folder, "solver: {maximum_steps: 3}")
            for command in ("simulate", "gradient", "optimize"):
                output = self.check(command, *files, code=1)
                self.assertEqual(output["error"]["code"], "too_many_steps")
            # It slides down without end.
            model, study = self.pendulum(folder)
            model.write_text(model.read_text().replace('continuous"', 'prismatic"').replace('<axis xyz="0 1 0"/>', '<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>'))
            study.write_text("duration: 1.0\n")
            self.assertEqual(self.check("equilibrium", model, study, code=1)["error"]["code"], "no_equilibrium")

    def test_a_search_without_a_feasible_point(self):
        with tempfile.TemporaryDirectory() as folder:
            output = self.check("optimize", *self.pendulum(folder, "path: [{signal: pivot/velocity, between: [-0.01, 0.01]}]"), code=1)
            self.assertEqual(output["error"]["code"], "infeasible")
            self.assertGreater(output["signals"][0]["violation"], 0.01)
            output = self.check("optimize", *self.pendulum(folder, 'constraints: ["length >= 2"]'), code=1)
            self.assertEqual(output["error"]["code"], "infeasible")
            self.assertLess(output["constraints"][0]["margin"], -1.0)

    def test_a_job_that_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            job = pathlib.Path(folder) / "job"
            output = self.check("optimize", *self.pendulum(folder), "--output", job)
            written = json.loads((job / "result.json").read_text())
            self.assertEqual(list(validator("optimize").iter_errors(written)), [])
            resumed = self.check("optimize", *self.pendulum(folder), "--resume", job)
            self.assertEqual(resumed["parameters"], output["parameters"])
            self.check("simulate", *self.pendulum(folder), "--result", job / "result.json")
            self.check("optimize", *self.pendulum(folder, "gravity: [0, 0, -1.6]"), "--resume", job, code=2, schema="error")

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
            self.check("identify", model, study, "--output", pathlib.Path(folder) / "fit")
            self.check("identify", model, study, "--evaluate", "--against", pathlib.Path(folder) / "fit" / "identification.json")

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
    def test_every_key_has_a_meaning(self):
        lines = (ROOT / "doc/json.md").read_text().splitlines()
        rows = [line for line in lines if line.startswith("| `")]
        again = [line for line in lines if "of [several commands](" in line]  # keys that other commands have as well
        self.assertGreater(len(rows) + sum(line.count("`") // 2 for line in again), 300)
        self.assertEqual([row for row in rows if not row.rstrip(" |").count(" | ") == 2], [])

    def test_it_is_made_from_the_schema(self):
        made = subprocess.run([ROOT / "tools/json_page"], capture_output=True, text=True, check=True).stdout
        self.assertEqual((ROOT / "doc/json.md").read_text(), made, "run tools/json_page > doc/json.md")


if __name__ == "__main__":
    unittest.main()
