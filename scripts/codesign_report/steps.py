# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Step responses of a linearization, exact at the drawn instants: x' = A x + B u, or x(k+1) = A x(k) + B u(k) with a period."""
import collections
import math
import operator

from .matrices import held, powered

POINTS = 600  # of a continuous response
MOST_PERIODS = 2000  # of a sampled one
BAND = 0.02  # about the final value, relative to it

# final, overshoot and settling [s] are None where the response has none: an unstable motion, or one that ends at zero.
Step = collections.namedtuple("Step", "times values interval final overshoot settling")


def horizon(modes, is_stable):
    """How long a response is followed at first [s]: 30 time constants of the slowest motion that decays, or 5 of the fastest one that grows.

    Without a stable verdict a small growth may be what rounding leaves of zero: of a double pole its square root."""
    growths = [mode["growth"] for mode in modes if mode["growth"] is not None]
    turns = [mode["frequency"] for mode in modes if mode["frequency"]]
    zero = (1e-13 if is_stable else 1e-6) * max([abs(g) for g in growths] + turns, default=1.0)
    growing, decaying = [g for g in growths if g > zero], [-g for g in growths if g < -zero]
    if growing:
        return 5.0 / max(growing)
    if decaying:
        return (30.0 if is_stable else 8.0) / min(decaying)
    return 6.0 / min((f for f in turns if f > zero), default=6.0)


def settled_at(values, final):
    """The index from which on values stay in the band about the final one."""
    most = max(map(abs, values))
    band = BAND * (abs(final) if abs(final) > 1e-6 * most else most)
    return next((k + 1 for k in range(len(values) - 1, -1, -1) if abs(values[k] - final) > band), 0)


class System:
    """A linearization that is followed over several spans of time, which its motions share."""

    def __init__(self, model):
        self.model, self.period, self.is_stable = model, model.get("period"), model["stability"] == "stable"
        self.span = horizon(model["modes"], self.is_stable)
        self.known = {}

    def advance(self, span):
        """(interval, number of intervals, Phi, Gamma). Of many periods each second, third, ... is an interval."""
        if span not in self.known:
            A, B = self.model["A"], self.model["B"]
            if self.period:
                periods = max(10, math.ceil(span / self.period))
                stride = math.ceil(periods / MOST_PERIODS)
                self.known[span] = stride * self.period, math.ceil(periods / stride), *powered(A, B, stride)
            else:
                self.known[span] = span / POINTS, POINTS, *held(A, B, span / POINTS)
        return self.known[span]


class Motion:
    """The states after a unit step of an input.

    The rate of a set-point that steps is an impulse, its acceleration the derivative of one: both leave the state B_rate + A B_acceleration
    at 0+. A sampled law reads rates at instants at which they are zero."""

    def __init__(self, system, name):
        self.system, model = system, system.model
        self.place = model["inputs"].index(name)
        columns, none = dict(zip(model["inputs"], zip(*model["B"]))), [0.0] * len(model["A"])
        rate, acceleration = (none if system.period else columns.get(name + what, none) for what in ("_rate", "_acceleration"))
        self.start = [r + sum(map(operator.mul, row, acceleration)) for r, row in zip(rate, model["A"])]
        self.known = {}

    def states(self, span):
        """(interval, states at its multiples), which several outputs share."""
        if span not in self.known:
            interval, count, Phi, Gamma = self.system.advance(span)
            x, found, gains = self.start, [], [row[self.place] for row in Gamma]
            for _ in range(count + 1):
                found.append(x)
                x = [sum(map(operator.mul, row, x)) + gain for row, gain in zip(Phi, gains)]
            self.known[span] = interval, found
        return self.known[span]


def peak(values, is_smooth):
    """The largest value; of a smooth curve that of the parabola through it and its neighbours."""
    k = max(range(len(values)), key=values.__getitem__)
    if not is_smooth or not 0 < k < len(values) - 1:
        return values[k]
    before, here, after = values[k - 1:k + 2]
    bend = 2.0 * here - before - after
    return here + (after - before) ** 2 / (8.0 * bend) if bend > 0.0 else here


def response(motion, c, d):
    """c x + D u, of a stable motion over as long as it takes to settle and about as long again. @param d one number per input."""
    final, span = None, motion.system.span
    for _ in range(24):
        interval, states = motion.states(span)
        values = [sum(map(operator.mul, c, x)) + d[motion.place] for x in states]
        if not motion.system.is_stable:
            break
        final = values[-1] if final is None else final
        settled = settled_at(values, final) / (len(values) - 1)
        if settled > 0.35 or settled == 0.0:
            break
        span *= 2.0 ** (0.5 * math.ceil(2.0 * math.log2(max(2.0 * settled, 0.02))))  # few different spans, which outputs share
    times = [interval * k for k in range(len(values))]
    if final is None or abs(final) <= 1e-6 * max(map(abs, values)):
        return Step(times, values, interval, None if final is None else 0.0, None, None)
    overshoot = max(0.0, peak([value / final for value in values], not motion.system.period) - 1.0)
    return Step(times, values, interval, final, overshoot, times[min(len(times) - 1, settled_at(values, final))])
