# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Step responses of a linearization, exact at the drawn instants: x' = A x + B u, or x(k+1) = A x(k) + B u(k) with a period."""
import collections
import math
import operator

POINTS = 600  # of a continuous response
MOST_PERIODS = 2000  # of a sampled one
BAND = 0.02  # about the final value, relative to it

# final, overshoot and settling [s] are None where the response has none: an unstable motion, or one that ends at zero.
Step = collections.namedtuple("Step", "times values interval final overshoot settling")


def product(left, right):
    """The product of two matrices, lists of rows."""
    columns = list(zip(*right))
    return [[sum(map(operator.mul, row, column)) for column in columns] for row in left]


def exponential(matrix):
    """exp(matrix) by scaling, the Taylor series to the 18th power, and squaring."""
    size = max(sum(map(abs, row)) for row in matrix)
    halvings = max(0, math.ceil(math.log2(size / 0.5))) if size > 0.0 else 0
    scaled = [[value / 2.0 ** halvings for value in row] for row in matrix]
    identity = [[float(i == j) for j in range(len(matrix))] for i in range(len(matrix))]
    result = identity
    for power in range(18, 0, -1):  # Horner: 1 + M/1 (1 + M/2 (1 + ...))
        result = product(scaled, [[value / power for value in row] for row in result])
        result = [[value + one for value, one in zip(row, ones)] for row, ones in zip(result, identity)]
    for _ in range(halvings):
        result = product(result, result)
    return result


def held(A, b, interval):
    """(Phi, gamma) of x(t + interval) = Phi x(t) + gamma u with a constant u: the exponential of [[A, b], [0, 0]]."""
    whole = exponential([[interval * value for value in (*row, last)] for row, last in zip(A, b)] + [[0.0] * (len(b) + 1)])
    return [row[:-1] for row in whole[:-1]], [row[-1] for row in whole[:-1]]


def powered(A, b, count):
    """(Phi, gamma) of x(k + count) = Phi x(k) + gamma u with a constant u: a power of [[A, b], [0, 1]] by squaring."""
    factor = [[*row, last] for row, last in zip(A, b)] + [[0.0] * len(b) + [1.0]]
    whole = None
    while count:
        if count % 2:
            whole = factor if whole is None else product(whole, factor)
        count //= 2
        factor = product(factor, factor) if count else factor
    return [row[:-1] for row in whole[:-1]], [row[-1] for row in whole[:-1]]


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


class Motion:
    """The states after a unit step of an input.

    The rate of a set-point that steps is an impulse, its acceleration the derivative of one: both leave the state B_rate + A B_acceleration
    at 0+. A sampled law reads rates at instants at which they are zero."""

    def __init__(self, model, name):
        self.A, self.period, self.is_stable = model["A"], model.get("period"), model["stability"] == "stable"
        columns = dict(zip(model["inputs"], zip(*model["B"])))
        none = [0.0] * len(self.A)
        self.b, self.place = columns.get(name, none), model["inputs"].index(name)
        rate, acceleration = (none if self.period else columns.get(name + what, none) for what in ("_rate", "_acceleration"))
        self.start = [r + sum(map(operator.mul, row, acceleration)) for r, row in zip(rate, self.A)]
        self.span = horizon(model["modes"], self.is_stable)
        self.known = {}

    def advance(self, span):
        """(interval, number of intervals, Phi, gamma). Of many periods each second, third, ... is an interval."""
        if not self.period:
            return span / POINTS, POINTS, *held(self.A, self.b, span / POINTS)
        periods = max(10, math.ceil(span / self.period))
        stride = math.ceil(periods / MOST_PERIODS)
        return stride * self.period, math.ceil(periods / stride), *powered(self.A, self.b, stride)

    def states(self, span):
        """(interval, states at its multiples), which several outputs share."""
        if span not in self.known:
            interval, count, Phi, gamma = self.advance(span)
            x, found = self.start, []
            for _ in range(count + 1):
                found.append(x)
                x = [sum(map(operator.mul, row, x)) + g for row, g in zip(Phi, gamma)]
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
    final, span = None, motion.span
    for _ in range(24):
        interval, states = motion.states(span)
        values = [sum(map(operator.mul, c, x)) + d[motion.place] for x in states]
        if not motion.is_stable:
            break
        final = values[-1] if final is None else final
        settled = settled_at(values, final) / (len(values) - 1)
        if settled > 0.25 or settled == 0.0:
            break
        span *= 2.0 ** math.ceil(math.log2(max(2.0 * settled, 0.02)))
    times = [interval * k for k in range(len(values))]
    if final is None or abs(final) <= 1e-6 * max(map(abs, values)):
        return Step(times, values, interval, None if final is None else 0.0, None, None)
    overshoot = max(0.0, peak([value / final for value in values], not motion.period) - 1.0)
    return Step(times, values, interval, final, overshoot, times[min(len(times) - 1, settled_at(values, final))])
