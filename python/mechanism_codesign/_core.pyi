# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The extension, src/python/module.cc: numbers, names and records for the Python code of this package."""
from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Source = Tuple[str, Optional[str]]
Tell = Optional[Callable[[str, Dict[str, Any]], object]]

def version() -> str:
    """The version of the package, such as "0.3.0"."""

def numbers(values: npt.ArrayLike, name: str, /) -> Array:
    """The values as real numbers, shape (n,). Raises TypeError or ValueError with this name."""

class Optimized:
    record: Dict[str, Any]
    status: Dict[str, Any]
    warnings: List[Dict[str, Any]]
    text: str
    has_point: bool
    best_objectives: Array
    rho: Array
    initial_rho: Array
    gradient: Array
    def write(self, folder: str, /) -> None: ...

class Identified:
    record: Dict[str, Any]
    status: Dict[str, Any]
    warnings: List[Dict[str, Any]]
    has_point: bool
    covariance: Array
    time: Array
    recorded: Array
    computed: Array
    json: str
    def against(self, name: str, text: str, /) -> Dict[str, Any]: ...
    def write(self, folder: str, /) -> None: ...

class Traded:
    record: Dict[str, Any]
    status: Dict[str, Any]
    warnings: List[Dict[str, Any]]
    text: str

class RunNotes:
    def record(self) -> Dict[str, Any]: ...

class Session:
    parameters: List[Tuple[str, float, float, float, str, bool]]
    joints: List[str]
    names: List[str]
    name: str
    duration: float
    extent: Tuple[float, int, bool, int, int, bool]
    start: Array
    signals: List[str]
    warnings: List[Dict[str, Any]]
    def evaluate(self, rho: Optional[npt.ArrayLike], settings: Dict[str, float], derivatives: int,
                 by_adjoint: bool, /) -> Tuple[Optional[Dict[str, Any]], float, Array, Array, Optional[List[Dict[str, Any]]]]: ...
    def simulate(self, rho: Optional[npt.ArrayLike], settings: Dict[str, float], signals: List[str],
                 samples: int, /) -> Tuple[Optional[Dict[str, Any]], Array, List[str], RunNotes]: ...
    def linearize(self, rho: Optional[npt.ArrayLike], settings: Dict[str, float], signals: List[str], friction: str,
                  at: Optional[float], /) -> Tuple[Optional[Dict[str, Any]], Dict[str, Any]]: ...
    def details(self, rho: Optional[npt.ArrayLike], settings: Dict[str, float], /) -> Dict[str, Any]: ...
    def urdf(self, rho: Optional[npt.ArrayLike], settings: Dict[str, float], /) -> str: ...
    def optimize(self, progress: Tell, cancel: Optional[Any], /) -> Optimized: ...
    def tradeoff(self, points: int, progress: Tell, cancel: Optional[Any], /) -> Traded: ...
    def identify(self, data: Optional[List[Tuple[Any, ...]]], holdout: List[Tuple[Any, ...]], fitted: bool, progress: Tell,
                 cancel: Optional[Any], /) -> Identified: ...
    def regressor(self, data: List[Tuple[Any, ...]], rho: Optional[npt.ArrayLike], settings: Dict[str, float], /) -> Tuple[Any, ...]: ...

def open(model: Source, study: Optional[Source], overlays: List[Source], settings: Dict[str, float],
         design: Optional[Source], /) -> Session: ...
