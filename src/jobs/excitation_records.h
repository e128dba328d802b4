// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "excitation/excitation_result.h"
#include "jobs/json_type.h"
#include "mechanism_codesign/problem.h"
#include "problem/load_problem.h"

namespace codesign {

/// excitation.json, doc/study.md: `predicted` (by name: nominal value, deviation and half the interval before and after), `volume_factor`,
/// `undetermined`, `limits`, `trajectory`, `starts`, and counts. Infinite numbers are null.
Json excitation_json(const Problem& problem, const ExcitationResult& result);

/// A summary for people, one sentence per line: the numbers that no trajectory determines, and the factor by which the intervals shrink.
std::vector<std::string> excitation_sentences(const ExcitationResult& result);

/// Columns and rows of trajectory.csv: time [s], then per joint JOINT/position, /velocity, /acceleration and the expected /effort.
std::vector<std::string> trajectory_columns(const TrajectoryPoints& points);
std::vector<std::vector<std::string>> trajectory_rows(const TrajectoryPoints& points);

}  // namespace codesign
