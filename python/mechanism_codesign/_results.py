# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What computations return."""
from __future__ import annotations

import functools
import os
import tempfile
from collections.abc import Mapping
from typing import Any, cast, Dict, Iterator, List, NamedTuple, Optional, Tuple, TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from . import _core, _notebook, _pages
from ._errors import ComputationError, Status, Warning

if TYPE_CHECKING:
    from ._problem import Problem

Array = npt.NDArray[np.float64]


class Run(Mapping[str, Array]):
    """A simulated motion: `run["slider_joint/friction"]` is an array of shape (samples,) in the unit of the signal.

    A mapping from the recorded signals to their values: dict(run), pandas.DataFrame(dict(run), index=run.time). The arrays share the
    memory of the run and are read-only.

    time: of each sample, shape (samples,) [s]; in a study of postures their numbers, from 0.
    status: Status of the run.
    """

    def __init__(self, problem: "Problem", design: Tuple[Any, Dict[str, float]], failure: Optional[Dict[str, Any]], table: Array,
                 names: List[str], notes: "_core.RunNotes"):
        self.time: Array = table[0]
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
        """psi of this run, in the unit of its terms; None if the study has no objective."""
        return self._record["objective"]  # type: ignore[no-any-return]

    @property
    def parameters(self) -> Dict[str, float]:
        """Every named parameter, in SI units."""
        return dict(self._record["parameters"])

    @property
    def statistics(self) -> Dict[str, float]:
        """steps, rejected_steps, explicit_steps, cpu_seconds [s], constraint_drift (over the error tolerance), energy_error (relative)."""
        return {key: self._record[key] for key in (
            "steps", "rejected_steps", "explicit_steps", "cpu_seconds", "constraint_drift", "energy_error")}

    @property
    def limits_exceeded(self) -> List[Dict[str, Any]]:
        """Limits of the model that the motion exceeds: joint, limit, bound and worst in the unit of the limit, time [s]."""
        return list(self._record["limits_exceeded"])

    @property
    def events(self) -> List[Dict[str, Any]]:
        """Instants at which a formula switched, at most 500: time [s], element, object, expression, direction ("rising" or "falling"), kind ("jump" or "kink")."""
        return list(self._record["events"])

    @property
    def event_count(self) -> int:
        """Number of all events of the run."""
        return int(self._record["event_count"])

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
            return cast("Array", self._columns[signal])
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
    line: str

    def __str__(self) -> str:
        return self.line


class Trial(_Progress):
    """One trial point of a search; `str()` is the line of the command line.

    line: this line.
    evaluation: number of the trial point, from 1.
    iteration: how often the best point has improved.
    start: number of the search among several, from 1; 0: a single one.
    status: Status of the evaluation; if it is not ok the search turns back from this point.
    objective: psi, in the unit of its terms; not valid if the status is not ok.
    gradient_norm: of its gradient by the scaled parameters, in the same unit.
    best_objective: psi of the best point so far, in the same unit.
    best_violation: of the constraints at the best point, in the unit of the constraint that is violated most; 0: none.
    events: number of events in its runs: instants at which formulas switch.
    parameters: the tuned ones by name, in SI units.
    """

    def __init__(self, line: str, evaluation: int, iteration: int, start: int, status: Dict[str, Any], objective: float, gradient_norm: float,
                 best_objective: float, best_violation: float, events: int, parameters: Dict[str, float]):
        self.line = line
        self.evaluation = evaluation
        self.iteration = iteration
        self.start = start
        self.status = Status(**status)
        self.objective = objective
        self.gradient_norm = gradient_norm
        self.best_objective = best_objective
        self.best_violation = best_violation
        self.events = events
        self.parameters = parameters


class Stage(_Progress):
    """The progress of a stage of a search; `str()` is the line of the command line.

    line: this line.
    stage: "screening", "searching" or "validating".
    done, of: points, searches, evaluations or runs that are finished, and how many the stage has at most.
    runs: simulations so far.
    seconds_left: until the end of the stage [s]; None: not known.
    """

    def __init__(self, line: str, stage: str, done: int, of: int, runs: int, seconds_left: Optional[float]):
        self.line = line
        self.stage = stage
        self.done, self.of = done, of
        self.runs = runs
        self.seconds_left = seconds_left


