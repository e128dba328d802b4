# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Integrates motions that switch, and their sensitivities, with scipy's DOP853: the mode is held, the first side that falls to zero ends a piece, and sensitivities
jump by S+ = S- + (f- - f+) tau', tau' = -(s_x S- + s_rho) / (s_t + s_x f-). A program that shares nothing with the package. scipy's own search for events looks at
the ends of steps alone and misses pairs of them; here sides are sampled within steps."""
import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from expressions import Point

STEP = 1e-30  # of complex directions
SAMPLES = np.linspace(0.0, 1.0, 13)  # of sides within a step
AT_ONCE = 1e-9  # of the duration: events nearer than that are one instant
TANGENT = 1e-5  # of the rate a side's size has over the duration: slower crossings graze
PER_RUN = 40  # steps at least
MOST_STEPS = 5000  # in a run: more take minutes, for a motion that turns ever faster
LARGEST = 1e10  # beyond the maximum_speed of random studies: the motion becomes infinite within the run


def first(values):
    return np.ravel(values)[0]


class Doubt(Exception):
    """The derivative does not exist, or the motion does not go on."""


class Motion:
    """@param model has size, duration, names and values of parameters, start(point), rates(point, y), objective(point, y) and sampling, a list of
    (time, function(point, y)) in order. y has a column per direction of a parameter. run() gives the objective and its gradient; `events` are their instants."""

    def __init__(self, model, tolerance=1e-11):
        self.model, self.tolerance = model, tolerance
        self.n, self.p = model.size, len(model.names)
        directions = np.eye(self.p) * 1j * STEP
        self.parameters = {name: model.values[k] + directions[k] for k, name in enumerate(model.names)}
        self.numbers = {name: np.array([float(model.values[k])]) for k, name in enumerate(model.names)}
        self.events, self.largest, self.last_step, self.steps = [], {}, 0.0, 0

    def columns(self, extended):
        return extended[:self.n, None] + 1j * STEP * extended[self.n:].reshape(self.n, self.p)

    def extended(self, columns):
        columns = np.array([np.broadcast_to(row, self.p) for row in columns], complex)
        return np.concatenate([columns[:, 0].real, (columns.imag / STEP).ravel()])

    def evaluate(self, t, extended, mode):
        point = Point(t, self.parameters, mode)
        return point, self.extended(self.model.rates(point, self.columns(extended)))

    def rates(self, t, extended, mode):
        return self.evaluate(t, extended, mode)[1]

    def mode_across(self, t, extended, mode, key):
        """With the other outcome of one side. Branches that are clearly wrong then, since what they read has jumped, decide anew; others that are zero at the same
        instant have their own events."""
        branch = key[0] if isinstance(key, tuple) and key[-1] in ("low", "high") else key
        change = {"low": -1, "high": 1}.get(key[-1]) if isinstance(key, tuple) else None
        held, mode = mode[branch], {**mode, branch: not mode[branch] if change is None else mode[branch] + change}
        opposite = self.evaluate(t, extended, mode)[0].opposites.get(branch)
        if opposite and held:
            mode[opposite] = True
        for _ in range(8):
            point = self.evaluate(t, extended, mode)[0]
            wrong = {side for side, value in point.sides.items() if first(np.real(value)) < -1e-9 * max(1e-3, self.largest.get(side, 0.0))}
            if not wrong:
                return point.outcomes
            mode = {other: outcome for other, outcome in mode.items() if not wrong & {other, (other, "low"), (other, "high")}}
        raise Doubt(f"no mode leads on at {t}")

    def mode_behind(self, t, extended, mode):
        """A little further along the motion of the mode that is found there."""
        step = 1e-7 * self.model.duration
        for _ in range(4):
            middle = extended + 0.5 * step * self.rates(t, extended, mode)
            ahead = extended + step * self.rates(t + 0.5 * step, middle, mode)
            found = self.evaluate(t + step, ahead, None)[0].outcomes
            if found == mode:
                return found
            mode = found
        raise Doubt(f"no mode leads on at {t}")

    def sides(self, t, y, mode):
        """@param t an array of instants, @param y a column per instant"""
        point = Point(t, self.numbers, mode)
        self.model.rates(point, y)
        return {key: np.broadcast_to(side, np.shape(t)) for key, side in point.sides.items()}

    def first_fall(self, t, h, dense, mode):
        """The first instant in the step at which a side becomes negative, and its key."""
        found = (np.inf, None)
        times = t + h * SAMPLES
        for key, values in self.sides(times, dense(times)[:self.n], mode).items():
            begin, values = values[0], values[1:]
            self.largest[key] = size = max(self.largest.get(key, 0.0), np.max(np.abs(values)))
            below = np.nonzero(values < min(begin, -1e-13 * size))[0]
            if not len(below):
                continue

            def side(time, key=key):
                return self.sides(np.array([time]), dense(np.array([time]))[:self.n], mode)[key][0]
            before, behind = times[below[0]], times[below[0] + 1]
            time = brentq(side, before, behind, xtol=1e-15, rtol=1e-15) if side(before) > 0.0 else before
            found = min(found, (time, key), key=lambda pair: pair[0])
        return found

    def solver(self, t, end, extended, mode):
        settings = {"rtol": self.tolerance, "atol": 0.1 * self.tolerance, "max_step": self.model.duration / PER_RUN}
        first = min(self.last_step, end - t) or None
        return DOP853(lambda time, y: self.rates(time, y, mode), t, extended, end, first_step=first, **settings)

    def until_event(self, t, end, extended, mode):
        """To the first side that falls to zero, or to the end. Returns time, state and the side's key, if any."""
        solver = self.solver(t, end, extended, mode)
        while solver.status == "running":
            before, y = solver.t, solver.y.copy()
            failure = solver.step()
            if failure:
                raise Doubt(failure)
            self.last_step = solver.t - before
            self.steps += 1
            if np.max(np.abs(solver.y[:self.n])) > LARGEST or self.steps > MOST_STEPS:
                raise Doubt(f"the motion runs away at t = {solver.t}")
            time, key = self.first_fall(before, solver.t - before, solver.dense_output(), mode)
            if key is not None:
                return *self.polish(before, time, y, mode, key), key
        return end, solver.y, None

    def polish(self, t, time, y, mode, key):
        """The dense output is less exact than steps: the last one again, to the event, and a step of Newton's method."""
        solver = self.solver(t, time, y, mode) if time > t else None
        while solver and solver.status == "running":
            solver.step()
        y = solver.y if solver else y
        side, rate = self.side_and_rate(time, y, mode, key)
        change = -first(np.real(side)) / rate if rate < 0.0 else 0.0
        if abs(change) > 1e-6 * self.model.duration:
            return time, y
        return time + change, y + change * self.rates(time, y, mode)

    def side_and_rate(self, t, extended, mode, key):
        point, rates = self.evaluate(t, extended, mode)
        along = Point(t + 1j * STEP, self.numbers, mode)
        self.model.rates(along, (extended[:self.n] + 1j * STEP * rates[:self.n])[:, None])
        return point.sides[key], first(np.imag(along.sides[key])) / STEP

    def cross(self, t, extended, mode, key):
        """The sensitivities behind the event, and the new mode."""
        side, rate = self.side_and_rate(t, extended, mode, key)
        if not rate < 0.0:
            raise Doubt(f"a side falls to zero at {t} with the rate {rate}")
        behind = self.mode_across(t, extended, mode, key)
        before, after = self.rates(t, extended, mode)[:self.n], self.rates(t, extended, behind)[:self.n]
        jumps = np.max(np.abs(before - after)) > 1e-9 * np.max(np.abs(before))
        if jumps and abs(rate) * self.model.duration < TANGENT * self.largest.get(key, 0.0):
            raise Doubt(f"a guard is grazed at {t}")
        tau = -np.imag(np.broadcast_to(side, (self.p,))) / STEP / rate
        s = extended[self.n:].reshape(self.n, self.p) + np.outer(before - after, tau) * jumps
        return np.concatenate([extended[:self.n], s.ravel()]), behind

    def piece(self, t, end, extended):
        """From one sample instant to the next."""
        mode = self.mode_behind(t, extended, self.evaluate(t, extended, None)[0].outcomes)
        last, repeated = -1.0, 0
        while t < end:
            t, extended, key = self.until_event(t, end, extended, mode)
            if key is None:
                return self.cross_at_end(t, extended, mode) if end < self.model.duration else extended
            repeated = repeated + 1 if t - last < AT_ONCE * self.model.duration else 0
            if repeated > 8 or len(self.events) > 2000:
                raise Doubt(f"the motion is held at a switch at {t}")
            self.events.append(t)
            last = t
            extended, mode = self.cross(t, extended, mode, key)
        return extended

    def cross_at_end(self, t, extended, mode):
        """Where sides are zero at the very end of a piece, their events come before what the end brings."""
        last = 1e-12 * self.model.duration
        for key in self.evaluate(t, extended, mode)[0].sides:
            side, rate = self.side_and_rate(t, extended, mode, key)
            if rate < 0.0 and first(np.real(side)) < -rate * last:
                self.events.append(t)
                return self.cross(t, extended, mode, key)[0]
        return extended

    def run(self):
        with np.errstate(all="ignore"):  # trial steps may go far beyond a mode
            return self.run_quietly()

    def run_quietly(self):
        extended = self.extended(self.model.start(Point(0.0, self.parameters)))
        t = 0.0
        for time, sample in self.model.sampling + [(self.model.duration, None)]:
            end = min(time, self.model.duration)
            if end > t:
                extended = self.piece(t, end, extended)
            t = end
            if sample and time < self.model.duration:
                extended = self.extended(sample(Point(t, self.parameters), self.columns(extended)))
        psi = np.broadcast_to(self.model.objective(Point(t, self.parameters), self.columns(extended)), (self.p,))
        return psi[0].real, psi.imag / STEP
