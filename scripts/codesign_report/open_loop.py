# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The open loop L of a controller over the frequency, and where its margins are."""
import cmath
import math

TURN = 2.0 * math.pi
SHOWN = 40.0  # dB about 0 dB whose frequencies a Bode diagram shows
CLOSE = 1e-9  # distance of two frequencies, relative to them, of which the second one is left out


def decibels(value):
    return 20.0 * math.log10(value)


def clear(rows):
    """Rows (frequency, L) without those so near to a pole without damping that rounding decides on L: its phase has no meaning there."""
    kept = []
    for row in rows:
        if not kept or row[0] > kept[-1][0] * (1.0 + CLOSE):
            kept.append(row)
    return [row for k, row in enumerate(kept) if not 0 < k < len(kept) - 1 or abs(row[1]) <= 1e5 * max(abs(kept[k - 1][1]), abs(kept[k + 1][1]))]


class Response:
    """L at its frequencies, in Hz, with the phase in degrees that goes on beyond half a turn."""

    def __init__(self, table):
        rows = [(w / TURN, complex(real, imaginary)) for w, real, imaginary in zip(table["frequency"], table["real"], table["imaginary"])
                if None not in (w, real, imaginary) and w > 0.0 and (real or imaginary)]
        rows = clear(rows)
        self.frequencies, self.values = [f for f, _ in rows], [value for _, value in rows]
        self.gains = [decibels(abs(value)) for value in self.values]
        self.phases = []
        for k, value in enumerate(self.values):
            phase = math.degrees(cmath.phase(value))
            near = self.phases[-1] + self.lean(k) if self.phases else -90.0  # the first one lies from -270 to 90 degrees
            self.phases.append(phase + 360.0 * round((near - phase) / 360.0))

    def lean(self, k):
        """Half a turn between two frequencies is one down at a peak, of poles without damping, and one up at zeros."""
        beside = self.gains[max(0, k - 4)] + self.gains[min(len(self.gains) - 1, k + 3)]
        return -20.0 if self.gains[k] + self.gains[k - 1] > beside else 20.0

    def pieces(self):
        """The points of L, cut at poles without damping: there L goes through infinity."""
        parts = [[]]
        for k, value in enumerate(self.values):
            if k and abs(self.phases[k] - self.phases[k - 1]) > 120.0:
                parts.append([])
            parts[-1].append((value.real, value.imag))
        return parts

    def at(self, frequency, column):
        """A column at a frequency [Hz], linear in the logarithm of the frequency; beyond the ends the value there."""
        k = next((k for k, f in enumerate(self.frequencies) if f >= frequency), len(self.frequencies) - 1)
        if k == 0 or self.frequencies[k] <= frequency:
            return column[k]
        low, high = self.frequencies[k - 1], self.frequencies[k]
        part = math.log(frequency / low) / math.log(high / low)
        return column[k - 1] + part * (column[k] - column[k - 1])

    def shown(self, marked):
        """(first, last) index of what a Bode diagram shows: gains near 0 dB, and a third of a decade about each marked frequency."""
        kept = [k for k, (f, gain) in enumerate(zip(self.frequencies, self.gains))
                if abs(gain) <= SHOWN or any(0.5 * m <= f <= 2.0 * m for m in marked)]
        return (kept[0], kept[-1]) if len(kept) > 1 else (0, len(self.gains) - 1)


def crossings(margins, at_rest=False):
    """{name: (value, frequency [Hz])} of the margins that have a place in the diagrams. @param at_rest whether 0 Hz is one."""
    return {name: (margin["value"], margin["frequency"] / TURN) for name, margin in margins.items()
            if name != "response" and isinstance(margin, dict) and margin["value"] and (margin["frequency"] > 0.0 or at_rest)}


def half_turn(phase):
    """The nearest phase of a negative real number [deg]."""
    return 180.0 + 360.0 * round((phase - 180.0) / 360.0)
