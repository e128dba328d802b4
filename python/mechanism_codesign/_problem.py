# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""A mechanism and a study, and what can be computed with them."""
from __future__ import annotations

import os
import warnings
from typing import Any, Callable, Dict, Iterable, List, Mapping, NamedTuple, Optional, Protocol, Sequence, Tuple, Type, Union

import numpy as np
import numpy.typing as npt

from . import _core, _notebook
from ._errors import ComputationError, Status, Warning
from ._linear import Linearization
from ._recording import Columns, Recording
from ._results import Fit, FitTrial, Regressor, Result, Run, Stage, Trial
from ._tradeoff import Tradeoff, TradeoffPoint

Array = npt.NDArray[np.float64]
Source = Union[str, "os.PathLike[str]"]


class Event(Protocol):
    """threading.Event, or anything else that can be asked."""

    def is_set(self) -> bool: ...


class Parameter(NamedTuple):
    """A named number on which model or study depend.

    name: as keyword arguments and `set` name it.
    value, lower, upper: start and bounds in SI units; -inf or inf: no bound.
    unit: as the model names it; empty: none is named.
    tuned: whether the study tunes it.
    """

    name: str
    value: float
    lower: float
    upper: float
    unit: str
    tuned: bool


def _source(value: Source, name: str) -> Tuple[str, Optional[str]]:
    """(path, None), or (name, text)."""
    path = os.fspath(value)
    if path is value and ("\n" in path or path.lstrip().startswith("<")):
        return name, path
    return path, None


def _absolute(source: Optional[Tuple[str, Optional[str]]]) -> Optional[Tuple[str, Optional[str]]]:
    return (os.path.abspath(source[0]), None) if source and source[1] is None else source


def _rebuilt(kind: Type["Problem"], made_of: Tuple[Any, ...]) -> "Problem":
    """A problem from what another one was made of, which has told the warnings."""
    problem = kind.__new__(kind)
    problem._open(made_of)  # pylint: disable=protected-access
    return problem


