// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace codesign {

/// What a model leaves of one output, root mean squares in the unit of the output.
struct JudgedOutput {
  std::string name;
  double recorded = 0.0;   ///< of the recorded values
  double rms = 0.0;        ///< of the residuals
  double explained = 0.0;  ///< OutputFit::explained
};

/// A model that was fitted to recordings, or judged as it stands.
struct JudgedModel {
  std::vector<std::string> numbers;  ///< names of what was fitted; empty: evaluate_model()
  int rank = 0;                      ///< how many of them, or of their combinations, are known
  double inflation = 1.0;            ///< IdentificationResult::inflation
  bool is_squares = true;            ///< whether the loss is a sum of squares, thus a likelihood
  /// whether samples at rest count by bounds: their residuals are no part of the root mean squares
  bool has_rest_bounds = false;
  std::int64_t samples = 0;  ///< times in the data
  std::vector<JudgedOutput> data, holdout;
};

/// Two models on the same data, "here" against "other". With N times, m outputs, residuals of root
/// mean square s_k, and correlated noise that inflates variances by c,
///
///   -2 ln L / c = (N / c) sum_k ln s_k^2 + constant            quasi-likelihood
///   QAIC = -2 ln L / c + 2 rank                                Burnham and Anderson (2002), 2.5
///
/// c is the inflation of the model with more numbers. Of nested models (the numbers of one are
/// among those of the other) D = 2 (ln L_large - ln L_small) / c is chi-squared with the difference
/// of the ranks as degrees of freedom, if the further numbers are not needed.
struct ModelComparison {
  /// why there is no criterion: other data, a robust loss, bounds at rest, residuals that are zero;
  /// else empty
  std::string refusal;
  double inflation = 1.0;       ///< c
  double criterion = 0.0;       ///< QAIC here minus QAIC of the other; negative: here is better
  bool is_nested = false;       ///< whether statistic, degrees and probability say something
  bool is_here_larger = false;  ///< of nested models: whether here has more numbers
  double statistic = 0.0;       ///< D; negative: the larger fit has not found its optimum
  int degrees = 0;              ///< degrees of freedom
  double probability = 1.0;     ///< of a D as large by chance
};

ModelComparison compare_models(const JudgedModel& other, const JudgedModel& here);

}  // namespace codesign
