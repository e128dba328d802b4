# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Small problems, the shipped cases, and the command line, for the tests of the Python package."""
import json
import os
import re
import subprocess
import sys
import threading

import numpy as np

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CODESIGN = os.environ["CODESIGN"]
sys.path.insert(0, os.path.join(ROOT, "test"))
from patience import PATIENCE, wait_until  # noqa: E402,F401

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
# A mass with viscous and dry friction and a torque on its joint, to be identified from its motion.
ARM = """<robot name="arm" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="mass" value="1" lower="0.1" upper="10" unit="kg"/>
  <codesign:parameter name="viscous" value="0.1" lower="0" upper="5"/>
  <link name="ground"/>
  <link name="rod"><inertial><origin xyz="0 0 -0.5"/><mass value="1" codesign:value="${mass}"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="ground"/><child link="rod"/><axis xyz="0 1 0"/>
    <dynamics damping="0.1" codesign:damping="${viscous}"/></joint>
</robot>
"""
FIT = "duration: 4.0\nparameters: {mass: {}, viscous: {}}\n"
# A pendulum that turns without friction for some minutes of computing.
FREE = re.sub("<codesign:friction[^>]*>", "", PENDULUM)
LONG = SWING.replace("duration: 2.0", "duration: 1.0e+6").replace("position: 1.0", "velocity: 20.0") + (
    "solver: {method: rodas5p, relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11, maximum_steps: 1000000000}\n")


class Asked(threading.Event):
    """An event that counts its answers since it is set."""

    def __init__(self):
        super().__init__()
        self.answers = 0

    def is_set(self):
        self.answers += super().is_set()
        return super().is_set()

    def set_and_seen(self):
        """Sets it, and returns when a search has acted upon it: before it asks again."""
        self.set()
        first = self.answers
        wait_until(lambda: self.answers >= first + 2, "nobody asks the event")


def processor_time(process):
    """Of all threads of a process so far [s]."""
    with open(f"/proc/{process}/stat", encoding="utf-8") as file:
        fields = file.read().rpartition(")")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def wait_for_computing(process, seconds):
    """Returns when a process has computed for so many seconds of processor time from now on."""
    begin = processor_time(process)
    wait_until(lambda: processor_time(process) >= begin + seconds, "it does not compute")


def case(name):
    """The paths of model and study of a shipped case."""
    return os.path.join(ROOT, "urdf", name + ".urdf"), os.path.join(ROOT, "config", name + ".yaml")


def command_line(*words, code=0):
    """The JSON that `codesign ... --json` prints."""
    done = subprocess.run([CODESIGN, *map(str, words), "--json", "--quiet"], capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stderr
    return json.loads(done.stdout)


def recorded():
    """A motion of the arm, with the torque that its equation needs: (time, position, effort), for a mass of 2 kg and a damping of 0.7."""
    t = np.linspace(0.0, 4.0, 401)
    q, v, a = np.sin(2.0 * t) + 0.3 * np.sin(5.0 * t), 2.0 * np.cos(2.0 * t) + 1.5 * np.cos(5.0 * t), -4.0 * np.sin(2.0 * t) - 7.5 * np.sin(5.0 * t)
    return t, q, (0.01 + 2.0 * 0.25) * a + 2.0 * 9.81 * 0.5 * np.sin(q) + 0.7 * v
