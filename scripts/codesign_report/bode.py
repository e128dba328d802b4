# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The Bode diagram of an open loop: gain and phase over the frequency, with its margins."""
import math

from . import plane
from .numbers import short
from .open_loop import decibels, half_turn

HIGHEST = 60.0  # dB; the peak of a resonance without damping ends there


def degree_ticks(low, high):
    step = next(step for step in (15, 30, 45, 90, 180, 360, 720, 1440, 10 ** 9) if (high - low) / step <= 7)
    values = [step * k for k in range(math.ceil(low / step), math.floor(high / step) + 1)] or [low]
    return values, [short(value) for value in values]


def gain_chart(name, response, marks):
    """|L| in dB, with the gain margins as distances from 0 dB."""
    first, last = response.shown([f for _, f in marks.values()])
    fs, gains = response.frequencies[first:last + 1], response.gains[first:last + 1]
    marked = [-decibels(marks[key][0]) for key in ("gain_margin", "gain_reduction") if key in marks]
    low, high = (min(max(min(gains), -HIGHEST), -6.0, *marked), max(min(max(gains), HIGHEST), 6.0, *marked))
    pad = 0.06 * (high - low)
    drawn = plane.Plane((fs[0], fs[-1]), (low - pad, high + pad), ("frequency [Hz]", "|L| [dB]"), log_x=True)
    drawn.curve([(fs[0], 0.0), (fs[-1], 0.0)], "edge")
    drawn.curve(list(zip(fs, gains)), "tuned line")
    notes = []
    for key in ("gain_margin", "gain_reduction"):
        if key in marks:
            value, f = marks[key]
            text = f"{key.replace('_', ' ')} {short(value, 4)} ({short(decibels(value), 3)} dB)"
            drawn.curve([(f, 0.0), (f, -decibels(value))], "limit", text)
            drawn.dot((f, -decibels(value)), "limit", f"{text} at {short(f, 4)} Hz")
            notes.append(((f, -decibels(value)), text))
    if "phase_margin" in marks:
        drawn.dot((marks["phase_margin"][1], 0.0), "tuned", f"|L| = 1 at {short(marks['phase_margin'][1], 4)} Hz")
    for note in notes:
        drawn.note(*note)
    return drawn.svg(f"{name}: gain of the open loop")


def phase_chart(name, response, marks):
    """The phase of L, with the phase margin as the distance from an odd multiple of 180 degrees."""
    first, last = response.shown([f for _, f in marks.values()])
    fs, phases = response.frequencies[first:last + 1], response.phases[first:last + 1]
    limited = [response.at(marks[key][1], response.phases) for key in ("gain_margin", "gain_reduction", "phase_margin", "delay_margin") if key in marks]
    turns = sorted({half_turn(phase) for phase in (*limited, *phases) if phase in limited or abs(phase - half_turn(phase)) < 20.0})
    low, high = min(phases + turns), max(phases + turns)
    pad = max(10.0, 0.06 * (high - low))
    drawn = plane.Plane((fs[0], fs[-1]), (low - pad, high + pad), ("frequency [Hz]", "phase of L [deg]"), log_x=True,
                        ticks=degree_ticks(low - pad, high + pad))
    for turn in turns:
        drawn.curve([(fs[0], turn), (fs[-1], turn)], "edge")
    drawn.curve(list(zip(fs, phases)), "tuned line")
    texts = {"phase_margin": lambda value: f"phase margin {short(math.degrees(value), 4)}\u00b0",
             "delay_margin": lambda value: f"delay margin {short(value, 4)} s"}
    for key, text in texts.items():
        if key in marks:
            value, f = marks[key]
            phase = response.at(f, response.phases)
            drawn.dot((f, phase), "limit", f"{text(value)} at {short(f, 4)} Hz")
            if key == "phase_margin" or f != marks.get("phase_margin", (0, 0))[1]:
                drawn.curve([(f, half_turn(phase)), (f, phase)], "limit", text(value))
                drawn.note((f, phase), text(value))
    for key in ("gain_margin", "gain_reduction"):
        if key in marks:
            drawn.dot((marks[key][1], response.at(marks[key][1], response.phases)), "tuned", f"the phase that limits the gain, at {short(marks[key][1], 4)} Hz")
    return drawn.svg(f"{name}: phase of the open loop")
