# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong: bad input and failed computations as exceptions, doubts as warnings."""
from __future__ import annotations

from typing import Any, Mapping, NamedTuple


class Status(NamedTuple):
    """How a computation ended.

    code: "success", "cancelled", "step_size_too_small", ...; doc/statuses.md lists them.
    message: one sentence; empty on success.
    time: simulated time at which it ended [s].
    """

    code: str
    message: str
    time: float

    @property
    def ok(self) -> bool:
        """Whether the computation came to its end."""
        return self.code == "success"

    def __str__(self) -> str:
        return f"{self.code}: {self.message}" if self.message else self.code


class Warning(UserWarning):
    """Something doubtful that does not stop the work; doc/warnings.md lists the codes.

    Objects with results have a list `warnings` of these. Of what returns plain numbers, and of the
    files of a Problem, they are issued by Python's module warnings.

    code: snake case, stable: "undetermined_friction".
    message: the sentence, with place and remedy.
    file: its path or name; empty where no file is the cause.
    line: in the file, from 1; 0: none.
    """

    def __init__(self, code: str, message: str, file: str = "", line: int = 0):
        super().__init__(code, message, file, line)
        self.code = code
        self.message = message
        self.file = file
        self.line = line

    def __str__(self) -> str:
        return f"{self.message} [{self.code}]"


class InputError(ValueError):
    """Bad input: a file, a text, a name, a value. `str()` names all that is known of it.

    file: its path, or the name of the text; empty where there is none.
    line: in the file, from 1; 0: the file as a whole.
    element: such as `objective.integral[0].signal`.
    value: as written.
    allowed: allowed values or range.
    """

    def __init__(self, fault: Mapping[str, Any]):
        super().__init__(fault)
        self.file: str = fault["file"]
        self.line: int = fault["line"]
        self.element: str = fault["element"]
        self.value: str = fault["value"]
        self.allowed: str = fault["allowed"]

    def __str__(self) -> str:
        return str(self.args[0]["message"])


class OutputError(OSError):
    """A file that cannot be written."""


class ComputationError(RuntimeError):
    """A run or an evaluation that could not be finished, such as a loop that cannot be closed.

    status: Status of the failure.
    run: of simulate(): the Run as far as it came; else None.
    """

    def __init__(self, status: Status, run: Any = None):
        super().__init__(status, run)
        self.status = status
        self.run = run

    def __str__(self) -> str:
        return f"{self.status} (at t = {self.status.time:g} s)"


for _class in (Status, Warning, InputError, OutputError, ComputationError):
    _class.__module__ = __package__  # as tracebacks name it
