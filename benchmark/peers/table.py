# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What race.py makes of its measurements: work at an error, winners, tables. Without any other program."""
import dataclasses
import math


@dataclasses.dataclass
class Point:
    """A run: its setting, a tolerance or a step size; its error, steps and processor time [s]."""
    setting: float
    error: float
    steps: float
    seconds: float


def bracket(points, error):
    """Of points from loose to tight: the loosest one such that it and all tighter ones have at most this error, and the next looser one.

    None if there is no such point. The second is None if the loosest of all is good enough.
    """
    good = None
    for k in reversed(range(len(points))):
        if not points[k].error <= error:
            break
        good = k
    if good is None:
        return None
    return points[good], points[good - 1] if good > 0 else None


def at_error(points, error):
    """The point at this error, between the two of bracket() along straight lines between logarithms. None if the error is never reached."""
    pair = bracket(points, error)
    if pair is None:
        return None
    tight, loose = pair
    if loose is None or not math.isfinite(loose.error) or tight.error <= 0.0:
        return tight
    share = math.log(error / tight.error) / math.log(loose.error / tight.error)
    between = [math.exp((1.0 - share) * math.log(a) + share * math.log(b)) if a > 0.0 and b > 0.0 else a
               for a, b in ((tight.setting, loose.setting), (tight.steps, loose.steps), (tight.seconds, loose.seconds))]
    return Point(between[0], error, between[1], between[2])


def difference(values, reference):
    """The largest difference, in times of the largest of the reference if that is above 1; not finite: infinite."""
    if len(values) != len(reference):
        return math.inf
    largest = max(abs(x - y) for x, y in zip(values, reference))
    return largest / max(1.0, *(abs(y) for y in reference)) if math.isfinite(largest) else math.inf


def three_digits(value):
    """Three significant digits without an exponent."""
    if not math.isfinite(value):
        return "-"
    decimals = max(0, 2 - math.floor(math.log10(abs(value)))) if value else 2
    return f"{value:.{decimals}f}"


def milliseconds(seconds):
    return f"{three_digits(1e3 * seconds)} ms"


def row_of_times(seconds, own, others, reasons):
    """Cells of one task: our time, those of the others in times of ours, and who is the fastest.

    @param seconds by name; None: not reached or not measured. @param reasons by name: what stands in place of a number.
    """
    mine = seconds.get(own)
    cells = [milliseconds(mine) if mine is not None else reasons.get(own, "-")]
    for name in others:
        theirs = seconds.get(name)
        if theirs is None:
            cells.append(reasons.get(name, "-"))
        else:
            cells.append(milliseconds(theirs) + (f", {three_digits(theirs / mine)} x" if mine is not None else ""))
    reached = {name: value for name, value in seconds.items() if value is not None}
    fastest = min(reached, key=reached.get) if reached else None
    if fastest is None:
        return cells + ["-"]
    return cells + [fastest if fastest == own else f"**{fastest}**"]


def brief_of_times(columns, rows):
    """Of the table of times the rows at the smallest error of each task, with the ratios alone; those below 1 are bold."""
    def ratio(cell):
        if not cell.endswith(" x"):
            return "-"
        number = cell[cell.rindex(",") + 2:-2]
        return f"**{number}**" if float(number) < 1.0 else number

    tight = {row[0]: row for row in sorted(rows, key=lambda row: -float(row[1]))}
    return columns[:-1], [tight[task][:3] + [ratio(cell) for cell in tight[task][3:-1]] for task in dict.fromkeys(row[0] for row in rows)]


def to_markdown(name, columns, rows):
    """A table for doc/performance.md or benchmark/sweeps.md, between the markers of update_tables.py."""
    lines = [f"<!-- table: {name} -->", "| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines + [f"<!-- end: {name} -->"]) + "\n"


def to_text(title, columns, rows):
    """The same for a terminal."""
    widths = [max(len(line[k]) for line in [columns] + rows) for k in range(len(columns))]
    return "\n".join([title] + ["  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in [columns] + rows]) + "\n"


def unmeasured_sentence(names):
    """What is said without PyPI."""
    return f"PyPI cannot be reached, so that these are not measured: {', '.join(names)}."
