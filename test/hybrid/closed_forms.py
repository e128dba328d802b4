# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Motions that rest, switch, pulse or end by themselves, small enough for a formula of their objective. The formulas take complex numbers, so that a complex step gives
their derivatives; where the motion is not linear, scipy integrates it with steps far below what happens in it."""
import cmath
import dataclasses
import re
import typing

import numpy as np
from scipy.integrate import solve_ivp

FIXED = {"k": (1, 0.01, 100), "b": (0.1, 0.01, 10)}  # parameters of models that a study does not tune


@dataclasses.dataclass
class ClosedForm:
    """@param name what switches or rests; @param links of the model, each on the one before: (link, joint, type, axis, inertial, more of the joint);
    @param study its text without `parameters` and `solver`; @param numbers tuned parameter -> (value, lower, upper); @param objective(**numbers) of complex numbers;
    @param without the ways that refuse the study"""
    name: str
    links: list
    study: str
    numbers: dict
    objective: typing.Callable
    without: tuple = ()

    def model_numbers(self):
        """Parameters that the links name, tuned or not."""
        used = set(re.findall(r"\$\{-?(\w+)\}", "".join(mass + more for *_, mass, more in self.links)))
        return {name: self.numbers.get(name, FIXED.get(name)) for name in sorted(used)}

    def model_text(self):
        text = '<robot name="closed_form" xmlns:codesign="urn:mechanism_codesign">\n'
        for name, (value, lower, upper) in self.model_numbers().items():
            text += f'  <codesign:parameter name="{name}" value="{value}" lower="{lower}" upper="{upper}"/>\n'
        text += '  <link name="ground"/>\n'
        parent = "ground"
        for link, joint, kind, axis, mass, more in self.links:
            limit = "" if kind == "continuous" else '<limit lower="-1e4" upper="1e4" effort="1e4" velocity="1e4"/>'
            text += (f'  <link name="{link}">{mass}</link>\n  <joint name="{joint}" type="{kind}"><parent link="{parent}"/><child link="{link}"/>'
                     f'<axis xyz="{axis}"/>{limit}{more}</joint>\n')
            parent = link
        return text + "</robot>\n"

    def study_text(self, solver):
        own = ", ".join(f"{name}: {{}}" if name in self.model_numbers() else f"{name}: {{initial: {value}, lower: {lower}, upper: {upper}}}"
                        for name, (value, lower, upper) in self.numbers.items())
        return f"{self.study.strip()}\nparameters: {{{own}}}\n" + (f"solver: {{{solver}}}\n" if solver else "")

    def expected(self):
        """(objective, {parameter: derivative}) by complex steps"""
        values = {name: complex(number[0]) for name, number in self.numbers.items()}
        step = 1e-30
        gradient = {name: self.objective(**{**values, name: values[name] + step * 1j}).imag / step for name in values}
        return self.objective(**values).real, gradient


def body(mass="1", moment="0.01", place="0 0 0", also=""):
    return (f'<inertial><origin xyz="{place}"{also}/><mass value="{mass}"/>'
            f'<inertia ixx="{moment}" ixy="0" ixz="0" iyy="{moment}" iyz="0" izz="{moment}"/></inertial>')


SLIDE = [("body", "slide", "prismatic", "1 0 0", body(), "")]
SPRING = [("body", "slide", "prismatic", "1 0 0", body(),
           '<codesign:torsion_spring stiffness="1" codesign:stiffness="${k}" damping="0.1" codesign:damping="${b}"/>')]
BALL = [("carriage", "rise", "prismatic", "0 0 1", body(), ""), ("ball", "run", "prismatic", "1 0 0", body(), "")]
CRANK = [("wheel", "crank", "continuous", "0 0 1", body("10", "5").replace('izz="5"', 'izz="5" codesign:izz="${J}"'), "")]
ARM = [("arm", "pivot", "continuous", "0 1 0", body(moment="0.84", place="0 0 -0.4"), "")]  # its moment about the pivot is 1
ROD = [("rod", "pivot", "continuous", "0 1 0", body(place="0 0 -0.4", also=' codesign:xyz="0 0 ${-arm}"'), "")]


def damped(stiffness, damping, position, velocity, time):
    """x'' = -stiffness x - damping x': x and x' at a time"""
    w = cmath.sqrt(stiffness - damping * damping / 4.0)
    decay, c, s = cmath.exp(-damping * time / 2.0), cmath.cos(w * time), cmath.sin(w * time) / w
    a = velocity + damping * position / 2.0
    return decay * (position * c + a * s), decay * (velocity * c - (stiffness * position + damping * velocity / 2.0) * s)


def integral(function, begin, end, pieces=1):
    """by Gauss's formula of 20 points on each piece"""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    length = (end - begin) / pieces
    return sum(length / 2.0 * weight * function(begin + length * (piece + (1.0 + node) / 2.0)) for piece in range(pieces) for node, weight in zip(nodes, weights))


