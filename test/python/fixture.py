# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""A small problem, the shipped cases, and the command line, for the tests of the Python package."""
import json
import os
import subprocess
import sys

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CODESIGN = os.environ["CODESIGN"]

PENDULUM = """<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="length" value="0.5" lower="0.3" upper="0.8" unit="m"/>
  <codesign:parameter name="payload" value="0.1" lower="0" upper="1" unit="kg"/>
  <link name="ground"/>
  <link name="rod"><visual><origin xyz="0 0 -0.25"/><geometry><box size="0.02 0.02 0.5"/></geometry></visual><inertial>
    <origin xyz="0 0 -0.25" codesign:xyz="0 0 ${-length/2}"/><mass value="1.1" codesign:value="${2*length + payload}"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.001" codesign:ixx="${0.16*length**3}" codesign:iyy="${0.16*length**3}"/>
  </inertial></link>
  <joint name="pivot" type="continuous"><parent link="ground"/><child link="rod"/><axis xyz="0 1 0"/>
    <codesign:friction mu_static="0.3" mu_dynamic="0.2" joint_length="0.05" pin_radius="0.02"/></joint>
</robot>
"""
SWING = """duration: 2.0
initial_state: {pivot: {position: 1.0}}
parameters: {length: {}}
optimizer: {algorithm: lbfgs}
objective: {terminal: [{signal: pivot/position, reference: 0.0}, {signal: pivot/velocity, reference: 0.0, weight: 0.1}]}
"""


def case(name):
    """The paths of model and study of a shipped case."""
    return os.path.join(ROOT, "urdf", name + ".urdf"), os.path.join(ROOT, "config", name + ".yaml")


def command_line(*words, code=0):
    """The JSON that `codesign ... --json` prints."""
    done = subprocess.run([CODESIGN, *map(str, words), "--json", "--quiet"], capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stderr
    return json.loads(done.stdout)