class Problem:
    """A mechanism and a study, read and compiled: `codesign ... MODEL [STUDY]` as an object.

    Parameters
    ----------
    model, study:
        Paths, or texts: a string with a line end or one that begins with `<` is a text. Without a
        study the mechanism is at rest for 0 s and nothing is tuned.
    overlays:
        Paths or texts of overlays, in the order of their application; one alone needs no list.
    set:
        Values of parameters by name, as `--set NAME=VALUE`: of a tuned one its start, of any other
        one its value in every design. The equations are compiled with them.
    result:
        Path of a result.json whose design counts before `set`, as `--result`.

    Raises InputError with file and line. Long calls release Python's lock, and Ctrl-C ends them; a
    problem may be used by several threads, side by side. Pickled or copied it is read and compiled
    again from its files, which must be there unchanged, and texts: once in each process.

    In all methods, keyword arguments are values of parameters by name, within their bounds [SI
    units]; the others keep their start values. `rho` is an array of the p tuned parameters in the
    order of `names`, shape (p,), which need not lie within bounds; it may also be given by its name.

    names: of the tuned parameters, the order of rho and of every gradient.
    """

    def __init__(self, model: Source, study: Optional[Source] = None, *, overlays: Union[Source, Iterable[Source]] = (),
                 set: Optional[Mapping[str, float]] = None, result: Optional[Source] = None):  # pylint: disable=redefined-builtin
        if isinstance(overlays, (str, os.PathLike)):
            overlays = [overlays]
        self._open((_source(model, "model text"), None if study is None else _source(study, "study text"),
                    [_source(overlay, f"text of overlay {k}") for k, overlay in enumerate(overlays, 1)], dict(set or {}),
                    None if result is None else _source(result, "result text")))
        for warning in self.warnings:
            warnings.warn(warning, stacklevel=2)

    def _open(self, made_of: Tuple[Any, ...]) -> None:
        self._made_of = made_of
        self._core = _core.open(*made_of)
        self.names: List[str] = self._core.names
        self._last: Tuple[Any, Any] = (None, None)

    def __reduce__(self) -> Tuple[Any, ...]:
        model, study, overlays, values, result = self._made_of
        # Another process may work in another folder.
        return _rebuilt, (type(self), (_absolute(model), _absolute(study), [_absolute(each) for each in overlays], values, _absolute(result)))

    @property
    def parameters(self) -> List[Parameter]:
        """Every named parameter, those of the model first."""
        return [Parameter(*p) for p in self._core.parameters]

    @property
    def start(self) -> Array:
        """The start of rho, shape (p,), in SI units."""
        return self._core.start

    @property
    def bounds(self) -> List[Tuple[float, float]]:
        """(lower, upper) of each tuned parameter in SI units, infinite without a bound: as scipy.optimize takes them."""
        of = {p.name: (p.lower, p.upper) for p in self.parameters}
        return [of[name] for name in self.names]

    @property
    def duration(self) -> float:
        """Of the study [s]; with `positions` the number of the last posture, counted from 0."""
        return self._core.duration

    @property
    def joints(self) -> List[str]:
        """The joints and loops with one coordinate, in the order of the model."""
        return self._core.joints

    @property
    def signals(self) -> List[str]:
        """The signals that simulate() records by default."""
        return self._core.signals

    @property
    def warnings(self) -> List[Warning]:
        """About the files and the mechanism at its start."""
        return [Warning(**w) for w in self._core.warnings]

    def urdf(self, rho: Optional[npt.ArrayLike] = None, /, **parameters: float) -> str:
        """The model at a design as URDF, with all overlays applied: `codesign urdf`."""
        return self._core.urdf(rho, parameters)

    def simulate(self, rho: Optional[npt.ArrayLike] = None, /, *, signals: Optional[Sequence[str]] = None, samples: int = 101,
                 **parameters: float) -> Run:
        """Runs the study at one design, from 0 s to its duration.

        signals: what to record, spelled as in a study: "slider_joint/friction", "a/position/x - b/position/x"; `Problem.signals`
        without it. samples: number of equally spaced instants, both ends included.

        Raises ComputationError, with the run as far as it came, if the run fails.
        """
        if isinstance(signals, str):
            signals = [signals]
        failure, table, names, notes = self._core.simulate(rho, parameters, list(() if signals is None else signals), samples)
        run = Run(self, (rho, parameters), failure, table, names, notes)
        if failure is not None:
            raise ComputationError(run.status, run)
        return run

    def linearize(self, rho: Optional[npt.ArrayLike] = None, /, *, at: Optional[float] = None, signals: Optional[Sequence[str]] = None,
                  friction: str = "off", **parameters: float) -> Linearization:
        """Small motions at one design: poles, margins of the controllers, matrices; `codesign linearize`.

        at: time of the run [s]; without it about the equilibrium near the start of the study.
        signals: the outputs. friction: whether it counts about rest, "off", "regularised" or "given_speed".

        Raises ComputationError if there is no equilibrium, or the run fails before.
        """
        if isinstance(signals, str):
            signals = [signals]
        failure, record = self._core.linearize(rho, parameters, list(() if signals is None else signals), friction, at)
        if failure is not None:
            raise ComputationError(Status(**failure))
        return Linearization(record)

    def _evaluate(self, rho: Optional[npt.ArrayLike], parameters: Dict[str, float], derivatives: int,
                  by_adjoint: bool = False) -> Tuple[float, Array, Array]:
        """(psi, gradient, empty); with `derivatives` 2 (psi, residuals, their Jacobian)."""
        failure, value, first, second, doubts = self._core.evaluate(rho, parameters, derivatives, by_adjoint)
        if failure is not None:
            raise ComputationError(Status(**failure))
        for warning in doubts or ():
            warnings.warn(Warning(**warning), stacklevel=3)
        return value, first, second

    def objective(self, rho: Optional[npt.ArrayLike] = None, /, **parameters: float) -> float:
        """psi, the objective of the study over all its runs and samples, in the unit of its terms."""
        return self._evaluate(rho, parameters, 0)[0]

    def gradient(self, rho: Optional[npt.ArrayLike] = None, /, **parameters: float) -> Tuple[float, Array]:
        """(psi, d psi / d rho), the gradient of shape (p,) by the study's method; doc/theory.md (22)."""
        return self._evaluate(rho, parameters, 1)[:2]

    def adjoint(self, rho: Optional[npt.ArrayLike] = None, /, **parameters: float) -> Tuple[float, Array]:
        """gradient() by the adjoint, whatever `solver.gradient` says: about four simulations for any number of parameters.

        `solver.sensitivity_tolerance` does not hold, since there are no sensitivities. Raises InputError for a study without adjoint
        (integrator idas, bounds on signals, peaks).
        """
        return self._evaluate(rho, parameters, 1, True)[:2]

    def __call__(self, rho: npt.ArrayLike) -> Tuple[float, Array]:
        """gradient(rho): scipy.optimize.minimize(problem, problem.start, jac=True, bounds=problem.bounds)."""
        return self._evaluate(rho, {}, 1)[:2]

    def residuals(self, rho: Optional[npt.ArrayLike] = None, /, **parameters: float) -> Array:
        """Residuals r of the objective as a sum of squares, shape (p + 1,): r @ r is psi and 2 jacobian().T @ r its gradient.

        psi is an integral over all times, so there are infinitely many residuals. These are their p components in the space of the
        Jacobian's columns and the length of the rest: a Gauss-Newton or Levenberg-Marquardt method takes the same steps with them. For
        scipy.optimize.least_squares(problem.residuals, problem.start, problem.jacobian). Raises InputError for an objective with a
        peak, negative weights, or another measure than the mean.
        """
        return self._squares(rho, parameters)[0]

    def jacobian(self, rho: Optional[npt.ArrayLike] = None, /, **parameters: float) -> Array:
        """The Jacobian of residuals(), shape (p + 1, p): the triangular root R of J.T J, and a row of zeros; doc/theory.md (22a)."""
        return self._squares(rho, parameters)[1]

    def _squares(self, rho: Optional[npt.ArrayLike], parameters: Dict[str, float]) -> Tuple[Array, Array]:
        key = (None if rho is None else _core.numbers(rho, "rho").tobytes(), tuple(parameters.items()))
        known, squares = self._last
        if known != key:  # both are asked for at the same point
            squares = self._evaluate(rho, parameters, 2)[1:]
            self._last = key, squares
        return squares[0].copy(), squares[1].copy()

    def optimize(self, progress: Optional[Callable[[Union[Trial, Stage]], object]] = None, cancel: Optional[Event] = None) -> Result:
        """The best design within bounds and constraints: `codesign optimize`.

        progress: called with each trial point (Trial) and about once a second (Stage), from any thread; `print` prints the lines of the
        command line. Its exception ends the search and is raised. cancel: an event of `threading`; soon after it is set, the search
        ends with the status "cancelled" and the best point so far.

        The status of the result says whether there is a better design; only bad input raises.
        """
        def tell(line: str, fields: Dict[str, Any]) -> None:
            assert progress is not None
            progress(Stage(line, **fields) if "stage" in fields else Trial(line, **fields))

        return Result(self._core.optimize(None if progress is None else tell, _event(cancel)), self)

    def tradeoff(self, points: Optional[int] = None, *, progress: Optional[Callable[[TradeoffPoint], object]] = None,
                 cancel: Optional[Event] = None) -> Tradeoff:
        """The best designs between the objectives of the study's `tradeoff`: `codesign tradeoff`.

        points: their number along the curve, by default 11; of three objectives along each side of the triangle, by default 5. progress:
        called after each search. cancel: as in optimize(); the points so far are kept.
        """
        def tell(line: str, fields: Dict[str, Any]) -> None:
            assert progress is not None
            progress(TradeoffPoint(fields, line))

        return Tradeoff(self._core.tradeoff(0 if points is None else points, None if progress is None else tell, _event(cancel)))

    def identify(self, time: Union[npt.ArrayLike, Recording, Sequence[Recording], None] = None, position: Optional[Columns] = None,
                 effort: Optional[Columns] = None, *, velocity: Optional[Columns] = None, joints: Optional[Sequence[str]] = None,
                 holdout: Union[Recording, Sequence[Recording]] = (), evaluate: bool = False,
                 progress: Optional[Callable[[FitTrial], object]] = None, cancel: Optional[Event] = None) -> Fit:
        """Fits the tuned parameters to a recorded motion: `codesign identify` with arrays in place of files.

        time: of one recording, shape (n,), ascending [s]; or a Recording, or several. position, velocity, effort, joints: of the one
        recording, as Recording takes them. The block `identify:` of the study, which may be missing, says how; the recordings that it
        names are not read. Without arrays they are.

        holdout: recordings by which the fit is judged, and which it does not see.

        evaluate: fit nothing; the result has residuals, shares and doubts of the model as it stands, `codesign identify --evaluate`.

        progress, cancel: as in optimize().
        """
        if time is None and not (position is None and velocity is None and effort is None):
            raise TypeError("identify() with arrays needs their times")
        data = [] if time is None else _recordings(time, (position, velocity, effort, joints))
        apart = [holdout] if isinstance(holdout, Recording) else list(holdout)
        if apart and not data and not evaluate:
            raise TypeError("identify() with a holdout of arrays needs recordings of arrays")
        named = ["arrays"] if len(data) == 1 and not apart else [f"recordings[{k}]" for k in range(len(data))]
        tables = [each._table(name, self.joints) for name, each in zip(named, data)]  # pylint: disable=protected-access
        others = [each._table(f"holdout[{k}]", self.joints) for k, each in enumerate(apart)]  # pylint: disable=protected-access

        def tell(line: str, fields: Dict[str, Any]) -> None:
            assert progress is not None
            progress(FitTrial(line, **fields))

        return Fit(self._core.identify(tables if data or apart else None, others, not evaluate, None if progress is None else tell, _event(cancel)))

    def regressor(self, time: Union[npt.ArrayLike, Recording, Sequence[Recording]], position: Optional[Columns] = None, *,
                  velocity: Optional[Columns] = None, joints: Optional[Sequence[str]] = None, rho: Optional[npt.ArrayLike] = None,
                  **parameters: float) -> Regressor:
        """The derivatives of the efforts that a recorded motion needs by the tuned parameters, and its base parameters.

        time, position, velocity, joints: as in identify(); efforts need not be recorded. The filter of the block `identify:` counts as
        in a fit: without one, accelerations are differences of the samples.

        Raises ComputationError if the efforts cannot be computed.
        """
        tables = [each._table(f"recordings[{k}]", self.joints)  # pylint: disable=protected-access
                  for k, each in enumerate(_recordings(time, (position, velocity, None, joints)))]
        failure, *found = self._core.regressor(tables, rho, parameters)
        if failure is not None:
            raise ComputationError(Status(**failure))
        return Regressor(*found)

    def __repr__(self) -> str:
        return f"<Problem {self._core.name}: {_notebook.extent(*self._core.extent)}, {len(self.names)} tuned parameters>"

    def _repr_html_(self) -> str:
        return _notebook.problem(self._core.name, _notebook.extent(*self._core.extent), self)


def _event(cancel: Optional[Event]) -> Optional[Event]:
    if cancel is not None and not callable(getattr(cancel, "is_set", None)):
        raise TypeError(f"cancel needs is_set(), as threading.Event has it, not {cancel!r}")
    return cancel


def _recordings(time: Union[npt.ArrayLike, Recording, Sequence[Recording]], given: Tuple[Any, ...]) -> List[Recording]:
    """The recordings that a call is about. given: position, velocity, effort and joints."""
    position, velocity, effort, joints = given
    several: Any = [time] if isinstance(time, Recording) else time
    if isinstance(several, (list, tuple)) and several and all(isinstance(each, Recording) for each in several):
        if not all(each is None for each in given):
            raise TypeError("a Recording takes no columns beside it")
        return list(several)
    return [Recording(several, position, effort, velocity=velocity, joints=joints)]
