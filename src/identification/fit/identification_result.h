// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "identification/fit/residual_fit.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"
#include "statistics/profile.h"
#include "statistics/time_series.h"

namespace codesign {

/// One entry of x after the fit, and its uncertainty.
struct IdentifiedNumber {
  std::string name, unit;  ///< FitVariables::names()
  double start = 0.0, value = 0.0;
  double lower = -std::numeric_limits<double>::infinity();  ///< bounds
  double upper = std::numeric_limits<double>::infinity();
  bool is_on_bound = false;      ///< whether the value lies on a bound; it then has no interval
  bool is_determined = true;     ///< whether the data determine it, or hold it on its bound
  double slope_signal = 1.0;     ///< for a delay: DelaySignal::share
  double deviation = 0.0;        ///< standard deviation; infinite if not determined
  double low = 0.0, high = 0.0;  ///< the interval at IntervalOptions::level
  std::optional<ProfileInterval> profile;
};

/// A combination of numbers that the data determine although they do not determine each of them: a
/// base parameter. Free inertias appear by mass, first and second moments, in which efforts are
/// linear: `forearm_m` and so on, see kInertialNames.
struct BaseParameter {
  std::string expression;  ///< `forearm_mx + 0.4 wrist_m`
  double value = 0.0, deviation = 0.0;
  double low = 0.0, high = 0.0;  ///< the interval at IntervalOptions::level
};

/// The residuals of one output: the effort of a joint or, with residuals in motion, its position,
/// velocity or effort.
struct OutputFit {
  /// `elbow_joint`, `elbow_joint/position`, or a signal as the study spells it
  std::string joint;
  double recorded = 0.0;  ///< root mean square of the recorded values, in the unit of the output
  double start = 0.0;     ///< root mean square of the residuals at the start
  double rms = 0.0;       ///< root mean square of the residuals after the fit
  double worst = 0.0;     ///< largest magnitude of the residuals after the fit
  /// share of the recorded values that the fit explains: explained_share()
  double explained = 0.0;
  double counted = 1.0;    ///< share of the samples that count, above the speed of a mask
  bool is_signal = false;  ///< a recorded signal of the model
  Whiteness whiteness;     ///< of the residuals after the fit
};

/// Recorded and computed outputs of several recordings; efforts filtered like the residuals.
struct FittedSeries {
  SeriesLengths lengths;      ///< rows of each recording
  std::vector<double> times;  ///< one per row [s]
  /// rows x outputs; NaN is computed where a sample does not count
  Eigen::MatrixXd recorded, computed;
};

/// The termination of a result in which nothing was fitted: evaluate_model().
inline constexpr const char* kEvaluated = "evaluated";

/// The result of `codesign identify`.
struct IdentificationResult {
  /// ok; kNotIdentifiable, with all members; kCancelled, with the best point; or the failure of the
  /// start
  Status status;
  std::string termination;                ///< as OptimizationResult::termination
  std::vector<IdentifiedNumber> numbers;  ///< empty if the start failed or nothing was fitted
  Eigen::VectorXd x;
  std::vector<double> parameters;  ///< all named parameters (order of Study::parameters)
  /// of x; zero for numbers on a bound, infinite or NaN for numbers that the data do not determine
  Eigen::MatrixXd covariance;
  int rank = 0;  ///< rank of the Jacobian by the numbers that are not on a bound
  /// mean over the determined numbers of variance / variance if the noise were white; 1 of none
  double inflation = 1.0;
  /// sentences about numbers that the data do not determine
  std::vector<std::string> undetermined;
  std::vector<BaseParameter> combinations;  ///< what the data determine of these numbers
  /// one per output; the holdout is empty if the study names none
  std::vector<OutputFit> data, holdout;
  /// of the data, or of the holdout where that alone was judged; empty if the start failed
  const std::vector<OutputFit>& outputs() const { return data.empty() ? holdout : data; }
  FittedSeries data_series, holdout_series;
  Eigen::Index samples = 0, holdout_samples = 0;  ///< number of times, not of residuals
  int lag = 0;                                    ///< lag of the noise model, in samples
  int evaluations = 0, failed_evaluations = 0, iterations = 0;
  /// status of the last point that could not be evaluated; ok if there was none
  Status last_failure;
  double cpu_seconds = 0.0;
  FitSearches searches;  ///< for a study with several starts
  Warnings warnings;
};

}  // namespace codesign
