// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/base_precision.h"

#include <algorithm>
#include <limits>

#include "identification/fit/inertial_numbers.h"
#include "math/dense.h"
#include "statistics/identifiability.h"
#include "statistics/parameter_covariance.h"

namespace codesign {
namespace {

constexpr double kLevel = 0.95;  // deviations do not depend on it

LinearNumbers linear_numbers(const FitVariables& variables, const Eigen::MatrixXd& J) {
  return with_inertial_numbers(variables.names(), variables.start(), J);
}

}  // namespace

BasePrecision::BasePrecision(const FitVariables& variables, const Eigen::MatrixXd& stacked)
    : variables_(&variables) {
  const LinearNumbers numbers = linear_numbers(variables, stacked);
  const Identifiability found = find_identifiable(upper_factor(numbers.jacobian));
  for (int k = 0; k < static_cast<int>(numbers.names.size()); ++k) {
    if (std::find(found.dependent.begin(), found.dependent.end(), k) != found.dependent.end())
      continue;
    columns_.push_back(k);
    names_.push_back(combination_of(found, numbers.names, k));
  }
  has_combinations_ = numbers.is_changed || !found.dependent.empty();
}

BasePrecision::Merit BasePrecision::of(const Eigen::MatrixXd& J) const {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd base = linear_numbers(*variables_, J).jacobian(Eigen::all, columns_);
  const ParameterCovariance known = predicted_covariance(base, J.rows(), kLevel);
  Merit merit{kInfinite, known.covariance.diagonal().cwiseSqrt()};
  if (base.cols() == 0 || known.identifiability.rank < static_cast<int>(base.cols())) return merit;
  const Eigen::VectorXd values = singular_values(upper_factor(base)).values;
  merit.condition = values.maxCoeff() / values.minCoeff();
  return merit;
}

}  // namespace codesign