class FitTrial(_Progress):
    """One evaluation of a fit; `str()` is the line of the command line.

    line: this line.
    evaluation: its number, from 1.
    iteration: how often the best point has improved.
    profile: 0: of the fit; 1, 2, ...: of the profile of this number.
    status: Status of the evaluation; if it is not ok the fit turns back from this point.
    cost: the loss of all residuals over their spreads, without unit; infinite if the status is not ok.
    rms: root mean squares of the residuals by output, in its unit.
    """

    def __init__(self, line: str, evaluation: int, iteration: int, profile: int, status: Dict[str, Any], cost: float, rms: Dict[str, float]):
        self.line = line
        self.evaluation = evaluation
        self.iteration = iteration
        self.profile = profile
        self.status = Status(**status)
        self.cost = cost
        self.rms = rms


class _Job:
    """A finished job and its files."""

    def __init__(self, core: Any):
        self._core = core
        self._folder: Optional[str] = None
        self._record: Dict[str, Any] = core.record
        self._status = Status(**core.status)
        self._warnings = [Warning(**w) for w in core.warnings]

    @property
    def record(self) -> Dict[str, Any]:
        """All of the job, as `--json` prints it; doc/json.md lists its keys with their units."""
        return self._record

    @property
    def status(self) -> Status:
        """How the job ended; doc/statuses.md lists the codes."""
        return self._status

    @property
    def warnings(self) -> List[Warning]:
        """About the job and what it found."""
        return self._warnings

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
        from .codesign_report import job, page  # type: ignore  # scripts/codesign_report
        if self._folder is not None:
            html = page.render(job.find_job(self._folder))
        else:
            with tempfile.TemporaryDirectory(prefix="codesign_") as folder:
                self.write(folder)
                self._folder = None
                html = page.render(job.find_job(folder))
        return _pages.written(html, path)


class Result(_Job):
    """The best design of an optimization and how the search ended. `str()` is the result in words.

    rho, initial_rho: the best design and the start, shape (p,), in SI units and the order of Problem.names; empty if the start could not
        be evaluated.
    gradient: d psi / d rho at the best design, shape (p,) [unit of psi per unit of the parameter].
    objective, initial_objective: psi at the best design and at the start, in the unit of its terms; None: not known.
    best_objectives: psi of the best point after each trial point, shape (trial points,), in the same unit.
    parameters: every named parameter at the best design, in SI units.
    """

    def __init__(self, core: "_core.Optimized", problem: "Problem"):
        super().__init__(core)
        self._problem = problem
        self.best_objectives: Array = core.best_objectives
        self.rho: Array = core.rho
        self.initial_rho: Array = core.initial_rho
        self.gradient: Array = core.gradient
        self.objective: Optional[float] = self.record.get("objective")
        self.initial_objective: Optional[float] = self.record.get("initial_objective")
        self.parameters: Dict[str, float] = self.record.get("parameters", {})

    def __str__(self) -> str:
        """The result in words: the lines of `codesign optimize`, then the warnings."""
        return str(self._core.text)

    def __repr__(self) -> str:
        return f"<Result: {self.status.code}, objective {self.initial_objective} -> {self.objective}>"

    def _repr_html_(self) -> str:
        return _notebook.result(self)


class Number(NamedTuple):
    """A number that a fit has found.

    value, start: in the fit and before it, in `unit`.
    unit: of the number; empty: none is named.
    deviation: its standard deviation, in `unit`; None: on its bound.
    interval: (lower, upper) in `unit`, at the level of `identify.intervals`, by default 95 %; None: on its bound.
    determined: whether the data determine it.
    on_bound: whether it lies on one of its bounds.
    """

    value: float
    start: float
    unit: str
    deviation: Optional[float]
    interval: Optional[Tuple[float, float]]
    determined: bool
    on_bound: bool


class BaseParameter(NamedTuple):
    """A combination of numbers that the data determine.

    value, deviation: in SI units.
    interval: (lower, upper) at the level of `identify.intervals`.
    """

    value: float
    deviation: float
    interval: Tuple[float, float]


