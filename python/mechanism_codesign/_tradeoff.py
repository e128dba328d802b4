# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Trade-offs between objectives."""
from __future__ import annotations

from typing import Any, Dict, List, Optional, TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from . import _core, _pages
from ._errors import Status, Warning

if TYPE_CHECKING:
    import os

Array = npt.NDArray[np.float64]


class TradeoffPoint:
    """One design of a trade-off; `str()` is the line of the command line.

    line: this line; empty of a point of a finished trade-off.
    kind: "on_curve", "stopped_early", "repeated", "dominated" or "failed"; while the job runs no point is yet compared with others.
    anchor: whether it is the least of one objective alone.
    objectives: by name, in the units of their terms; empty if the search failed.
    parameters: every named parameter, in SI units; empty if the search failed.
    status: Status of the search.
    stationarity: of its end, relative to what it minimized, without unit; None: not known.
    evaluations: of the search.
    done, of: while the job runs, the searches that have ended, and how many are planned; else None.
    """

    def __init__(self, record: Dict[str, Any], line: str = ""):
        self.line = line
        self.kind: str = record["kind"]
        self.anchor: bool = record["anchor"]
        self.objectives: Dict[str, float] = record.get("objectives", {})
        self.parameters: Dict[str, float] = record.get("parameters", {})
        self.status = Status(**record["status"])
        self.stationarity: Optional[float] = record["stationarity"]
        self.evaluations: int = record["evaluations"]
        self.done: Optional[int] = record.get("done")
        self.of: Optional[int] = record.get("of")

    def __str__(self) -> str:
        return self.line

    def __repr__(self) -> str:
        return f"<TradeoffPoint: {self.kind}, {self.objectives}>"


class Tradeoff:
    """The designs of which none is better in one objective without being worse in another. `str()` is the table of the command line.

    names: of the k objectives.
    points: n of them, TradeoffPoint, along the curve.
    objectives: shape (n, k), in the units of their terms; not numbers where a search failed.
    rho: shape (n, p), the tuned parameters in the order of Problem.names, in SI units; not numbers where a search failed.
    kinds: of the points.
    status: Status of the job. "cancelled": the points so far are there.
    warnings: about the job.
    """

    def __init__(self, core: "_core.Traded"):
        self._core = core
        self._record: Dict[str, Any] = core.record
        self.status = Status(**core.status)
        self.warnings: List[Warning] = [Warning(**w) for w in core.warnings]
        self.names: List[str] = self._record["objectives"]
        self.points = [TradeoffPoint(point) for point in self._record["points"]]
        self.kinds = [point.kind for point in self.points]
        tuned: List[str] = self._record["tuned"]
        self.objectives: Array = np.array([[point.objectives.get(name, np.nan) for name in self.names] for point in self.points],
                                          float).reshape(-1, len(self.names))
        self.rho: Array = np.array([[point.parameters.get(name, np.nan) for name in tuned] for point in self.points],
                                   float).reshape(-1, len(tuned))

    @property
    def record(self) -> Dict[str, Any]:
        """All of the job, as `--json` prints it; doc/json.md lists its keys with their units."""
        return self._record

    def report(self, path: "str | os.PathLike[str] | None" = None) -> str:
        """The page of `codesign report` as HTML: the curve and the design of each point; also written to `path` if it is given."""
        from .codesign_report import page, tradeoff  # type: ignore  # scripts/codesign_report
        return _pages.written(page.render(tradeoff.Tradeoff("trade-off", self._record)), path)

    def __str__(self) -> str:
        return str(self._core.text)

    def __repr__(self) -> str:
        return f"<Tradeoff of {', '.join(self.names)}: {self.status.code}, {len(self.points)} points>"
