// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ensemble/parameter_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "description/study.h"
#include "math/arrays.h"
#include "problem/margins.h"

namespace codesign {
namespace {

/// The values that a scenario gives to the parameters of a constraint; scenarios with different
/// values need different rows.
std::vector<std::pair<int, double>> values_read(const Expression& margin,
                                                const Scenario& scenario) {
  const std::vector<int>& read = margin.dependencies();
  std::vector<std::pair<int, double>> values;
  for (const auto& value : scenario.values)
    if (std::binary_search(read.begin(), read.end(), value.first)) values.push_back(value);
  return values;
}

}  // namespace

ParameterRows::ParameterRows(const Study& study, const std::vector<Scenario>& scenarios)
    : study_(study), scenarios_(scenarios) {
  for (std::size_t k = 0; k < study.constraints.size(); ++k) {
    std::set<std::vector<std::pair<int, double>>> known;
    for (std::size_t i = 0; i < scenarios.size(); ++i)
      if (known.insert(values_read(*study.constraints[k].margin, scenarios[i])).second)
        rows_.push_back({k, i});
  }
}

bool ParameterRows::is_equality(const Row& row) const {
  return study_.constraints[row.constraint].is_equality;
}

double ParameterRows::margin(const Row& row, const Eigen::VectorXd& rho,
                             Eigen::VectorXd* by_rho) const {
  const Expression& margin = *study_.constraints[row.constraint].margin;
  const std::vector<double> parameters = scenarios_[row.scenario].parameters(rho);
  if (by_rho) {
    by_rho->resize(rho.size());
    for (std::size_t k = 0; k < study_.tuned.size(); ++k)
      (*by_rho)[to_signed(k)] = margin.derivative(study_.tuned[k], parameters);
  }
  return margin.value(parameters);
}

Eigen::VectorXd ParameterRows::margins(const Eigen::VectorXd& rho) const {
  Eigen::VectorXd margins = Eigen::VectorXd::Constant(to_signed(study_.constraints.size()),
                                                      std::numeric_limits<double>::infinity());
  for (const Row& row : rows_) {
    double& smallest = margins[to_signed(row.constraint)];
    const double one =
        margin_left(study_.constraints[row.constraint], scenarios_[row.scenario].parameters(rho));
    if (std::isnan(one) || one < smallest) smallest = one;
  }
  return margins;
}

void ParameterRows::require_numbers_at(const Eigen::VectorXd& start) const {
  for (const Row& row : rows_) {
    if (std::isfinite(margin(row, start, nullptr))) continue;
    const ParameterConstraint& constraint = study_.constraints[row.constraint];
    const std::string scenario = scenarios_[row.scenario].name();
    throw InputError({constraint.where, constraint.element,
                      "the constraint is not a number at the start" +
                          (scenario.empty() ? "" : " in " + scenario),
                      constraint.text, "expressions that are finite at the parameters' start"});
  }
}

}  // namespace codesign
