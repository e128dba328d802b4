# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Small motions about a state."""
from __future__ import annotations

import os
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _core, _pages

Array = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]


class TransferFunction(NamedTuple):
    """From one input to one output: G = gain (s - zeros[0]) ... / ((s - poles[0]) ...); of z in place of s with a period.

    Poles and zeros that cancel are kept: motions that the input does not reach or that the output does not show.

    zeros: shape (k,) [1/s], or of z; none where the gain is 0.
    poles: shape (n,) [1/s], or of z.
    gain: the first of D, CB, CAB, ... that is not zero, in the unit of the output per unit of the input; 0: the input does not reach the output.
    period: [s]; None without sampled controllers. python-control takes control.zpk(zeros, poles, gain).
    """
    zeros: ComplexArray
    poles: ComplexArray
    gain: float
    period: Optional[float]

    def at(self, frequencies: "npt.ArrayLike") -> ComplexArray:
        """G at s = j w, with a period at z = exp(j w period). @param frequencies w [rad/s]."""
        w = np.asarray(frequencies, float)
        s = 1j * w if self.period is None else np.exp(1j * w * self.period)
        value: ComplexArray = self.gain * np.prod(s[..., None] - self.zeros, axis=-1) / np.prod(s[..., None] - self.poles, axis=-1)
        return value


def transfer_zeros(A: Array, b: Array, c: Array, d: float) -> Tuple[ComplexArray, float]:  # pylint: disable=invalid-name
    """Zeros and gain of c (s - A)^-1 b + d.

    Zeros are where the matrix [[A - s, b], [c, d]] is singular. With a number p that is none, 1/(s - p) are the eigenvalues of
    [[A - p, b], [c, d]]^-1 [[1, 0], [0, 0]]. Those of zeros at infinity are 0: as many as d, cb, cAb, ... are 0, and one more.
    """
    n, rounding = len(b), 1e-12
    moment, size, sizes, gain, infinite = b, np.abs(b), np.abs(A), d, 0
    while gain == 0.0 and infinite < n:
        infinite += 1
        gain = float(c @ moment)
        if abs(gain) <= rounding * float(np.abs(c) @ size):
            gain = 0.0
        moment, size = A @ moment, sizes @ size
    if gain == 0.0:
        return np.zeros(0, np.complex128), 0.0
    p = 1.37 * float(np.abs(np.linalg.eigvals(A)).max(initial=0.0)) or 1.0
    pencil = np.block([[A - p * np.eye(n), b[:, None]], [c[None, :], np.array([[d]])]])
    roots = np.linalg.eigvals(np.linalg.solve(pencil, np.diag([1.0] * n + [0.0])))
    finite = roots[np.argsort(-np.abs(roots))][:n - infinite]
    return p + 1.0 / finite.astype(np.complex128), gain


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
    loops: by controller the margins that there are, each {"value", "frequency"} [rad, s, rad/s].
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

    def transfer(self, output: str, input: str) -> TransferFunction:  # pylint: disable=redefined-builtin
        """The transfer function of the closed loops from one of `inputs` to one of `outputs`. Raises KeyError for another name."""
        for name, names in ((output, self.outputs), (input, self.inputs)):
            if name not in names:
                raise KeyError(name)
        row, column = self.outputs.index(output), self.inputs.index(input)
        zeros, gain = transfer_zeros(self.A, self.B[:, column], self.C[row], float(self.D[row, column]))
        return TransferFunction(zeros, np.linalg.eigvals(self.A).astype(np.complex128), gain, self.period)

    def report(self, path: "str | os.PathLike[str] | None" = None) -> str:
        """The page of `codesign report` as HTML: margins, Bode and Nyquist diagrams, poles, step responses; also written to `path` if it is given."""
        from .codesign_report import linear, page  # type: ignore  # scripts/codesign_report
        return _pages.written(page.render(linear.Linearization("linearization", {**self._record, "version": _core.version()})), path)

    def __repr__(self) -> str:
        return f"<Linearization, {len(self.states)} states, {self.verdict}>"
