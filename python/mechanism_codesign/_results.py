# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What computations return."""
from __future__ import annotations

import functools
import os
import tempfile
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _core, _notebook
from ._errors import ComputationError, OutputError, Status, Warning

if TYPE_CHECKING:
    from ._problem import Problem

Array = npt.NDArray[np.float64]


class Run(Mapping):  # type: ignore[type-arg]
    """A simulated motion: `run.time`, and `run["slider_joint/friction"]` for each recorded signal, numpy arrays of shape (samples,) that
    share the memory of the run and are read-only. A mapping: dict(run), pandas.DataFrame(dict(run), index=run.time).
    """

    def __init__(self, problem: "Problem", design: Tuple[Any, Dict[str, float]], failure: Optional[Dict[str, Any]], table: Array,
                 names: List[str], notes: "_core.RunNotes"):
        self.time: Array = table[0]  #: [s]
        self.status = Status("success", "", float(self.time[-1])) if failure is None else Status(**failure)
        rho, parameters = design
        self._problem, self._notes = problem, notes
        self._design = None if rho is None else np.array(rho, float), parameters  # as it is now
        self._columns = dict(zip(names[1:], table[1:]))

    @functools.cached_property
    def _record(self) -> Dict[str, Any]:
        return self._notes.record()

    @property
    def objective(self) -> Optional[float]:
        """psi of this run; None if the study has no objective."""
        return self._record["objective"]  # type: ignore[no-any-return]

    @property
    def parameters(self) -> Dict[str, float]:
        """Every named parameter, in SI units."""
        return dict(self._record["parameters"])

    @property
    def statistics(self) -> Dict[str, float]:
        """steps, rejected_steps, explicit_steps, cpu_seconds, constraint_drift, energy_error."""
        return {key: self._record[key] for key in (
            "steps", "rejected_steps", "explicit_steps", "cpu_seconds", "constraint_drift", "energy_error")}

    @property
    def limits_exceeded(self) -> List[Dict[str, Any]]:
        """Limits of the model that the motion exceeds: joint, limit, bound, worst, time."""
        return list(self._record["limits_exceeded"])

    @property
    def methods(self) -> List[Dict[str, Any]]:
        """From when on [s] which method took the steps: from, method."""
        return list(self._record["methods"])

    @property
    def warnings(self) -> List[Warning]:
        """About the run."""
        return [Warning(**w) for w in self._record["warnings"]]

    def __getitem__(self, signal: str) -> Array:
        try:
            column: Array = self._columns[signal]
            return column
        except KeyError:
            raise KeyError(f"{signal!r} is not recorded in this run; recorded are {', '.join(self._columns)}; simulate(signals=[...]) "
                           "records others") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return f"<Run: {self.status.code}, {len(self.time)} samples of {len(self)} signals>"

    def _repr_html_(self) -> str:
        return _notebook.run(self)


class _Progress:
    """`str()` is the line of the command line."""

    line: str

    def __str__(self) -> str:
        return self.line


class Trial(_Progress):
    """One trial point of a search."""

    def __init__(self, line: str, evaluation: int, iteration: int, start: int, status: Dict[str, Any], objective: float, gradient_norm: float,
                 best_objective: float, best_violation: float, parameters: Dict[str, float]):
        self.line = line
        self.evaluation = evaluation  #: from 1
        self.iteration = iteration  #: how often the best point has improved
        self.start = start  #: number of the search among several, from 1; 0: a single one
        self.status = Status(**status)  #: not ok: the search turns back from this point
        self.objective = objective
        self.gradient_norm = gradient_norm  #: by scaled parameters
        self.best_objective = best_objective
        self.best_violation = best_violation  #: of the constraints at the best point; 0: none
        self.parameters = parameters  #: the tuned ones


class Stage(_Progress):
    """The progress of a stage of a search."""

    def __init__(self, line: str, stage: str, done: int, of: int, runs: int, seconds_left: Optional[float]):
        self.line = line
        self.stage = stage  #: "screening", "searching" or "validating"
        self.done, self.of = done, of
        self.runs = runs  #: simulations so far
        self.seconds_left = seconds_left  #: None: not known


class FitTrial(_Progress):
    """One evaluation of a fit."""

    def __init__(self, line: str, evaluation: int, iteration: int, profile: int, status: Dict[str, Any], cost: float, rms: Dict[str, float]):
        self.line = line
        self.evaluation = evaluation  #: from 1
        self.iteration = iteration
        self.profile = profile  #: 0: of the fit; 1, 2, ...: of the profile of this number
        self.status = Status(**status)
        self.cost = cost
        self.rms = rms  #: root mean squares of the residuals by output, in its unit


