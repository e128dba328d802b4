# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Small motions about a state."""
from __future__ import annotations

import os
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _core, _pages

Array = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]


class Linearization:
    """A mechanism with its controllers about a state: x' = A x + B u, y = C x + D u; doc/linearization.md.

    With `period` from one period to the next, x(k+1) = A x(k) + B u(k). python-control takes control.ss(A, B, C, D), or
    control.ss(A, B, C, D, period).

    A, B, C, D: arrays of shape (n, n), (n, m), (r, n) and (r, m), in SI units of states, inputs and outputs.
    states, inputs, outputs: the n, m and r names.
    period: common period of all sample times [s]; None without sampled controllers.
    stability: "stable", "unstable" or "neutral".
    verdict: the same with the pole that decides and what is counted.
    modes: the least stable one first, each with growth [1/s], frequency [Hz], damping_ratio, rates of the joints and, sampled, radius.
    measured: by controller the signal that it compares with its set-point.
    loops: by controller the margins that there are, each {"value", "frequency"} [rad, s, rad/s], or {"why_not"}.
    """

    def __init__(self, record: Dict[str, Any]):
        self._record = record
        self.states: List[str] = record["states"]
        self.inputs: List[str] = record["inputs"]
        self.outputs: List[str] = record["outputs"]
        n, m, r = len(self.states), len(self.inputs), len(self.outputs)
        self.A, self.B, self.C, self.D = (np.array(record[name], float).reshape(shape)  # pylint: disable=invalid-name
                                          for name, shape in (("A", (n, n)), ("B", (n, m)), ("C", (r, n)), ("D", (r, m))))
        self.period: Optional[float] = record.get("period")
        self.stability: str = record["stability"]
        self.verdict: str = record["verdict"]
        self.modes: List[Dict[str, Any]] = record["modes"]
        self.measured: Dict[str, str] = record["measured"]
        self.loops: Dict[str, Dict[str, Any]] = {name: {key: value for key, value in loop.items() if key != "response"}
                                                 for name, loop in record["loops"].items()}
        self._responses = {name: loop["response"] for name, loop in record["loops"].items() if "response" in loop}

    @property
    def poles(self) -> ComplexArray:
        """One of each conjugate pair, in the order of `modes`, shape (len(modes),) [1/s]."""
        return np.array([mode["growth"] + 2j * np.pi * mode["frequency"] for mode in self.modes], np.complex128)

    def response(self, controller: str) -> Tuple[Array, ComplexArray]:
        """(frequencies [rad/s], L), the open loop of a controller, opened at its output. Raises KeyError for one without margins."""
        response = self._responses[controller]
        return np.array(response["frequency"], float), np.array(response["real"]) + 1j * np.array(response["imaginary"])

    def report(self, path: "str | os.PathLike[str] | None" = None) -> str:
        """The page of `codesign report` as HTML: margins, Bode and Nyquist diagrams, poles, step responses; also written to `path` if it is given."""
        from .codesign_report import linear, page  # type: ignore  # scripts/codesign_report
        return _pages.written(page.render(linear.Linearization("linearization", {**self._record, "version": _core.version()})), path)

    def __repr__(self) -> str:
        return f"<Linearization, {len(self.states)} states, {self.verdict}>"
