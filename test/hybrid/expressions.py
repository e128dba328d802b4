# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Formulas that a study can hold as text and that the event-driven solver can evaluate. Each place that is not smooth is a branch: its outcome is an input, held
between events, and its sides are numbers that are positive while the outcome is right. Values may be complex: an imaginary part is a direction."""
import numpy as np


class Point:
    """Where formulas are evaluated: the time, parameters, signals, and the mode, a map from each branch to its outcome; without a mode, branches decide
    themselves, and `outcomes` is the mode. `sides` collects what must stay positive. `opposites` are pairs of branches of which one holds unless the value is zero."""

    def __init__(self, t, parameters, mode=None):
        self.t, self.parameters, self.mode = t, parameters, mode
        self.signals, self.outcomes, self.sides, self.opposites = {}, {}, {}, {}

    def is_positive(self, branch, guard):
        outcome = bool(np.ravel(np.real(guard))[0] > 0.0) if self.mode is None or branch not in self.mode else self.mode[branch]
        self.outcomes[branch] = outcome
        self.sides[branch] = guard if outcome else -guard
        return outcome

    def whole(self, branch, value):
        """The largest whole number up to the value."""
        outcome = int(np.floor(np.ravel(np.real(value))[0])) if self.mode is None or branch not in self.mode else self.mode[branch]
        self.outcomes[branch] = outcome
        self.sides[(branch, "low")], self.sides[(branch, "high")] = value - outcome, outcome + 1 - value
        return outcome


class Formula:
    """@param text for the study; @param value(point)"""

    rate = None  # by time, of set-points that have one

    def __init__(self, text, value):
        self.text, self.value = text, value

    def __add__(self, other):
        return binary("+", self, other, lambda a, b: a + b)

    def __sub__(self, other):
        return binary("-", self, other, lambda a, b: a - b)

    def __mul__(self, other):
        return binary("*", self, other, lambda a, b: a * b)

    def __truediv__(self, other):
        return binary("/", self, other, lambda a, b: a / b)

    def __neg__(self):
        return Formula(f"(-{self.text})", lambda point: -self.value(point))


def number(value):
    return Formula(repr(value), lambda point: np.asarray(value, float))


def formula(value):
    return value if isinstance(value, Formula) else number(value)


def binary(sign, a, b, value):
    a, b = formula(a), formula(b)
    return Formula(f"({a.text} {sign} {b.text})", lambda point: value(a.value(point), b.value(point)))


def parameter(name):
    return Formula(name, lambda point: point.parameters[name])


def signal(name):
    return Formula(name, lambda point: point.signals[name])


TIME = Formula("t", lambda point: point.t)


def function(name, x):
    x = formula(x)
    return Formula(f"{name}({x.text})", lambda point: getattr(np, name)(x.value(point)))


def square(x):
    return Formula(f"({x.text})^2", lambda point: x.value(point) ** 2)


def choose(a, b, then, otherwise):
    """then if a < b"""
    a, b, then, otherwise, branch = formula(a), formula(b), formula(then), formula(otherwise), object()

    def value(point):
        return (then if point.is_positive(branch, b.value(point) - a.value(point)) else otherwise).value(point)
    return Formula(f"({a.text} < {b.text} ? {then.text} : {otherwise.text})", value)


def sign(x):
    """Zero at zero: a motion at rest can stay there."""
    above, below = object(), object()

    def value(point):
        inner = x.value(point)
        point.opposites.update({above: below, below: above})
        if point.is_positive(above, inner):
            return np.asarray(1.0)
        return np.asarray(-1.0 if point.is_positive(below, -inner) else 0.0)
    return Formula(f"sign({x.text})", value)


def magnitude(x):
    branch = object()

    def value(point):
        inner = x.value(point)
        return inner if point.is_positive(branch, inner) else -inner
    return Formula(f"abs({x.text})", value)


def least(a, b):
    return extreme("min", a, b, lambda x, y: y - x)


def largest(a, b):
    return extreme("max", a, b, lambda x, y: x - y)


def extreme(name, a, b, guard):
    a, b, branch = formula(a), formula(b), object()

    def value(point):
        x, y = a.value(point), b.value(point)
        return x if point.is_positive(branch, guard(x, y)) else y
    return Formula(f"{name}({a.text}, {b.text})", value)


def floor(x):
    branch = object()
    return Formula(f"floor({x.text})", lambda point: np.asarray(float(point.whole(branch, x.value(point)))))


def table(name, at, values, interpolation):
    """Lines or the natural cubic spline through values at ascending places of a signal, with its tangents beyond them. Its text is the study's map."""
    values = [formula(value) for value in values]
    widths = np.diff(at)
    slopes = (np.eye(len(at))[1:] - np.eye(len(at))[:-1]) / widths[:, None]  # of the chords, by the values
    bends = np.zeros((len(at), len(at)))
    if interpolation == "cubic" and len(at) > 2:
        inner = np.diag((widths[:-1] + widths[1:]) / 3.0) + np.diag(widths[1:-1] / 6.0, 1) + np.diag(widths[1:-1] / 6.0, -1)
        bends[1:-1] = np.linalg.solve(inner, np.diff(slopes, axis=0))
    branches = [object() for _ in at]

    def value(point):
        x, ordinates = point.signals[name], [v.value(point) for v in values]
        rows = np.array(np.broadcast_arrays(*ordinates))
        piece = sum(1 for k in range(len(at)) if point.is_positive(branches[k], x - at[k])) - 1
        chord, m = np.tensordot(slopes, rows, 1), np.tensordot(bends, rows, 1)
        if piece < 0:
            return rows[0] + (x - at[0]) * (chord[0] - widths[0] / 6.0 * m[1])
        if piece >= len(widths):
            return rows[-1] + (x - at[-1]) * (chord[-1] + widths[-1] / 6.0 * m[-2])
        h, left, right = widths[piece], x - at[piece], at[piece + 1] - x
        return (rows[piece] * right + rows[piece + 1] * left) / h + (m[piece] * (right**3 / h - h * right) + m[piece + 1] * (left**3 / h - h * left)) / 6.0
    ordinates = ", ".join(f'"${{{v.text}}}"' for v in values)
    return Formula(f"{{type: table, signal: {name}, at: {list(map(float, at))}, values: [{ordinates}], interpolation: {interpolation}}}", value)


def waypoints(times, positions):
    """Lines between way-points, held before and after; `rate` is the derivative. Its text is the study's map."""
    positions = [formula(position) for position in positions]
    branches = [object() for _ in times]

    def piece(point):
        return sum(1 for k, time in enumerate(times) if point.is_positive(branches[k], point.t - time)) - 1

    def slope(point, k):
        return (positions[k + 1].value(point) - positions[k].value(point)) / (times[k + 1] - times[k])

    def value(point):
        k = piece(point)
        if k < 0 or k + 1 == len(times):
            return positions[max(k, 0)].value(point)
        return positions[k].value(point) + slope(point, k) * (point.t - times[k])

    def rate(point):
        k = piece(point)
        return 0.0 if k < 0 or k + 1 == len(times) else slope(point, k)
    ordinates = ", ".join(quoted(position) for position in positions)
    result = Formula(f"{{type: waypoints, times: {list(map(float, times))}, positions: [{ordinates}], interpolation: linear}}", value)
    result.rate = rate
    return result


def quoted(x):
    """As a quantity, reference or signal of the study."""
    return x.text if x.text.startswith("{") else f'"${{{x.text}}}"'
