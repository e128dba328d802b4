# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Step responses of a linearization, exact at the drawn instants: x' = A x + B u, or x(k+1) = A x(k) + B u(k) with a period."""
import collections
import math
import operator

POINTS = 600  # of a response
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


def follow(Phi, gamma, start, c, d, count):
    """The values y(k) = c x(k) + d of a unit step for k = 0 to count."""
    x, values = start, []
    for _ in range(count + 1):
        values.append(sum(map(operator.mul, c, x)) + d)
        x = [sum(map(operator.mul, row, x)) + g for row, g in zip(Phi, gamma)]
    return values


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


def followed(advance, start, c, d, span, is_stable):
    """The response over a span, of a stable motion over as long as it takes to settle and about as long again.

    @param advance a function of a span that returns (interval, number of intervals, Phi, gamma)."""
    final = None
    for _ in range(12):
        interval, count, Phi, gamma = advance(span)
        values = follow(Phi, gamma, start, c, d, count)
        if not is_stable:
            break
        final = values[-1] if final is None else final
        settled = settled_at(values, final) / count
        if settled > 0.3 or settled == 0.0:
            break
        span *= max(2.0 * settled, 0.02)
    times = [interval * k for k in range(count + 1)]
    if final is None or abs(final) <= 1e-6 * max(map(abs, values)):
        return Step(times, values, interval, None if final is None else 0.0, None, None)
    overshoot = max(0.0, max(value / final for value in values) - 1.0)
    return Step(times, values, interval, final, overshoot, times[min(count, settled_at(values, final))])


def continuous(A, b, start, c, d, span, is_stable):
    return followed(lambda time: (time / POINTS, POINTS, *held(A, b, time / POINTS)), start, c, d, span, is_stable)


def sampled(A, b, c, d, period, span, is_stable):
    """Values at the ends of periods, of many only at each second, third, ..."""
    def advance(time):
        periods = max(10, math.ceil(time / period))
        stride = math.ceil(periods / POINTS)
        return stride * period, math.ceil(periods / stride), *powered(A, b, stride)

    return followed(advance, [0.0] * len(b), c, d, span, is_stable)


def response(model, name, c, d):
    """The response of c x + D u to a unit step of an input.

    The rate of a set-point that steps is an impulse, its acceleration the derivative of one: both leave the state B_rate + A B_acceleration
    at 0+. A sampled law reads rates at instants at which they are zero. @param d one number per input."""
    A, column = model["A"], {each: k for k, each in enumerate(model["inputs"])}
    b, direct = [row[column[name]] for row in model["B"]], d[column[name]]
    is_stable = model["stability"] == "stable"
    span = horizon(model["modes"], is_stable)
    if model.get("period"):
        return sampled(A, b, c, direct, model["period"], span, is_stable)
    rate, acceleration = ([row[column[name + what]] for row in model["B"]] if name + what in column else [0.0] * len(b) for what in ("_rate", "_acceleration"))
    start = [r + sum(map(operator.mul, row, acceleration)) for r, row in zip(rate, A)]
    return continuous(A, b, start, c, direct, span, is_stable)
