// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/linear_parameters.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/to_index.h"

namespace codesign {
namespace {

constexpr double kChange = 0.1;         // of a parameter, relative
constexpr double kChangeOfZero = 0.01;  // of a parameter that is zero and has no bounds
constexpr double kUnchanged = 1e-7;     // smaller relative changes of a column of the Jacobian are rounding

using Conflicts = std::vector<std::vector<bool>>;

double change_of(const Parameter& parameter, double value) {
  if (value != 0.0) return kChange * std::abs(value);
  const double width = parameter.upper - parameter.lower;
  return std::isfinite(width) && width > 0.0 ? kChange * width : kChangeOfZero;
}

/// Evaluates the Jacobian with parameter `index` changed in one direction or, if that design is impossible, in the other.
bool jacobian_beside(EffortModel* model, std::vector<double> parameters, std::size_t index, double change, RowJacobian* jacobian) {
  const double value = parameters[index];
  Eigen::MatrixXd efforts;
  for (double side : {1.0, -1.0}) {
    parameters[index] = value + side * change;
    if (model->evaluate(parameters, &efforts, jacobian).ok() && jacobian->allFinite()) return true;
  }
  return false;
}

Conflicts find_conflicts(EffortModel* model, const std::vector<double>& parameters, const RowJacobian& here) {
  const Study& study = model->driven().system->study();
  Conflicts conflicts(study.tuned.size(), std::vector<bool>(study.tuned.size(), false));
  RowJacobian beside;
  for (std::size_t k = 0; k < study.tuned.size(); ++k) {
    const auto index = to_index(study.tuned[k]);
    if (!jacobian_beside(model, parameters, index, change_of(study.parameters[index], parameters[index]), &beside)) {
      conflicts[k][k] = true;
      continue;
    }
    for (std::size_t j = 0; j < study.tuned.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      const double size = here.col(column).cwiseAbs().maxCoeff();
      const double change = (beside.col(column) - here.col(column)).cwiseAbs().maxCoeff();
      if (change > kUnchanged * size) conflicts[k][j] = conflicts[j][k] = true;
    }
  }
  return conflicts;
}

}  // namespace

MotionSamples thinned(const MotionSamples& motion, int count) {
  const auto samples = static_cast<int>(motion.position.cols()), stride = std::max(1, samples / std::max(1, count));
  std::vector<int> chosen;
  MotionSamples result;
  result.begins.clear();
  for (std::size_t k = 0; k < motion.begins.size(); ++k) {
    const int end = k + 1 < motion.begins.size() ? motion.begins[k + 1] : samples;
    result.begins.push_back(static_cast<int>(chosen.size()));
    for (int sample = motion.begins[k]; sample < end; sample += stride) chosen.push_back(sample);
  }
  const auto take = [&chosen](const Eigen::MatrixXd& from, Eigen::MatrixXd* to) {
    to->resize(from.rows(), static_cast<Eigen::Index>(chosen.size()));
    for (std::size_t k = 0; k < chosen.size(); ++k) to->col(static_cast<Eigen::Index>(k)) = from.col(chosen[k]);
  };
  take(motion.position, &result.position);
  take(motion.velocity, &result.velocity);
  take(motion.acceleration, &result.acceleration);
  return result;
}

LinearParameters find_linear_parameters(EffortModel* model, const std::vector<double>& parameters, Status* status) {
  Eigen::MatrixXd efforts;
  RowJacobian here;
  const Status at_start = model->evaluate(parameters, &efforts, &here);
  if (status != nullptr) *status = at_start;
  if (!at_start.ok() || efforts.size() == 0) return {};
  Conflicts conflicts = find_conflicts(model, parameters, here);
  LinearParameters result;
  result.linear.resize(conflicts.size());
  std::iota(result.linear.begin(), result.linear.end(), 0);
  const auto leave_out = [&result](int k) {
    result.linear.erase(std::find(result.linear.begin(), result.linear.end(), k));
    result.others.push_back(k);
  };
  for (std::size_t k = 0; k < conflicts.size(); ++k)
    if (conflicts[k][k]) leave_out(static_cast<int>(k));
  const auto count = [&](int k) {
    return std::count_if(result.linear.begin(), result.linear.end(), [&](int j) { return conflicts[to_index(k)][to_index(j)]; });
  };
  while (!result.linear.empty()) {
    const int worst = *std::max_element(result.linear.begin(), result.linear.end(), [&](int a, int b) { return count(a) < count(b); });
    if (count(worst) == 0) break;
    leave_out(worst);
  }
  std::sort(result.others.begin(), result.others.end());
  return result;
}

}  // namespace codesign
