# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Reads what a job has left: the folder of `codesign optimize` or `codesign identify`, or what is beside a bag of the optimization node."""
import csv
import html
import json
import math
import os
import re

import yaml

from .asked import in_postures


class ReportError(Exception):
    """Bad input; the text is a sentence for the user."""


class Table:
    """A CSV file: columns by name, numbers as floats, empty cells as NaN, texts as they are."""

    def __init__(self, path):
        self.columns = {}
        with open(path, newline="", encoding="utf-8", errors="replace") as file:
            rows = csv.reader(file)
            try:
                self.names = next(rows, [])
                cells = [[] for _ in self.names]
                for row in rows:
                    if len(row) != len(self.names):
                        raise ReportError(f"{path}:{rows.line_num}: {len(row)} cells, the first line has {len(self.names)}; the table is damaged, run the job again")
                    for column, cell in zip(cells, row):
                        column.append(to_value(cell))
            except csv.Error as error:
                raise ReportError(f"{path}:{rows.line_num}: not a table; it is damaged, run the job again") from error
        self.columns = dict(zip(self.names, cells))

    def __getitem__(self, name):
        return self.columns[name]

    def __contains__(self, name):
        return name in self.columns

    def __len__(self):
        return len(self.columns[self.names[0]]) if self.names else 0

    def rows(self):
        """The rows as dictionaries."""
        return [dict(zip(self.names, row)) for row in zip(*(self.columns[name] for name in self.names))]


def to_value(cell):
    if cell == "":
        return math.nan
    try:
        return float(cell)
    except ValueError:
        return cell


def read_text(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()


def read_json(path):
    try:
        value = json.loads(read_text(path))
    except json.JSONDecodeError as error:
        raise ReportError(f"{path}:{error.lineno}: not JSON from column {error.colno} on; the file is damaged, or no output of this program") from error
    except (ValueError, RecursionError) as error:
        raise ReportError(f"{path}: not JSON of this program: a number is too long, or it is nested too deeply") from error
    if not isinstance(value, dict):
        raise ReportError(f"{path}: not a JSON object")
    return value


def read_study(path):
    """The study as text and as a tree; the tree is empty if the text is not YAML."""
    text = read_text(path)
    try:
        tree = yaml.load(text, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except (yaml.YAMLError, RecursionError):
        tree = None
    return text, tree if isinstance(tree, dict) else {}


class Job:
    """The files of one job; what is not there is None, empty, or missing from a dictionary.

    Their names begin with prefix, which is empty but for the identifications of the optimization node."""

    def __init__(self, folder, bag=None, prefix=""):
        self.folder, self.bag, self.prefix = folder, bag, prefix
        self.kind = "identification" if self.has("identification.json") and not self.has("result.json") else "optimization"
        self.result = read_json(self.path("result.json" if self.kind == "optimization" else "identification.json"))
        self.details = read_json(self.path("details.json")) if self.has("details.json") else {}
        self.study_text, self.study = read_study(self.path("job_study.yaml")) if self.has("job_study.yaml") else ("", {})
        self.in_postures = in_postures(self.study)
        self.gains = read_text(self.path("gains.yaml")) if self.has("gains.yaml") else ""
        self.runs = {side: self.table(side + ".csv") for side in ("initial", "tuned")}
        self.convergence, self.starts, self.scenarios, self.residuals = (
            self.table(name + ".csv") for name in ("convergence", "starts", "scenarios", "residuals"))

    def path(self, name):
        return os.path.join(self.folder, self.prefix + name)

    def refuse_to_replace(self, output):
        """A page replaces no file of its job but an earlier page, neither by its own path nor by a link to it."""
        place = os.path.realpath(output)
        if not os.path.exists(place) or place.endswith((".html", ".htm")):
            return
        is_of_job = os.path.dirname(place) == os.path.realpath(self.folder)
        if is_of_job or (self.bag and os.path.samefile(place, self.bag)):
            raise ReportError(f"{output}: the page would replace this file of the job; choose another file with -o")

    def has(self, name):
        return os.path.isfile(self.path(name))

    def table(self, name):
        if not self.has(name):
            return None
        table = Table(self.path(name))
        return table if len(table) else None

    def robot_name(self):
        """The name in the identified model, of a folder without details."""
        found = re.search(r'<robot[^>]*\sname="([^"]*)"', read_text(self.path("identified.urdf"))) if self.has("identified.urdf") else None
        return html.unescape(found.group(1)) if found else ""

    @property
    def name(self):
        return self.details.get("model") or self.robot_name() or self.prefix[:-1] or os.path.basename(os.path.normpath(os.path.abspath(self.folder)))


def find_job(path):
    """The job of a folder, or of a bag with its files beside it; with absolute paths, so that the commands of the page work anywhere."""
    path = os.path.abspath(path)
    if os.path.isdir(path):
        folder, bag = path, None
    elif path.endswith(".bag") and os.path.isfile(path):
        folder, bag = path[:-len(".bag")], path
        if os.path.isfile(folder + ".identification.json"):
            return Job(os.path.dirname(path), bag, os.path.basename(folder) + ".")
        if not os.path.isdir(folder):
            raise ReportError(f"{path}: the folder {folder} with the files of this job is not beside the bag; jobs before 0.2 have none, "
                              "simulate or optimize again")
    else:
        raise ReportError(f"{path}: neither a folder nor a bag nor a file of codesign efforts --json, codesign linearize --json or codesign tradeoff --json")
    if not any(os.path.isfile(os.path.join(folder, name)) for name in ("result.json", "identification.json")):
        raise ReportError(f"{folder}: no result.json and no identification.json; "
                          "codesign optimize --output and codesign identify --output write them")
    return Job(folder, bag)
