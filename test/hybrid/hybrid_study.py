# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""A hybrid study twice: as URDF and YAML, and as the rates of its states for the event-driven solver. Laws of doc/theory.md, written anew: stops (13d), limits of
actuators (13c), elastic gears with play (9a), (9c), PID (C3), (50), samples (51), objective (21)."""
import dataclasses

import numpy as np

from expressions import Formula, Point, formula, quoted
from mechanisms import urdf


def saturated(u, limit):
    return u / (1.0 + (u / limit) ** 8) ** 0.125


def depth(point, branch, g, w):
    """delta(g) of (13d), and its derivative."""
    if not point.is_positive((branch, 0), g):
        return 0.0 * g, 0.0 * g
    if point.is_positive((branch, 1), g - w):
        return g - w / 2.0, 1.0 + 0.0 * g
    s = g / w
    return w * (2.5 * s**4 - 3.0 * s**5 + s**6), 10.0 * s**3 - 15.0 * s**4 + 6.0 * s**5


@dataclasses.dataclass
class Gear:
    joint: str
    ratio: float
    rotor: float
    stiffness: str
    damping: float
    backlash: str


@dataclasses.dataclass
class Pid:
    """@param setpoint of the time; without a rate it is constant between its jumps"""
    name: str
    joint: str
    setpoint: Formula
    gains: dict
    output_limit: float = 0.0
    sample_time: float = 0.0

    def yaml(self):
        gains = ", ".join(f"{key}: {quoted(value)}" for key, value in self.gains.items())
        more = (f", output_limit: {self.output_limit}" if self.output_limit else "") + (f", sample_time: {self.sample_time}" if self.sample_time else "")
        return f"  {self.name}: {{type: pid, input: {self.joint}/position, output: {self.joint}, setpoint: {quoted(self.setpoint)}, gains: {{{gains}}}{more}}}"

    def gain(self, point, key):
        return self.gains[key].value(point) if key in self.gains else 0.0


class HybridStudy:
    def __init__(self, mechanism, duration):
        self.mechanism, self.duration = mechanism, duration
        self.parameters, self.of_model, self.ranges = {}, {}, {}
        self.loads, self.controllers, self.gears, self.stops, self.dampers = [], [], [], {}, {}
        self.limits = {"stiffness": 1e4, "dissipation": 1.0, "width": 1e-3, "effort": {}}
        self.initial, self.integral, self.terminal = {}, [], []
        self.solver = ""

    # ---- text

    def model_text(self):
        extra = {}
        for gear in self.gears:
            extra[gear.joint] = (f'<codesign:actuator gear_ratio="{gear.ratio}" rotor_inertia="{gear.rotor}" stiffness="{self.of_model[gear.stiffness]}" '
                                 f'codesign:stiffness="${{{gear.stiffness}}}" damping="{gear.damping}" backlash="{self.of_model[gear.backlash]}" '
                                 f'codesign:backlash="${{{gear.backlash}}}"/>')
        for joint, damping in self.dampers.items():
            extra[joint] = f'<dynamics damping="{damping}"/>' + extra.get(joint, "")
        for joint, limit in self.limits["effort"].items():
            extra[(joint, "effort")] = limit
        return urdf(self.mechanism, self.of_model, self.stops, extra)

    def study_text(self):
        lines = [f"duration: {self.duration}", "initial_state:"]
        lines += [f"  {joint}: {{position: {quoted(x)}, velocity: {quoted(v)}}}" for joint, (x, v) in self.initial.items()]
        lines += ["loads:"] * bool(self.loads) + [f"  - {{joint: {joint}, effort: {quoted(load)}}}" for joint, load in self.loads]
        lines += ["controllers:"] * bool(self.controllers) + [controller.yaml() for controller in self.controllers]
        if self.stops or self.limits["effort"]:
            numbers = ", ".join(f"{key}: {self.limits[key]}" for key in ("stiffness", "dissipation", "width")) if self.stops else ""
            keys = [f"position: true, {numbers}"] * bool(self.stops) + ["effort: true"] * bool(self.limits["effort"])
            lines += [f"limits: {{{', '.join(keys)}}}"]
        lines += ["parameters:"]
        for name, value in self.values_of_all.items():
            lower, upper = self.ranges[name]
            initial = "" if name in self.of_model else f"initial: {value}, "
            lines += [f"  {name}: {{{initial}lower: {lower}, upper: {upper}}}"]
        lines += ["objective:"]
        for key, terms in (("integral", self.integral), ("terminal", self.terminal)):
            lines += [f"  {key}:"] * bool(terms) + [f"    - {{signal: {quoted(signal)}, reference: {reference}, weight: {weight}}}" for signal, reference, weight in terms]
        return "\n".join(lines + [f"solver: {self.solver}"]) + "\n"

    # ---- the model of event_solver.Motion

    @property
    def values_of_all(self):
        return {**self.of_model, **self.parameters}

    @property
    def names(self):
        return list(self.values_of_all)

    @property
    def values(self):
        return list(self.values_of_all.values())

    @property
    def size(self):
        return 2 * len(self.mechanism.joints) + 2 * len(self.gears) + sum(3 if c.sample_time else 1 for c in self.controllers) + 1

    @property
    def sampling(self):
        instants = {}
        for controller in self.controllers:
            for k in range(int(self.duration / controller.sample_time + 2) if controller.sample_time else 0):
                instants.setdefault(k * controller.sample_time, []).append(controller)
        return [(time, lambda point, y, due=due: self.sample(point, y, due)) for time, due in sorted(instants.items(), key=lambda item: item[0])]

    def places(self):
        n = len(self.mechanism.joints)
        first = 2 * n + 2 * len(self.gears)
        result = []
        for controller in self.controllers:
            result.append(first)
            first += 3 if controller.sample_time else 1
        return result

    def start(self, point):
        n = len(self.mechanism.joints)
        given = [self.initial.get(joint, (formula(0.0), formula(0.0))) for joint in self.mechanism.joints]
        q, v = [x.value(point) for x, _ in given], [u.value(point) for _, u in given]
        motors = [part for gear in self.gears for part in (q[self.mechanism.joints.index(gear.joint)], v[self.mechanism.joints.index(gear.joint)])]
        return q + v + motors + [np.zeros(1)] * (self.size - 2 * n - 2 * len(self.gears))

    def sample(self, point, y, due):
        """(51): states are the output in effect, the sum and the last error."""
        y = np.array(y)
        for controller, place in zip(self.controllers, self.places()):
            if controller not in due:
                continue
            period, error = controller.sample_time, controller.setpoint.value(point) - y[self.mechanism.joints.index(controller.joint)]
            y[place + 1] = y[place + 1] + period * error
            change = (error - y[place + 2]) / period if point.t > 0.0 else 0.0 * error
            u = controller.gain(point, "p") * error + controller.gain(point, "i") * y[place + 1] + controller.gain(point, "d") * change
            limit = controller.output_limit
            y[place] = np.where(np.abs(u.real) < limit, u, np.sign(u.real) * limit) if limit else u
            y[place + 2] = error
        return y

    def stop(self, point, k, joint, q, v):
        lower, upper = self.stops[joint]
        force = 0.0
        for direction, limit in ((1.0, upper), (-1.0, lower)):
            g, rate = direction * (q - eval(limit, {}, point.parameters)), direction * v  # pylint: disable=eval-used
            y = self.limits["dissipation"] * rate
            force = force - direction * self.limits["stiffness"] * depth(point, ("stop", k, direction), g, self.limits["width"])[0] * (y + np.sqrt(1.0 + y * y))
        return force

    def gear_torque(self, point, k, gear, x, rate):
        play = point.parameters[gear.backlash]
        width = play / 10.0
        above, slope_above = depth(point, ("gear", k, 1), x - 0.5 * (play - width), width)
        below, slope_below = depth(point, ("gear", k, -1), -x - 0.5 * (play - width), width)
        return point.parameters[gear.stiffness] * (above - below) + gear.damping * (slope_above + slope_below) * rate

    def outputs(self, point, q, v, y):
        """The outputs of controllers by joint, and the rates of their states."""
        efforts, rates = {}, []
        for controller, place in zip(self.controllers, self.places()):
            k = self.mechanism.joints.index(controller.joint)
            error = controller.setpoint.value(point) - q[k]
            wanted = controller.setpoint.rate(point) if controller.setpoint.rate else 0.0
            if controller.sample_time:
                u, further = y[place], [0.0, 0.0, 0.0]
            else:
                u = controller.gain(point, "p") * error + controller.gain(point, "i") * y[place] + controller.gain(point, "d") * (wanted - v[k])
                u, further = saturated(u, controller.output_limit) if controller.output_limit else u, [error]
                point.signals[controller.name + "/error"], point.signals[controller.name + "/integral"] = error, y[place]
            point.signals[controller.name + "/output"] = u
            efforts[k] = efforts.get(k, 0.0) + u
            rates += further
        return efforts, rates

    def rates(self, point, y):
        joints = self.mechanism.joints
        n = len(joints)
        q, v = list(y[:n]), list(y[n:2 * n])
        for k, joint in enumerate(joints):
            point.signals[joint + "/position"], point.signals[joint + "/velocity"] = q[k], v[k]
        efforts, controller_rates = self.outputs(point, q, v, y)
        load = [0.0 * q[k] - self.dampers.get(joint, 0.0) * v[k] for k, joint in enumerate(joints)]
        for joint, effort in self.loads:
            load[joints.index(joint)] = load[joints.index(joint)] + effort.value(point)
        for joint in self.stops:
            k = joints.index(joint)
            load[k] = load[k] + self.stop(point, k, joint, q[k], v[k])
        for k, joint in enumerate(joints):
            if k in efforts and joint in self.limits["effort"]:
                efforts[k] = saturated(efforts[k], self.limits["effort"][joint])
            point.signals[joint + "/effort"] = efforts.get(k, 0.0 * q[k])
        motors = []
        for k, gear in enumerate(self.gears):
            at, j = 2 * n + 2 * k, joints.index(gear.joint)
            torque = self.gear_torque(point, k, gear, y[at] - q[j], y[at + 1] - v[j])
            load[j] = load[j] + torque
            motors += [y[at + 1], (efforts.pop(j, 0.0) - torque) / (gear.ratio**2 * gear.rotor)]
        for k, effort in efforts.items():
            load[k] = load[k] + effort
        accelerations = self.mechanism.solve(point.parameters, q, v, load)
        for joint, acceleration in zip(joints, accelerations):
            point.signals[joint + "/acceleration"] = acceleration
        integrand = sum(weight * (signal.value(point) - reference) ** 2 for signal, reference, weight in self.integral)
        return v + list(accelerations) + motors + controller_rates + [integrand]

    def objective(self, point, y):
        ends = Point(point.t, point.parameters)
        self.rates(ends, y)
        return y[-1] + sum(weight * (signal.value(ends) - reference) ** 2 for signal, reference, weight in self.terminal)
