# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Pages of HTML as files."""
from __future__ import annotations

import os

from ._errors import OutputError


def written(html: str, path: "str | os.PathLike[str] | None") -> str:
    """A page, also written to `path` if it is given. Raises OutputError."""
    from .codesign_report import output  # type: ignore  # scripts/codesign_report
    if path is not None:
        try:
            output.write_output(path, html)
        except OSError as error:
            raise OutputError(f"{os.fspath(path)}: cannot be written: {error.strerror}") from error
    return str(html)
