# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""A random hybrid study from its number alone: one mechanism, one to four guards in loads, set-points, stops, gears and the objective; tuned masses, lengths,
thresholds, instants and gains."""
import numpy as np

import mechanisms
from expressions import TIME, choose, floor, formula, function, largest, least, magnitude, number, parameter, sign, signal, square, table, waypoints
from hybrid_study import Gear, HybridStudy, Pid


class Generator:
    def __init__(self, seed):
        self.dice = np.random.default_rng(seed)
        mechanism = mechanisms.ALL[self.dice.integers(len(mechanisms.ALL))]()
        self.study = HybridStudy(mechanism, self.uniform(0.8, 1.6))
        self.kinds = [mechanism.name]
        for name, (lower, upper) in mechanism.numbers.items():
            self.study.of_model[name] = self.uniform(lower + 0.2 * (upper - lower), upper - 0.2 * (upper - lower))
            self.study.ranges[name] = (lower, upper)

    def uniform(self, lower, upper):
        return round(float(self.dice.uniform(lower, upper)), 3)

    def chance(self, share):
        return self.dice.random() < share

    def pick(self, things):
        return things[self.dice.integers(len(things))]

    def tuned(self, kind, lower, upper):
        """A number of the study, mostly a tuned parameter."""
        value = self.uniform(lower, upper)
        if not self.chance(0.7):
            return number(value)
        name = f"{kind}{len(self.study.parameters)}"
        self.study.parameters[name] = value
        self.study.ranges[name] = (round(lower - 0.5 * (upper - lower), 3), round(upper + 0.5 * (upper - lower), 3))
        return parameter(name)

    def instant(self):
        """Some are those of samples, of other switches, or nearly the start or the end of the run."""
        duration = self.study.duration
        lower, upper = self.pick([(0.1, 0.9)] * 6 + [(0.0, 0.02), (0.98, 1.0)])
        instant = self.tuned("t", lower * duration, upper * duration)
        tuned = [name for name in self.study.parameters if name[0] == "t"]
        if self.chance(0.3) and instant.text in tuned:
            others = [0.1 * k for k in range(1, int(10.0 * duration))] + 2 * [self.study.parameters[name] for name in tuned]
            self.study.parameters[instant.text] = round(self.pick(others), 3)
            self.study.ranges[instant.text] = (-1.0, 3.0)
        return instant

    def joint(self):
        return self.pick(self.study.mechanism.joints)

    def position(self):
        return signal(self.joint() + "/position")

    def velocity(self):
        return signal(self.joint() + "/velocity")

    def force(self):
        return self.uniform(1.0, 4.0) * self.pick([-1.0, 1.0])

    # ---- what switches

    def time_jump(self, joint):
        return choose(TIME, self.instant(), self.force(), self.force())

    def time_pulse(self, joint):
        start = self.tuned("s", 0.1, 0.5)
        return choose(TIME, start, 0.0, choose(TIME, formula(start) + self.tuned("w", 0.01, 0.3), 3.0 * self.force(), 0.0))

    def time_kink(self, joint):
        return largest(0.0, TIME - self.instant()) * self.force()

    def waves(self, joint):
        return choose(function("sin", TIME * self.tuned("o", 4.0, 20.0)), self.uniform(-0.5, 0.5), self.force(), self.force())

    def stairs(self, joint):
        return floor(TIME / self.tuned("d", 0.15, 0.6)) * (0.5 * self.force())

    def position_jump(self, joint):
        """Zero is where many motions begin."""
        return choose(self.position(), 0.0 if self.chance(0.15) else self.tuned("x", -0.5, 0.5), self.force(), self.force())

    def position_stairs(self, joint):
        return floor(self.position() / self.tuned("d", 0.2, 0.6)) * -self.uniform(0.5, 2.0)

    def contact(self, joint):
        return largest(0.0, signal(joint + "/position") - self.tuned("x", -0.2, 0.4)) * -self.tuned("k", 20.0, 200.0)

    def brake(self, joint):
        return largest(0.0, signal(joint + "/velocity") - self.tuned("v", 0.0, 1.0)) * -self.tuned("c", 0.5, 4.0)

    def friction(self, joint):
        """Less than what drives, most of the time."""
        return sign(signal(joint + "/velocity")) * -self.tuned("f", 0.1, 0.4)

    def drag(self, joint):
        v = signal(joint + "/velocity")
        return v * magnitude(v) * -self.tuned("c", 0.2, 1.0)

    def surface(self, joint):
        return choose(self.position() + self.velocity() * self.tuned("b", 0.05, 0.4), self.tuned("x", -0.4, 0.4), self.force(), self.force())

    def clipped(self, joint):
        demand = (formula(self.tuned("r", -0.5, 0.5)) - signal(joint + "/position")) * self.tuned("k", 10.0, 40.0) - signal(joint + "/velocity") * 2.0
        bound = self.tuned("u", 1.0, 3.0)
        return least(bound, largest(-formula(bound), demand))

    def nested(self, joint):
        """A guard that depends on a quantity that jumps itself."""
        inner = choose(TIME, self.instant(), self.position(), self.velocity())
        return choose(inner, self.tuned("x", -0.4, 0.6), self.force(), self.force())

    def of_both(self, joint):
        a = choose(TIME, self.instant(), self.force(), self.force())
        return a * choose(self.position(), self.tuned("x", -0.4, 0.4), 0.5, 1.5)

    def pulse_by_position(self, joint):
        return choose(magnitude(self.position() - self.tuned("x", -0.3, 0.5)), self.tuned("w", 0.02, 0.2), 3.0 * self.force(), 0.0)

    def table(self, joint):
        at = np.cumsum([self.uniform(-0.8, -0.2)] + [self.uniform(0.15, 0.5) for _ in range(3)])
        return table(self.joint() + self.pick(["/position", "/velocity"]), [round(x, 3) for x in at], [self.tuned("y", -3.0, 3.0) for _ in at],
                     self.pick(["linear", "cubic"]))

    LOADS = [time_jump, time_pulse, time_kink, waves, stairs, position_jump, position_stairs, contact, brake, friction, drag, surface, clipped, nested, of_both,
             pulse_by_position, table]

    # ---- parts of the study

    def add_load(self):
        maker, joint = self.pick(self.LOADS), self.joint()
        self.kinds.append(maker.__name__)
        self.study.loads.append((joint, maker(self, joint)))

    def add_stop(self):
        joint, name = self.joint(), "stop"
        if joint in self.study.stops:
            return
        self.kinds.append("stop")
        self.study.of_model[name], self.study.ranges[name] = self.uniform(0.15, 0.6), (0.05, 1.0)
        self.study.stops[joint] = (f"-{name}", name)
        self.study.limits.update(stiffness=self.uniform(500, 5000), dissipation=self.uniform(0, 1), width=self.pick([1e-3, 1e-2]))

    def add_pid(self):
        joint, name = self.joint(), f"pid{len(self.study.controllers)}"
        gains = {"p": formula(self.tuned("p", 5.0, 20.0)), "d": formula(self.tuned("q", 0.5, 3.0))}
        if self.chance(0.5):
            gains["i"] = formula(self.tuned("i", 0.5, 5.0))
        sampled = self.chance(0.3)
        self.kinds.append("sampled_pid" if sampled else "pid")
        setpoint = choose(TIME, self.instant(), self.uniform(-0.5, 0.5), self.tuned("r", -0.5, 0.5))
        if self.chance(0.3):
            self.kinds.append("waypoints")
            times = [round(share * self.study.duration, 3) for share in (0.1, 0.4, 0.7)]
            setpoint = waypoints(times, [self.uniform(-0.3, 0.3), self.tuned("r", -0.5, 0.5), self.tuned("r", -0.5, 0.5)])
        limit = self.uniform(3.0, 10.0) if self.chance(0.4) else 0.0
        self.study.controllers.append(Pid(name, joint, setpoint, gains, limit, self.pick([0.02, 0.05, 0.1]) if sampled else 0.0))
        if self.chance(0.3):
            self.study.limits["effort"][joint] = self.uniform(3.0, 8.0)

    def add_gear(self):
        """With a controller that drives it, and a short run, since flanks meet often."""
        controllers = self.study.controllers
        # The rotor of an elbow turns with the upper arm, which the closed form does not have.
        if not controllers or controllers[0].sample_time or controllers[0].joint == "elbow":
            return
        self.kinds.append("gear")
        joint = controllers[0].joint
        self.study.of_model.update(gear=self.uniform(300.0, 2000.0), play=self.uniform(0.005, 0.05))
        self.study.ranges.update(gear=(100.0, 5000.0), play=(0.001, 0.1))
        self.study.gears.append(Gear(joint, 10.0, self.uniform(0.001, 0.005), "gear", self.uniform(0.5, 3.0), "play"))
        self.study.duration = min(self.study.duration, 0.6)

    def windowed(self, term, signals):
        kind = self.dice.integers(6)
        if kind == 0:
            return choose(self.instant(), TIME, term, 0.0)
        if kind == 1:
            return choose(self.position(), self.tuned("x", -0.3, 0.3), term, 0.0)
        if kind == 2:
            return largest(term, self.uniform(-0.2, 0.2))
        if kind == 3:
            return choose(signal(self.pick(signals)), self.tuned("z", -0.3, 0.3), term, 0.0)
        return term

    def add_objective(self):
        signals = [joint + quantity for joint in self.study.mechanism.joints for quantity in ("/position", "/velocity", "/acceleration")]
        for controller in self.study.controllers:
            signals += [controller.joint + "/effort"] + [controller.name + "/error"] * (controller.sample_time == 0.0)
            signals += [controller.name + "/integral"] * (controller.sample_time == 0.0 and "i" in controller.gains)
        for _ in range(self.dice.integers(1, 4)):
            name = self.pick(signals)
            weight = {"acceleration": 0.02, "effort": 0.05}.get(name.split("/")[1], 1.0)
            self.study.integral.append((self.windowed(signal(name), signals), self.uniform(-0.5, 0.5), weight))
        for _ in range(self.dice.integers(0, 3)):
            name = self.pick(self.study.mechanism.joints) + self.pick(["/position", "/velocity"])
            self.study.terminal.append((signal(name) if self.chance(0.7) else square(signal(name)), self.uniform(-0.5, 0.5), self.uniform(0.5, 2.0)))

    def make(self):
        study = self.study
        for joint in study.mechanism.joints:
            study.initial[joint] = (formula(self.tuned("a", -0.3, 0.3)) if self.chance(0.3) else number(self.pick([0.0, self.uniform(-0.3, 0.3)])),
                                    formula(self.tuned("b", -1.0, 1.0)) if self.chance(0.3) else number(self.pick([0.0, self.uniform(-1.0, 1.0)])))
            if self.chance(0.3):
                study.dampers[joint] = self.uniform(0.05, 0.5)
        for _ in range(self.dice.integers(1, 4)):
            self.pick([self.add_load, self.add_load, self.add_load, self.add_stop, self.add_pid])()
        if self.chance(0.4):
            self.add_gear()
        self.add_objective()
        method = self.pick(["auto", "dopri5", "rodas5p", "rodas4"]) if not study.gears and not study.stops else self.pick(["auto", "rodas5p"])
        coordinates = self.pick(["auto", "absolute"])
        # Some sampled controllers are unstable; their motions are compared all the same.
        study.solver = f"{{method: {method}, coordinates: {coordinates}, relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11, maximum_speed: 1.0e+9}}"
        return study
