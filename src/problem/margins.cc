// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/margins.h"

#include <cmath>
#include <set>

#include "text/decimal.h"

namespace codesign {

bool all_met(const Eigen::VectorXd& margins) {
  for (double margin : margins)
    if (!(margin >= kMet)) return false;
  return true;
}

std::string describe_unmet(const Study& study, const Eigen::VectorXd& margins) {
  std::string list;
  for (std::size_t k = 0; k < study.constraints.size(); ++k) {
    const double margin = margins[static_cast<Eigen::Index>(k)];
    if (margin >= kMet) continue;
    list += (list.empty() ? "\"" : ", \"") + study.constraints[k].text + "\" (margin " + to_decimal(margin) + ")";
  }
  return "not met at the best point: " + list;
}

void require_numbers_at_start(const Study& study, const std::vector<double>& parameters) {
  for (const ParameterConstraint& constraint : study.constraints)
    if (!std::isfinite(constraint.margin->value(parameters)))
      throw InputError({constraint.where, constraint.element, "the constraint is not a number at the start", constraint.text,
                        "expressions that are finite at the parameters' start"});
}

void require_satisfiable(const Study& study) {
  std::vector<ValueRange> ranges;
  std::set<std::string> changed;
  for (const RunDescription& run : study.ensemble.runs)
    for (const auto& [name, value] : run.set) changed.insert(name);
  for (const UncertainQuantity& quantity : study.ensemble.uncertain) changed.insert(quantity.name);
  for (const Parameter& parameter : study.parameters)
    ranges.push_back(changed.count(parameter.name) > 0 ? ValueRange{parameter.lower, parameter.upper}
                                                       : ValueRange{parameter.value, parameter.value});
  for (int index : study.tuned) {
    const Parameter& parameter = study.parameters[static_cast<std::size_t>(index)];
    ranges[static_cast<std::size_t>(index)] = {parameter.lower, parameter.upper};
  }
  for (const ParameterConstraint& constraint : study.constraints) {
    const double most = constraint.margin->range(ranges).upper;
    if (most < kMet)
      throw InputError({constraint.where, constraint.element, "no design within the parameters' bounds meets the constraint",
                        constraint.text, "the margin is at most " + to_decimal(most) + "; widen the bounds, or relax the constraint"});
  }
}

}  // namespace codesign