def integrated(acceleration, position, velocity, duration, step):
    """x'' = acceleration(x, x'): x and x' at the end. The imaginary parts follow the steps of the real ones, which are short enough for them."""
    run = solve_ivp(lambda t, y: [y[1], acceleration(y[0], y[1])], (0.0, duration), [complex(position), complex(velocity)], method="DOP853", rtol=1e-13, atol=1e-15,
                    max_step=step)
    return run.y[0, -1], run.y[1, -1]


def after(position, velocity, parts):
    """x after parts of constant acceleration, each (acceleration, time)"""
    for acceleration, time in parts:
        position, velocity = position + velocity * time + acceleration * time * time / 2.0, velocity + acceleration * time
    return position


def band_of_positions(d):
    first = cmath.sqrt(1.0 + 2.0 * (0.5 - d))
    second = cmath.sqrt(first * first - 4.0 * d)
    return after(0.5 + d, second, [(1.0, 2.0 - (first - 1.0) - (first - second))]) ** 2


def steps_of_a_period(T):
    return sum((2.0 - k * T) ** 2 / 2.0 for k in range(1, int(2.0 / T.real) + 1)) ** 2


def square_wave(w):
    turns = [k * cmath.pi / w for k in range(1, int(3.0 * w.real / cmath.pi) + 1)]
    return (4.5 + sum((-1) ** (k + 1) * (3.0 - turn) ** 2 for k, turn in enumerate(turns))) ** 2


def kink_at_zero(x0, v0):
    tau = cmath.atan(-x0 / v0)
    return (damped(1.0, 0.0, x0, v0, tau)[1] * cmath.sinh(1.0 - tau)) ** 2


def behind_a_gap(k, gap, v0, duration):
    touch, w = gap / v0, cmath.sqrt(k)
    leave = touch + cmath.pi / w
    if duration < leave.real:
        return (gap + v0 / w * cmath.sin(w * (duration - touch))) ** 2
    return (gap - v0 * (duration - leave)) ** 2


def moved_set_point(ts, p, b):
    x, v = damped(p + 1.0, b, -0.2 * p / (p + 1.0), 0.0, ts)
    return (damped(p + 1.0, b, x - 0.8 * p / (p + 1.0), v, 2.0 - ts)[0] + p / (p + 1.0) - 0.5) ** 2


def pulse_by_angle(J, motor):
    return integrated(lambda x, v: (motor - 500.0 * cmath.exp(20.0 * (cmath.cos(x - cmath.pi) - 1.0))) / J, 0.0, 10.0, 1.2, 1e-3)[1] ** 2


def pulse_from_rest(A):
    return (A * integral(lambda t: cmath.exp(-((t - 7.131) / 0.003) ** 2) * damped(1.0, 0.1, 0.0, 1.0, 10.0 - t)[0], 7.101, 7.161, 40) - 0.5) ** 2


def huber_sides(a, v0, c):
    """of x - a for 2 s along x = v0 t, which passes both a - c and a + c"""
    return sum(c * (u * u - c * c) - c * c * (u - c) + c ** 3 / 3.0 for u in (a, 2.0 * v0 - a)) / v0


def way_of_oscillator(k, b):
    """the integral of |x'| for 7 s from x = 1 at rest"""
    half = cmath.pi / cmath.sqrt(k - b * b / 4.0)
    places = [damped(k, b, 1.0, 0.0, turn * half)[0] for turn in range(int(7.0 / half.real) + 1)] + [damped(k, b, 1.0, 0.0, 7.0)[0]]
    return sum((-1) ** n * (one - other) for n, (one, other) in enumerate(zip(places, places[1:])))


