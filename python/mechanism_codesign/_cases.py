# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The models and studies that come with the package, wherever it is installed."""
from __future__ import annotations

import difflib
import importlib.util
import pathlib
from typing import Dict, List, TypedDict

from ._errors import InputError


class Case(TypedDict):
    """Paths of a shipped case, named as the arguments of Problem."""

    model: str
    study: str
    overlays: List[str]


def _package() -> pathlib.Path:
    """The folder of urdf/, config/ and gallery/: scripts/, with the page of `codesign report`, is beside them in a checkout and an installation."""
    page = importlib.util.find_spec(f"{__package__}.codesign_report")
    assert page is not None and page.origin is not None
    return pathlib.Path(page.origin).resolve().parent.parent.parent


def _all() -> Dict[str, Case]:
    """By name: the cases of the launch files, each with its overlay if it has one, and the machines of the gallery."""
    package = _package()
    cases: Dict[str, Case] = {}
    for study in sorted((package / "config").glob("*.yaml")):
        model, overlay = (package / folder / f"{study.stem}.urdf" for folder in ("urdf", "urdf/overlays"))
        if model.exists():
            cases[study.stem] = {"model": str(model), "study": str(study), "overlays": [str(overlay)] if overlay.exists() else []}
    for study in sorted((package / "gallery").glob("*/study.yaml")):
        cases[f"gallery/{study.parent.name}"] = {"model": str(study.parent / "model.urdf"), "study": str(study), "overlays": []}
    return cases


def case(name: str) -> Case:
    """Paths of a case that comes with the package: Problem(**case("slider_crank")).

    name: of a pair of files in urdf/ and config/, as `case:=` of the launch files, or "gallery/MACHINE" of a machine of the gallery.

    Returns the arguments `model`, `study` and `overlays` of Problem. Raises InputError, with all names, for one that there is not.
    """
    cases = _all()
    if name in cases:
        return cases[name]
    near = difflib.get_close_matches(str(name), cases, 1)
    hint = f', did you mean "{near[0]}"?' if near else ""
    allowed = ", ".join(cases)
    raise InputError({"file": "arguments", "line": 0, "element": "case", "value": str(name), "allowed": allowed,
                      "message": f"arguments: case: unknown case{hint} (value: {name}, allowed: a case or a machine of the gallery: {allowed})"})
