// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/trial_lines.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "text/number_text.h"

namespace codesign {
namespace {

/// With two digits, or as a whole number.
std::string roughly(double value) {
  return readable(value < 10.0 ? value : std::round(value), value < 10.0 ? 2 : 10);
}

std::string in_a_good_unit(double seconds) {
  if (seconds < 120.0) return roughly(seconds) + " s";
  if (seconds < 7200.0) return roughly(seconds / 60.0) + " min";
  return roughly(seconds / 3600.0) + " h";
}

/// What is counted, as "12 of 400 points".
std::string counted(const Progress& progress) {
  const std::string of = std::to_string(progress.done) + " of ", all = std::to_string(progress.of);
  if (progress.stage == SearchStage::kScreening) return "screening: " + of + all + " points";
  if (progress.stage == SearchStage::kValidating) return "validating: " + of + all + " runs";
  if (progress.starts > 0) return "searching: " + of + all + " searches ended";
  return "searching: " + of + "at most " + all + " evaluations";
}

double distance(const std::vector<double>& one, const std::vector<double>& other) {
  double squares = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) squares += (one[k] - other[k]) * (one[k] - other[k]);
  return std::sqrt(squares);
}

double largest_change(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  double largest = 0.0;
  for (Eigen::Index k = 0; k < from.size(); ++k) {
    const double size = std::max(std::abs(from[k]), std::abs(to[k]));
    if (size > 0.0) largest = std::max(largest, std::abs(to[k] - from[k]) / size);
  }
  return largest;
}

}  // namespace

std::string time_left(const std::optional<double>& seconds, bool is_bound) {
  if (!seconds || !(*seconds > 0.0)) return "";
  return (is_bound ? ", at most " : ", about ") + in_a_good_unit(*seconds) + " left";
}

std::string progress_line(const Progress& progress) {
  std::string line = counted(progress) + ", " + std::to_string(progress.runs) + " runs";
  if (progress.runs_per_second > 0.0)
    line += ", " + readable(progress.runs_per_second, 3) + " runs/s";
  return line + time_left(progress.seconds_left, progress.is_bound);
}

std::string TrialLines::line(const Trial& trial, const Progress& progress) {
  std::string line = trial.start > 0 ? "search " + std::to_string(trial.start) + ", " : "";
  line += "trial " + std::to_string(trial.evaluation) + ": ";
  if (trial.status.ok())
    line += "objective " + readable(trial.objective) + ", scaled gradient " +
            readable(trial.gradient_norm);
  else
    line += "failed, " + describe(trial.status);
  const auto [best, is_first] = best_.emplace(trial.start, Best{trial.iteration, trial.rho});
  if (!is_first) {
    line +=
        ", step " +
        readable(distance(scaling_.to_scaled(best->second.rho), scaling_.to_scaled(trial.rho)), 3);
    if (trial.iteration > best->second.iteration) best->second = {trial.iteration, trial.rho};
  }
  return line + ", best " + readable(trial.best_objective) +
         time_left(progress.seconds_left, progress.is_bound);
}

std::string FitLines::line(const FitTrial& trial) {
  if (trial.profile > 0) {
    if (trial.profile == profile_) return "";
    profile_ = trial.profile;
    return "profile " + std::to_string(trial.profile) + " of " + std::to_string(trial.profiles);
  }
  std::string line = "evaluation " + std::to_string(trial.evaluation) + ": ";
  if (trial.status.ok()) {
    line += "cost " + readable(trial.cost) + ", root mean squares";
    for (const double rms : trial.rms) line += ' ' + readable(rms);
  } else {
    line += "failed, " + describe(trial.status);
  }
  if (best_.size() == trial.x.size() && best_.size() > 0)
    line += ", step " + readable(largest_change(best_, trial.x), 3);
  if (best_.size() != trial.x.size() || trial.iteration > iteration_) {
    best_ = trial.x;
    iteration_ = trial.iteration;
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  const int left = std::max(most_evaluations_ - trial.evaluation, 0);
  return line + time_left(trial.evaluation > 0 ? std::optional(seconds * left / trial.evaluation)
                                               : std::nullopt,
                          true);
}

}  // namespace codesign
