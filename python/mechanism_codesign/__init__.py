# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms with joint friction: simulation, exact gradients, co-design, identification.

    import mechanism_codesign as codesign

    problem = codesign.Problem(**codesign.case("slider_crank"))   # or paths, or texts, of model and study
    run = problem.simulate(crank_length=0.07)           # run.time, run["slider_joint/friction"]
    value, gradient = problem.gradient(crank_length=0.07)
    result = problem.optimize(progress=print)

All numbers are in SI units and radians, as in the files; doc/python.md describes the interface.
With ROS the package also holds the generated messages, mechanism_codesign.msg and .srv.
"""
from typing import TYPE_CHECKING as _TYPE_CHECKING

if _TYPE_CHECKING:
    from ._cases import case as case
    from ._core import version as version
    __version__: str
    from ._errors import ComputationError as ComputationError
    from ._errors import InputError as InputError
    from ._errors import OutputError as OutputError
    from ._errors import Status as Status
    from ._errors import Warning as Warning
    from ._linear import Linearization as Linearization
    from ._linear import TransferFunction as TransferFunction
    from ._problem import Parameter as Parameter
    from ._problem import Problem as Problem
    from ._recording import Recording as Recording
    from ._results import BaseParameter as BaseParameter
    from ._results import Fit as Fit
    from ._results import FitTrial as FitTrial
    from ._results import Number as Number
    from ._results import Regressor as Regressor
    from ._results import Result as Result
    from ._results import Run as Run
    from ._results import Stage as Stage
    from ._results import Trial as Trial
    from ._tradeoff import Tradeoff as Tradeoff
    from ._tradeoff import TradeoffPoint as TradeoffPoint

# Imported when they are first used: scripts that only read messages need neither numpy nor the library.
_MODULES = {
    "case": "_cases", "version": "_core", "Problem": "_problem", "Parameter": "_problem",
    "ComputationError": "_errors", "InputError": "_errors", "OutputError": "_errors", "Status": "_errors", "Warning": "_errors",
    "Linearization": "_linear", "Recording": "_recording", "TransferFunction": "_linear",
    "BaseParameter": "_results", "Fit": "_results", "FitTrial": "_results", "Number": "_results", "Regressor": "_results", "Result": "_results", "Run": "_results", "Stage": "_results", "Trial": "_results",
    "Tradeoff": "_tradeoff", "TradeoffPoint": "_tradeoff",
}
__all__ = sorted(_MODULES)


def __getattr__(name: str) -> object:
    if name == "__version__":  # the usual name
        return __getattr__("version")()  # type: ignore[operator]
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    import importlib.util
    if importlib.util.find_spec(__name__ + "._core") is None:
        import sys
        raise ImportError(f"{__name__} has no extension for Python {sys.version.split()[0]}, {sys.executable}: it is built for /usr/bin/python3, and "
                          "only where pybind11-dev and python3-dev are installed (tools/setup)")
    value = globals()[name] = getattr(importlib.import_module("." + _MODULES[name], __name__), name)
    return value


def __dir__() -> "list[str]":
    return sorted(set(globals()) | set(__all__))
