// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress_line.h"

#include <algorithm>

#include "jobs/trial_lines.h"
#include "text/number_text.h"

namespace codesign::cli {
namespace {

/// What is counted, as "12 of 400 points".
std::string counted(const Progress& progress) {
  const std::string of = std::to_string(progress.done) + " of ", all = std::to_string(progress.of);
  if (progress.stage == SearchStage::kScreening) return "screening: " + of + all + " points";
  if (progress.stage == SearchStage::kValidating) return "validating: " + of + all + " runs";
  if (progress.starts > 0) return "searching: " + of + all + " searches ended";
  return "searching: " + of + "at most " + all + " evaluations";
}

}  // namespace

bool LinePace::admits(double seconds) {
  if (lines_ >= kLines && seconds - last_ < std::max(1.0, 0.01 * seconds)) return false;
  lines_ = std::min(lines_ + 1, kLines);
  last_ = seconds;
  return true;
}

std::string progress_line(const Progress& progress) {
  std::string line = counted(progress) + ", " + std::to_string(progress.runs) + " runs";
  if (progress.runs_per_second > 0.0)
    line += ", " + readable(progress.runs_per_second, 3) + " runs/s";
  return line + time_left(progress.seconds_left, progress.is_bound);
}

}  // namespace codesign::cli