class Fit(_Job):
    """The numbers that were identified, and how well they are known.

    numbers: Number by name, k of them, in the order of `covariance`.
    base: BaseParameter by expression, of the numbers that the data do not determine each; free inertias by mass and moments.
    parameters: every named parameter with its value in the fit, in SI units.
    covariance: of the numbers, shape (k, k) [product of their units].
    time: of the n fitted samples, shape (n,) [s].
    recorded: by output, shape (n,) [N m or N; with `residual: motion` the unit of the measured quantity], filtered as the residuals.
    computed: what the fit computes there, by output, shape (n,), in the same unit.
    """

    def __init__(self, core: "_core.Identified"):
        super().__init__(core)
        self.numbers: Dict[str, Number] = {
            name: Number(entry["value"], entry["start"], entry["unit"], entry["deviation"],
                         None if entry["interval"] is None else (entry["interval"][0], entry["interval"][1]), entry["determined"], entry["on_bound"])
            for name, entry in self.record.get("identified", {}).items()}
        self.base: Dict[str, BaseParameter] = {
            entry["expression"]: BaseParameter(entry["value"], entry["deviation"], (entry["interval"][0], entry["interval"][1]))
            for entry in self.record.get("combinations", [])}
        self.parameters: Dict[str, float] = self.record.get("parameters", {})
        self.covariance: Array = core.covariance
        self.time: Array = core.time
        outputs = list(self.record.get("data", {}).get("joints", {}))
        self.recorded: Dict[str, Array] = dict(zip(outputs, core.recorded.T))
        self.computed: Dict[str, Array] = dict(zip(outputs, core.computed.T))

    def against(self, other: "Fit | str | os.PathLike[str]") -> Dict[str, Any]:
        """Compares with another fit or evaluation of the same recordings, or with an identification.json: `codesign identify --against`.

        `criterion`: Akaike's, here minus there, negative where this one is expected to predict better; for nested models the likelihood
        ratio `statistic`, its `degrees` and the `probability` of one as large by chance; `data` and `holdout`: residuals and shares there
        and here. `refusal` says why there is no criterion.
        """
        if isinstance(other, Fit):
            return dict(self._core.against("the other fit", other._core.json))
        with open(other, encoding="utf-8") as file:
            return dict(self._core.against(os.fspath(other), file.read()))

    def __repr__(self) -> str:
        return f"<Fit: {self.status.code}, {', '.join(f'{name} = {n.value:.6g}' for name, n in self.numbers.items())}>"

    def _repr_html_(self) -> str:
        return _notebook.fit(self)


class Regressor:
    """The efforts that recorded motions need, as functions of the numbers of an identification, to first order.

    Of numbers in which efforts are linear it is the regressor. Free inertias appear by such numbers: `LINK_m` [kg], `LINK_mx`, `my`, `mz`
    [kg m] and `LINK_Jxx` ... [kg m2] about the origin of the link.

    outputs: joints whose motion determines all, k of them, then the signals.
    names, values: of the p numbers, those of the sensors behind those of the model, shape (p,), in SI units.
    time: of the n rows of all recordings, shape (n,) [s].
    lengths: rows of each recording.
    computed: efforts at `values`, shape (n, k) [N m or N], with an offset of a sensor only if it is one of the numbers.
    matrix: d effort / d number, shape (n, k, p), in SI units. `regressor[NAME]` is the part of one number, shape (n, k).
    base_names, base_values: of the b combinations of the numbers that the motion determines, the base parameters, shape (b,), in SI units.
    base: their columns of the matrix, shape (n, k, b), in SI units: `base @ base_values` is `matrix @ values`.
    """

    def __init__(self, outputs: List[str], lengths: List[float], time: Array, computed: Array, names: List[str], values: Array,
                 matrix: Array, base_names: List[str], base_values: Array, base_columns: List[int]):
        self.outputs = outputs
        self.lengths = [int(length) for length in lengths]
        self.time = time
        self.computed = computed
        self.names = names
        self.values = values
        self.matrix: Array = np.ascontiguousarray(np.moveaxis(matrix.reshape(len(outputs), len(time), len(names)), 0, 1))
        self.base_names = base_names
        self.base_values = base_values
        self.base: Array = self.matrix[:, :, base_columns]

    def __getitem__(self, name: str) -> Array:
        if name not in self.names:
            raise KeyError(name)
        return self.matrix[:, :, self.names.index(name)]

    def __repr__(self) -> str:
        return f"<Regressor: {len(self.time)} rows of {', '.join(self.outputs)}, {len(self.base_names)} base parameters of {len(self.names)} numbers>"