def soft_bounds(F, high, low):
    """x = F t^2/2 for 2 s: the square of what is above, and three times that of what is below"""
    beyond = [integral(lambda t, edge=edge: (F * t * t / 2.0 - edge) ** 2, *times) for edge, times in
              ((high, (cmath.sqrt(2.0 * high / F), 2.0)), (low, (0.0, cmath.sqrt(2.0 * low / F))))]
    return beyond[0] + 3.0 * beyond[1] + (2.0 * F - high) ** 2


def held_pendulum(goal, arm):
    return (integrated(lambda x, v: (20.0 * (goal - x) - 2.0 * v - 9.81 * arm * cmath.sin(x)) / (arm * arm + 0.01), 0.0, 0.0, 3.0, 1e-2)[0] - 0.5) ** 2


def leaves_a_step(x0, d, k, F, duration=1.5):
    """-k n - F on the n-th step down, the first from the first instant on"""
    first, then = -k - F, -2.0 * k - F
    time = cmath.sqrt(-2.0 * d / first)
    return after(x0, 0.0, [(first, time), (then, duration - time)]) ** 2


def kick(effort):
    """a study of one slide under a load for 2 s, its position at the end squared"""
    return f'duration: 2\nloads: [{{joint: slide, effort: "${{{effort}}}"}}]\nobjective: {{terminal: [{{signal: slide/position}}]}}'


def moving(effort, start, duration=2):
    """the same from another state"""
    return kick(effort).replace("duration: 2", f"duration: {duration}\ninitial_state: {{slide: {start}}}")


