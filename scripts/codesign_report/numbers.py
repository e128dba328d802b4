# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Numbers as the page shows them: rounded for the eye, whole for machines."""
import math

from jinja2.utils import markupsafe

Markup, escape = markupsafe.Markup, markupsafe.escape  # comes with jinja2, so that no dependency is added

MINUS = "\u2212"


def short(value, digits=6):
    """At most `digits` significant digits, with a typographic minus."""
    if value is None:
        return "\u2013"
    if isinstance(value, int):
        return str(value).replace("-", MINUS)
    if not math.isfinite(value):
        return ("" if value > 0 else MINUS) + "\u221e" if math.isinf(value) else "\u2013"
    text = f"{value:.{digits}g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        text = f"{mantissa}e{int(exponent)}"
    return text.replace("-", MINUS)


def number(value, digits=6):
    """HTML of a number of the JSON or of a table: its text is rounded, its attribute `value` reads back as the same double."""
    if value is None or isinstance(value, float) and not math.isfinite(value):
        return Markup(f"<span>{escape(short(value))}</span>")
    return Markup(f'<data value="{value!r}">{escape(short(value, digits))}</data>')


def nice_step(span, count):
    """The smallest of 1, 2, 5 times a power of ten that divides `span` into at most `count` parts."""
    raw = span / max(count, 1)
    power = 10.0 ** math.floor(math.log10(raw))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= raw * 0.9999999)


def ticks(low, high, count=6):
    """Round numbers from `low` to `high`, at most one more than `count`."""
    if not high > low:
        return [low]
    step = nice_step(high - low, count)
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    return [k * step for k in range(first, last + 1)]


def tick_labels(values):
    """(labels, offset) of ticks: as many digits as tell neighbours apart. Where these would be too many, the labels count from `offset`,
    whose text has them all; else the offset is empty."""
    if len(values) < 2:
        return [short(value, 4) for value in values], ""
    step = min(b - a for a, b in zip(values, values[1:]))
    digits = 1 + math.floor(math.log10(max(abs(v) for v in values))) - math.floor(math.log10(1.000001 * step))
    if digits <= 6:
        # A tick at zero is a rounding error where zero is among many steps.
        return [short(0.0 if abs(v) < 1e-6 * step else v, max(4, digits)) for v in values], ""
    return ["+" + short(k * step, 3) if k else "0" for k in range(len(values))], short(values[0], min(digits, 17))


def log_ticks(low, high, count=5):
    """Powers of ten from `low` to `high`, both positive; of many every second, every third, ..."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    stride = max(1, math.ceil((last - first) / count))
    return [10.0 ** k for k in range(first, last + 1, stride)]
