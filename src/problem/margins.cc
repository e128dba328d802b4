// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/margins.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// The ranges of the parameters over all designs and scenarios, order of Study::parameters.
std::vector<ValueRange> ranges_of(const Study& study) {
  std::set<std::string> changed;
  for (const RunDescription& run : study.ensemble.runs)
    for (const auto& [name, value] : run.set) changed.insert(name);
  for (const UncertainQuantity& quantity : study.ensemble.uncertain) changed.insert(quantity.name);
  for (const std::string& name : tuned_names(study)) changed.insert(name);
  std::vector<ValueRange> ranges;
  for (const Parameter& parameter : study.parameters)
    ranges.push_back(changed.count(parameter.name) > 0
                         ? ValueRange{parameter.lower, parameter.upper}
                         : ValueRange{parameter.value, parameter.value});
  return ranges;
}

}  // namespace

double least_margin(const Study& study, const ParameterConstraint& constraint) {
  constexpr double kShare = 1e-7;
  const std::vector<double> start = start_parameters(study);
  double magnitude = std::abs(constraint.margin->value(start));
  for (const int k : constraint.margin->dependencies())
    magnitude += std::abs(constraint.margin->derivative(k, start)) *
                 extent(study.parameters[to_index(k)], 0.0);
  // Where it is no number or zero, nothing is known of it.
  return -kShare * (magnitude > 0.0 ? std::min(1.0, magnitude) : 1.0);
}

double margin_left(const ParameterConstraint& constraint, const std::vector<double>& parameters) {
  const double margin = constraint.margin->value(parameters);
  return constraint.is_equality ? 0.0 - std::abs(margin) : margin;
}

bool may_begin(const Study& study, const Eigen::VectorXd& margins) {
  for (std::size_t k = 0; k < study.constraints.size(); ++k) {
    const ParameterConstraint& constraint = study.constraints[k];
    const double margin = margins[to_signed(k)];
    if (constraint.is_equality ? std::isnan(margin) : !(margin >= least_margin(study, constraint)))
      return false;
  }
  return true;
}

bool all_met(const Study& study, const Eigen::VectorXd& margins) {
  for (std::size_t k = 0; k < study.constraints.size(); ++k)
    if (!(margins[to_signed(k)] >= least_margin(study, study.constraints[k]))) return false;
  return true;
}

std::string describe_unmet(const Study& study, const Eigen::VectorXd& margins) {
  std::string list;
  for (std::size_t k = 0; k < study.constraints.size(); ++k) {
    const double margin = margins[to_signed(k)];
    if (margin >= least_margin(study, study.constraints[k])) continue;
    list += (list.empty() ? "\"" : ", \"") + study.constraints[k].text + "\" (margin " +
            to_decimal(margin) + ")";
  }
  return "not met at the best point: " + list;
}

void require_numbers_at_start(const Study& study, const std::vector<double>& parameters) {
  for (const ParameterConstraint& constraint : study.constraints)
    if (!std::isfinite(constraint.margin->value(parameters)))
      throw InputError({constraint.where, constraint.element,
                        "the constraint is not a number at the start", constraint.text,
                        "expressions that are finite at the parameters' start"});
}

Warnings unsatisfiable_constraints(const Study& study) {
  const std::vector<ValueRange> ranges = ranges_of(study);
  Warnings warnings;
  for (const ParameterConstraint& constraint : study.constraints) {
    const ValueRange range = constraint.margin->range(ranges);
    const double most = constraint.is_equality ? std::min(range.upper, -range.lower) : range.upper;
    if (most < least_margin(study, constraint))
      warnings.push_back(
          warn("unsatisfiable_constraint",
               {constraint.where, constraint.element,
                "no design within the parameters' bounds meets the constraint", constraint.text,
                "the margin is at most " + to_decimal(most) +
                    "; widen the bounds, or relax the constraint"}));
  }
  return warnings;
}

void require_ordered_bounds(const Study& study) {
  const std::vector<double> start = start_parameters(study);
  const ParameterConstraint* before = nullptr;
  for (const ParameterConstraint& constraint : study.constraints) {
    // The sum of the margins e - lower and upper - e.
    if (before && before->element == constraint.element &&
        before->margin->value(start) + constraint.margin->value(start) <
            least_margin(study, constraint))
      throw InputError({constraint.where, constraint.element,
                        "the lower bound must be less than the upper one at the parameters' start",
                        before->text + ", " + constraint.text, "lower < upper"});
    before = &constraint;
  }
}

}  // namespace codesign