AT_TIMES = [
    ClosedForm("a load turns round at a tuned time", SLIDE, kick("t < ts ? F : -1"), {"ts": (0.7, 0.1, 1.9), "F": (1.5, 0.5, 3)},
               lambda ts, F: after(0.0, 0.0, [(F, ts), (-1.0, 2.0 - ts)]) ** 2),
    ClosedForm("a load within a window of time", SLIDE, kick("t > a and t < b ? 1 : 0"), {"a": (0.3, 0, 1), "b": (1.1, 0, 2)},
               lambda a, b: after(0.0, 0.0, [(1.0, b - a), (0.0, 2.0 - b)]) ** 2),
    ClosedForm("steps of a tuned period", SLIDE, kick("floor(t/T)"), {"T": (0.37, 0.1, 1.9)}, steps_of_a_period),
    ClosedForm("a square wave of a tuned frequency", SLIDE, kick("sign(sin(w*t))").replace("duration: 2", "duration: 3"), {"w": (5, 1, 10)}, square_wave),
    ClosedForm("a ramp that saturates", SLIDE, kick("min(1, k*t)"), {"k": (1.3, 0.6, 10)},
               lambda k: after(1.0 / (6.0 * k * k), 1.0 / (2.0 * k), [(1.0, 2.0 - 1.0 / k)]) ** 2),
    ClosedForm("a set-point jumps at a tuned time", SPRING, """
duration: 2
controllers: {servo: {type: pid, input: slide/position, output: slide, setpoint: "${t < ts ? 0.2 : 1}", gains: {p: "${p}"}}}
objective: {terminal: [{signal: slide/position, reference: 0.5}]}""", {"ts": (0.8, 0.1, 1.9), "p": (3, 1, 10), "b": (0.1, 0.01, 10)}, moved_set_point),
    ClosedForm("an integrand jumps at a tuned time", SLIDE, """
duration: 2
loads: [{joint: slide, effort: 1}]
objective: {integral: [{signal: slide/position, reference: "${t < ts ? 1 : 0}"}]}""", {"ts": (0.7, 0.1, 1.9)},
               lambda ts: integral(lambda t: (t * t / 2.0 - 1.0) ** 2, 0.0, ts) + integral(lambda t: t ** 4 / 4.0, ts, 2.0)),
]
AT_STATES = [
    ClosedForm("a load begins at a position", SLIDE, moving("slide/position > xs ? -F : 0", '{velocity: "${v0}"}'),
               {"xs": (0.7, 0.1, 1.5), "v0": (1.1, 0.5, 2), "F": (0.6, 0, 1)}, lambda xs, v0, F: after(xs, v0, [(-F, 2.0 - xs / v0)]) ** 2),
    ClosedForm("a load falls at a speed", SLIDE, kick("slide/velocity < vs ? 1 : 0.2"), {"vs": (0.9, 0.1, 1.9)},
               lambda vs: after(0.0, 0.0, [(1.0, vs), (0.2, 2.0 - vs)]) ** 2),
    ClosedForm("a band of positions", SLIDE, moving("abs(slide/position - 0.5) < d ? -1 : 1", "{velocity: 1}"), {"d": (0.2, 0.01, 0.4)}, band_of_positions),
    ClosedForm("a kink at a position", SLIDE, moving("-abs(slide/position)", '{position: "${x0}", velocity: "${v0}"}', 1), {"x0": (0.5, 0.1, 1.9), "v0": (-1, -3, -0.1)},
               kink_at_zero),
    ClosedForm("a spring behind a gap", SLIDE, moving("-k*max(0, slide/position - gap)", '{velocity: "${v0}"}', 0.8),
               {"k": (10, 1, 1000), "gap": (0.3, 0.1, 1), "v0": (1, 0.1, 3)}, lambda **numbers: behind_a_gap(duration=0.8, **numbers)),
    ClosedForm("a bounce on a stiff spring behind a gap", SLIDE, moving("-k*max(0, slide/position - gap)", '{velocity: "${v0}"}', 1),
               {"k": (1e6, 1e5, 1e7), "gap": (0.3, 0.1, 1), "v0": (1, 0.1, 3)}, lambda **numbers: behind_a_gap(duration=1.0, **numbers)),
    ClosedForm("a start at rest at a step of the load", SLIDE, moving("k*floor((slide/position - x0)/d) - F", '{position: "${x0}"}', 1.5),
               {"x0": (0.3, 0, 1), "d": (0.25, 0.2, 0.3), "k": (-1, -2, -0.5), "F": (1.5, 1, 2)}, leaves_a_step),
    ClosedForm("the same of a hinge", ARM, """
duration: 1.5
gravity: [0, 0, 0]
initial_state: {pivot: {position: "${x0}"}}
loads: [{joint: pivot, effort: "${k*floor((pivot/position - x0)/d) - F}"}]
objective: {terminal: [{signal: pivot/position}]}""", {"x0": (0.3, 0, 1), "d": (0.25, 0.2, 0.3), "k": (-1, -2, -0.5), "F": (1.5, 1, 2)}, leaves_a_step),
    ClosedForm("a step of the load where a motion begins at a tuned time", SLIDE,
               moving("t < ts ? 0 : k*floor((slide/position - x0)/d) - F", '{position: "${x0}"}', 1.8),
               {"ts": (0.3, 0.1, 0.5), "x0": (0.3, 0, 1), "d": (0.25, 0.2, 0.3), "k": (-1, -2, -0.5), "F": (1.5, 1, 2)},
               lambda ts, **numbers: leaves_a_step(duration=1.8 - ts, **numbers)),
    ClosedForm("dry friction that a force overcomes", SLIDE, moving("-c*sign(slide/velocity) - F", '{velocity: "${v0}"}'),
               {"c": (0.5, 0, 0.9), "F": (1, 0.95, 2), "v0": (1, 0.1, 3)},
               lambda c, F, v0: after(0.0, v0, [(-F - c, v0 / (F + c)), (-F + c, 2.0 - v0 / (F + c))]) ** 2),
    ClosedForm("a load on one joint by the position of another", BALL, """
duration: 2
gravity: [0, 0, 0]
initial_state: {run: {velocity: "${speed}"}}
loads: [{joint: rise, effort: "${run/position > xs ? F : 0}"}]
objective: {terminal: [{signal: rise/position}]}""", {"xs": (0.7, 0.1, 1.5), "F": (3, 1, 5), "speed": (1.2, 1, 2)},
               lambda xs, F, speed: after(0.0, 0.0, [(F / 2.0, 2.0 - xs / speed)]) ** 2),
]
EXTREMES = [
    ClosedForm("the largest velocity, where its load turns round", SLIDE, kick("t < ts ? F : -1").replace("terminal", "maximum").replace("position", "velocity"),
               {"ts": (0.7, 0.1, 1.9), "F": (1.5, 0.5, 3)}, lambda ts, F: F * ts, ("adjoint",)),
    ClosedForm("the largest acceleration, before it jumps", SLIDE, kick("t < ts ? F*t : -1").replace("terminal", "maximum").replace("position", "acceleration"),
               {"ts": (0.7, 0.1, 1.9), "F": (1.5, 0.5, 3)}, lambda ts, F: F * ts, ("adjoint",)),
    ClosedForm("the largest position, where a wall of springs begins", SLIDE, moving("-k*max(0, slide/position - gap)", '{velocity: "${v0}"}').replace("terminal", "maximum"),
               {"k": (1e4, 1e3, 1e5), "gap": (0.3, 0.1, 1), "v0": (1, 0.1, 3)}, lambda k, gap, v0: gap + v0 / cmath.sqrt(k), ("adjoint",)),
]
PULSES = [
    ClosedForm("a pulse of a tuned time and width", SLIDE, kick("100*exp(-((t - place)/width)**2)").replace("duration: 2", "duration: 5"),
               {"place": (1.7131, 0.1, 4), "width": (0.002, 0.001, 0.1)}, lambda place, width: (100.0 * width * cmath.sqrt(cmath.pi) * (5.0 - place)) ** 2),
    ClosedForm("a pulse by the angle of a crank", CRANK, """
duration: 1.2
initial_state: {crank: {velocity: 10}}
loads: [{joint: crank, effort: "${motor - 500*exp(20*(cos(crank/position - pi) - 1))}"}]
objective: {terminal: [{signal: crank/velocity}]}""", {"J": (5, 0.5, 100), "motor": (44.89, 10, 100)}, pulse_by_angle),
]
AT_REST = [
    ClosedForm("a pulse of no height, from rest", SPRING, """
duration: 10
loads: [{joint: slide, effort: "${A*exp(-((t - 7.131)/0.003)**2)}"}]
objective: {terminal: [{signal: slide/position, reference: 0.5}]}""", {"A": (0, -2000, 2000)}, pulse_from_rest),
    ClosedForm("an oscillator at rest, by its start", SPRING, """
duration: 50
initial_state: {slide: {position: "${x0}"}}
objective: {terminal: [{signal: slide/position, reference: -1}]}""", {"x0": (0, -2, 2), "k": (1, 0.01, 100), "b": (0.1, 0.01, 10)},
               lambda x0, k, b: (damped(k, b, x0, 0.0, 50.0)[0] + 1.0) ** 2),
    ClosedForm("a pendulum held at rest, by its set-point", ROD, """
duration: 3
controllers: {servo: {type: pid, input: pivot/position, setpoint: "${goal}", output: pivot, gains: {p: 20, d: 2}}}
objective: {terminal: [{signal: pivot/position, reference: 0.5}]}""", {"goal": (0, -2, 2), "arm": (0.4, 0.2, 0.8)}, held_pendulum),
    ClosedForm("a power of a negative base", SLIDE, """
duration: 0.1
objective: {terminal: [{signal: slide/position, reference: "${b**(1+2)}"}]}""", {"b": (-2, -3, -1)}, lambda b: b ** 6),
]
ENDS = [
    ClosedForm("a duration and a switching time are tuned", SLIDE, """
duration: "${T}"
loads: [{joint: slide, effort: "${t < ts ? 1 : -1}"}]
objective: {terminal: [{signal: slide/position}, {signal: slide/velocity, weight: 2}, {signal: end_time}]}""", {"ts": (0.9, 0.1, 3), "T": (2.1, 0.5, 4)},
               lambda ts, T: after(0.0, 0.0, [(1.0, ts), (-1.0, T - ts)]) ** 2 + 2.0 * (2.0 * ts - T) ** 2 + T ** 2),
    ClosedForm("a duration is tuned, with an integral", SLIDE, """
duration: "${T}"
initial_state: {slide: {velocity: 1}}
objective: {integral: [{signal: slide/position, reference: 1}], terminal: [{signal: slide/position, reference: 3, weight: 2}]}""", {"T": (1.5, 0.5, 4)},
               lambda T: ((T - 1.0) ** 3 + 1.0) / 3.0 + 2.0 * (T - 3.0) ** 2),
    ClosedForm("a throw ends at the ground", BALL, """
duration: 3
until: "${rise/position < 0}"
initial_state: {run: {velocity: "${s*cos(phi)}"}, rise: {velocity: "${s*sin(phi)}"}}
objective: {terminal: [{signal: run/position}]}""", {"s": (5, 1, 9), "phi": (0.6, 0.1, 1.5)}, lambda s, phi: (s * s * cmath.sin(2.0 * phi) / 9.81) ** 2),
    ClosedForm("a brake ends at standstill", SLIDE, """
duration: 5
until: "${slide/velocity <= 0}"
initial_state: {slide: {velocity: 3}}
loads: [{joint: slide, effort: "${-F}"}]
objective: {terminal: [{signal: slide/position}], integral: [{signal: slide/velocity}]}""", {"F": (4, 1, 9)}, lambda F: (4.5 / F) ** 2 + 9.0 / F),
]
ALONG = 'duration: 2\ninitial_state: {slide: {velocity: "${v0}"}}\nobjective: {integral: [{signal: slide/position, reference: "${a}", loss: LOSS}]}'
LOSSES = [
    ClosedForm("the distance from a place", SLIDE, ALONG.replace("LOSS", "absolute"), {"a": (0.7, 0.1, 1.5), "v0": (1.1, 0.5, 2)},
               lambda a, v0: (a * a + (2.0 * v0 - a) ** 2) / (2.0 * v0)),
    ClosedForm("the way of an oscillator", SPRING, """
duration: 7
initial_state: {slide: {position: 1}}
objective: {integral: [{signal: slide/velocity, loss: absolute}]}""", {"k": (1, 0.5, 100), "b": (0.1, 0.01, 10)}, way_of_oscillator),
    ClosedForm("a Huber loss beyond its scale", SLIDE, ALONG.replace("LOSS", 'huber, scale: "${c}"'), {"a": (0.9, 0.1, 1.5), "v0": (1.2, 0.5, 2), "c": (0.3, 0.1, 1)}, huber_sides),
    ClosedForm("a soft L1 loss", SLIDE, ALONG.replace("LOSS", 'soft_l1, scale: "${c}"'), {"a": (0.9, 0.1, 1.5), "v0": (1.2, 0.5, 2), "c": (0.3, 0.1, 1)},
               lambda a, v0, c: integral(lambda t: 2.0 * c * c * (cmath.sqrt(1.0 + ((v0 * t - a) / c) ** 2) - 1.0), 0.0, 2.0, 20)),
    ClosedForm("soft bounds that a position passes", SLIDE, """
duration: 2
loads: [{joint: slide, effort: "${F}"}]
objective:
  integral: [{signal: slide/position, reference: "${high}", loss: above}, {signal: slide/position, reference: "${low}", loss: below, weight: 3}]
  terminal: [{signal: slide/position, reference: "${high}", loss: above}, {signal: slide/position, reference: "${low}", loss: below}]""",
               {"F": (1.3, 0.5, 3), "high": (1.1, 0.5, 2), "low": (0.6, 0.1, 1)}, soft_bounds),
    ClosedForm("losses of the end", SLIDE, """
duration: 2
loads: [{joint: slide, effort: "${F}"}]
objective:
  terminal: [{signal: slide/position, reference: "${u}", loss: absolute}, {signal: slide/velocity, reference: 2, loss: huber, scale: "${c}", weight: 2}]""",
               {"F": (1.3, 0.5, 3), "u": (1.1, 0.5, 2), "c": (0.4, 0.1, 0.5)}, lambda F, u, c: 2.0 * F - u + 2.0 * c * (2.0 * (2.0 * F - 2.0) - c)),
]
CASES = AT_TIMES + AT_STATES + EXTREMES + PULSES + AT_REST + ENDS + LOSSES
