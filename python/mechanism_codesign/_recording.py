# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Recorded motions as arrays."""
from __future__ import annotations

from typing import Any, Dict, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

Columns = Union[npt.ArrayLike, Mapping[str, npt.ArrayLike]]


class Recording:
    """A recorded motion, an entry of `identify.data` as arrays.

    Parameters
    ----------
    time:
        Shape (n,), ascending [s].
    position, velocity, effort:
        {joint: array of shape (n,)}, a table with such columns, such as a pandas.DataFrame, or one array of shape (n,) or (n, k) for the k
        `joints` (by default all joints with one coordinate) [rad or m, per s, N m or N]; at least positions or velocities.
    signals:
        {signal: array of shape (n,)}: what sensors beside those of the joints show, in SI units.
    set:
        Values of parameters in this recording, by name, which the study does not tune.
    mask:
        The speed [rad/s or m/s] below which samples of a joint do not count: a number for all joints, or {joint: speed}.
    rest:
        What counts of samples below that speed: "leave_out", nothing; "bounds", how far the effort is from those of the joint that just moves.
    start:
        {joint: position at the first sample [rad or m]}, where velocities alone were recorded.
    """

    def __init__(self, time: npt.ArrayLike, position: Optional[Columns] = None, effort: Optional[Columns] = None, *,
                 velocity: Optional[Columns] = None, joints: Optional[Sequence[str]] = None,
                 signals: Optional[Mapping[str, npt.ArrayLike]] = None, set: Optional[Mapping[str, float]] = None,  # pylint: disable=redefined-builtin
                 mask: Union[float, Mapping[str, float], None] = None, rest: str = "leave_out", start: Optional[Mapping[str, float]] = None):
        self._time = time
        self._sides = (position, velocity, effort)
        self._joints = joints
        self._signals = dict(signals or {})
        self._set = dict(set or {})
        self._mask = dict(mask) if isinstance(mask, Mapping) else {} if mask is None else {"": float(mask)}
        self._rest = rest
        self._start = dict(start or {})

    def _table(self, name: str, joints: Sequence[str]) -> Tuple[Any, ...]:
        """What the extension reads. joints: those with one coordinate."""
        names = list(self._joints if self._joints is not None else joints)
        sides = [_columns(values, names, what) for values, what in zip(self._sides, ("position", "velocity", "effort"))]
        measured = list({**sides[0], **sides[1], **sides[2]})
        columns = [(joint, *(side.get(joint) for side in sides)) for joint in measured]
        return name, self._time, columns, list(self._signals.items()), self._set, self._mask, self._start, self._rest


def _columns(values: Optional[Columns], joints: Sequence[str], what: str) -> Dict[str, npt.ArrayLike]:
    """An array for each joint."""
    if values is None:
        return {}
    if isinstance(values, Mapping):
        return dict(values)
    table: Any = values
    if hasattr(table, "columns"):  # by their names, whatever their order
        return {joint: table[joint] for joint in table.columns}
    array = np.asanyarray(values)
    if array.ndim == 1:
        array = array[:, np.newaxis]
    if array.ndim != 2 or array.shape[1] != len(joints):
        raise ValueError(f"{what} has the shape {np.shape(values)}: (n, {len(joints)}) is needed for the joints {', '.join(joints)}; "
                         f"joints= chooses others, and a dictionary names them")
    return dict(zip(joints, array.T))
