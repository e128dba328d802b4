// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/comparison/model_comparison.h"

#include <algorithm>
#include <cmath>

#include "statistics/parameter_covariance.h"

namespace codesign {
namespace {

// Relative; the same recording through the same filter has the same root mean square.
constexpr double kSameRecording = 1e-6;

bool has_same_data(const JudgedModel& a, const JudgedModel& b) {
  return a.samples == b.samples &&
         std::equal(a.data.begin(), a.data.end(), b.data.begin(), b.data.end(),
                    [](const JudgedOutput& left, const JudgedOutput& right) {
                      return left.name == right.name &&
                             std::abs(left.recorded - right.recorded) <=
                                 kSameRecording * std::abs(right.recorded);
                    });
}

bool is_exact(const JudgedModel& model) {
  return std::any_of(model.data.begin(), model.data.end(),
                     [](const JudgedOutput& output) { return !(output.rms > 0.0); });
}

std::string refusal_of(const JudgedModel& other, const JudgedModel& here) {
  if (other.data.empty() || here.data.empty()) return "one of the two has no data but a holdout";
  if (!has_same_data(other, here)) return "the two were judged on different data";
  if (!other.is_squares || !here.is_squares)
    return "a robust loss is no likelihood; loss: square is";
  if (other.has_rest_bounds || here.has_rest_bounds) return "rest: bounds has no likelihood";
  if (is_exact(other) || is_exact(here)) return "residuals are zero";
  return "";
}

/// -2 ln L without its constant and the inflation.
double deviance(const JudgedModel& model) {
  double sum = 0.0;
  for (const JudgedOutput& output : model.data)
    sum += 2.0 * static_cast<double>(model.samples) * std::log(output.rms);
  return sum;
}

bool is_within(const std::vector<std::string>& small, const std::vector<std::string>& large) {
  return std::all_of(small.begin(), small.end(), [&large](const std::string& name) {
    return std::find(large.begin(), large.end(), name) != large.end();
  });
}

}  // namespace

ModelComparison compare_models(const JudgedModel& other, const JudgedModel& here) {
  ModelComparison comparison;
  comparison.refusal = refusal_of(other, here);
  if (!comparison.refusal.empty()) return comparison;
  comparison.is_here_larger = here.rank > other.rank;
  const JudgedModel& large = comparison.is_here_larger ? here : other;
  const JudgedModel& small = comparison.is_here_larger ? other : here;
  // Below one, neighbours alternate; a white likelihood is then the careful one.
  comparison.inflation = std::max(1.0, large.inflation);
  comparison.criterion =
      (deviance(here) - deviance(other)) / comparison.inflation + 2.0 * (here.rank - other.rank);
  comparison.degrees = large.rank - small.rank;
  comparison.is_nested = comparison.degrees > 0 && is_within(small.numbers, large.numbers);
  if (!comparison.is_nested) return comparison;
  comparison.statistic = (deviance(small) - deviance(large)) / comparison.inflation;
  comparison.probability =
      chi_squared_tail(std::max(0.0, comparison.statistic), comparison.degrees);
  return comparison;
}

}  // namespace codesign
