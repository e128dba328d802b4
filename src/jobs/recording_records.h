// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "jobs/json_type.h"
#include "recordings/measured_motion.h"

namespace codesign {

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

}  // namespace codesign
