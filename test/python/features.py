# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The small studies of test/features, one for each feature of machines, with runs and an uncertain number each."""
import collections
import pathlib
import re

FOLDER = pathlib.Path(__file__).resolve().parents[1] / "features"
Feature = collections.namedtuple("Feature", "name model study signals")


def features():
    """All of them, with the signals that the line `# signals:` of the study names."""
    found = []
    for study in sorted(FOLDER.glob("*.yaml")):
        signals = re.search(r"^# signals: (.*)$", study.read_text(encoding="utf-8"), re.M).group(1).split(", ")
        found.append(Feature(study.stem, str(study.with_suffix(".urdf")), str(study), signals))
    return found