class _Job:
    """A finished job and its files."""

    def __init__(self, core: Any):
        self._core = core
        self._folder: Optional[str] = None
        #: The whole record, as `--json` prints it and doc/results.md describes it.
        self.record: Dict[str, Any] = core.record
        self.status = Status(**core.status)  #: doc/statuses.md lists the codes
        self.warnings = [Warning(**w) for w in core.warnings]

    @property
    def termination(self) -> str:
        """Why the search ended: "objective_tolerance_reached", "cancelled", ..."""
        return str(self.record["termination"])

    def write(self, folder: "str | os.PathLike[str]") -> None:
        """Writes the files of the command line's `--output` into a folder, which is made if needed; doc/results.md lists them.

        Raises OutputError for files that are missing, InputError if one would replace an input, ComputationError without a point.
        """
        if not self._core.has_point:
            raise ComputationError(self.status)
        self._core.write(os.fspath(folder))
        self._folder = os.path.abspath(folder)

    def report(self, path: "str | os.PathLike[str] | None" = None) -> str:
        """The page of `codesign report` as HTML; also written to `path` if it is given. write() first, and its commands name that folder."""
        from .codesign_report import job, page  # type: ignore[import-not-found]  # scripts/codesign_report
        if self._folder is not None:
            html = page.render(job.find_job(self._folder))
        else:
            with tempfile.TemporaryDirectory(prefix="codesign_") as folder:
                self.write(folder)
                self._folder = None
                html = page.render(job.find_job(folder))
        if path is not None:
            try:
                with open(path, "w", encoding="utf-8") as file:
                    file.write(html)
            except OSError as error:
                raise OutputError(f"{os.fspath(path)}: cannot be written: {error.strerror}") from error
        return str(html)


class Result(_Job):
    """The best design of an optimization and how the search ended."""

    def __init__(self, core: "_core.Optimized", problem: "Problem"):
        super().__init__(core)
        self._problem = problem
        self.best_objectives: Array = core.best_objectives  #: the best objective after each trial point
        self.rho: Array = core.rho  #: the best design, shape (p,); empty if the start could not be evaluated
        self.initial_rho: Array = core.initial_rho
        self.gradient: Array = core.gradient  #: there, shape (p,)
        self.objective: Optional[float] = self.record.get("objective")  #: there; None: not known
        self.initial_objective: Optional[float] = self.record.get("initial_objective")
        #: Every named parameter at the best design, in SI units.
        self.parameters: Dict[str, float] = self.record.get("parameters", {})

    def __str__(self) -> str:
        """The result in words: the lines of `codesign optimize`, then the warnings."""
        return str(self._core.text)

    def __repr__(self) -> str:
        return f"<Result: {self.status.code}, objective {self.initial_objective} -> {self.objective}>"

    def _repr_html_(self) -> str:
        return _notebook.result(self)


class Number(NamedTuple):
    """A number that a fit has found."""

    value: float  #: in `unit`
    start: float
    unit: str
    deviation: Optional[float]  #: standard deviation; None: on its bound
    interval: Optional[Tuple[float, float]]  #: at the level of `identify.intervals`, by default 95 %; None: on its bound
    determined: bool  #: whether the data determine it
    on_bound: bool


class Fit(_Job):
    """The numbers that were identified, and how well they are known."""

    def __init__(self, core: "_core.Identified"):
        super().__init__(core)
        #: By name, in the order of `covariance`.
        self.numbers: Dict[str, Number] = {
            name: Number(entry["value"], entry["start"], entry["unit"], entry["deviation"],
                         None if entry["interval"] is None else tuple(entry["interval"]), entry["determined"], entry["on_bound"])
            for name, entry in self.record.get("identified", {}).items()}
        self.parameters: Dict[str, float] = self.record.get("parameters", {})  #: every named one with its value in the fit
        self.covariance: Array = core.covariance  #: shape (len(numbers), len(numbers))
        self.time: Array = core.time  #: of the fitted samples, shape (n,) [s]
        outputs = list(self.record.get("data", {}).get("joints", {}))
        self.recorded: Dict[str, Array] = dict(zip(outputs, core.recorded.T))  #: by output, shape (n,), filtered as the residuals
        self.computed: Dict[str, Array] = dict(zip(outputs, core.computed.T))  #: what the fit computes there

    def __repr__(self) -> str:
        return f"<Fit: {self.status.code}, {', '.join(f'{name} = {n.value:.6g}' for name, n in self.numbers.items())}>"

    def _repr_html_(self) -> str:
        return _notebook.fit(self)
