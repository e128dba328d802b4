// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "excitation/trajectory_basis.h"
#include "jobs/json.h"
#include "mechanism_codesign/problem.h"
#include "problem/load_problem.h"
#include "recordings/measured_motion.h"

namespace codesign {

struct ExcitationResult;

/// The content of a recording, and the fitted part.
struct RecordingSummary {
  std::string element, file;
  std::size_t samples = 0;
  Eigen::Index fitted = 0;            ///< times that are fitted
  double from = 0.0, to = 0.0;        ///< first and last time [s]
  double rate = 0.0;                  ///< samples per second
  std::vector<std::string> measured;  ///< `JOINT/position`, ... in the order of the recording
};

/// @param motion measured_motion() of the recording
RecordingSummary summary_of(const JointRecording& recording, const MeasuredMotion& motion);

/// `[{recording, file, samples, rate, from, to, fitted, measured}]`
Json to_json(const std::vector<RecordingSummary>& recordings);

/// excitation.json, doc/study.md: `predicted` (by name: nominal value, deviation and half the
/// interval before and after), `volume_factor`, `undetermined`, `limits`, `trajectory`, `starts`,
/// and counts. Infinite numbers are null.
Json excitation_json(const Problem& problem, const ExcitationResult& result);

/// A summary for people, one sentence per line: the numbers that no trajectory determines, and the
/// factor by which the intervals shrink.
std::vector<std::string> excitation_sentences(const ExcitationResult& result);

/// Columns and rows of trajectory.csv: time [s], then per joint JOINT/position, /velocity,
/// /acceleration and the expected /effort.
std::vector<std::string> trajectory_columns(const TrajectoryPoints& points);
std::vector<std::vector<std::string>> trajectory_rows(const TrajectoryPoints& points);

}  // namespace codesign
