// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/margins.h"

#include <cmath>

#include "text/decimal.h"

namespace codesign {

Eigen::VectorXd constraint_margins(const Study& study, const std::vector<double>& parameters) {
  Eigen::VectorXd margins(static_cast<Eigen::Index>(study.constraints.size()));
  for (std::size_t k = 0; k < study.constraints.size(); ++k)
    margins[static_cast<Eigen::Index>(k)] = study.constraints[k].margin->value(parameters);
  return margins;
}

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
  const Eigen::VectorXd margins = constraint_margins(study, parameters);
  for (std::size_t k = 0; k < study.constraints.size(); ++k) {
    if (std::isfinite(margins[static_cast<Eigen::Index>(k)])) continue;
    const ParameterConstraint& constraint = study.constraints[k];
    throw InputError({constraint.where, "constraints[" + std::to_string(k) + "]", "the constraint is not a number at the start",
                      constraint.text, "expressions that are finite at the parameters' start"});
  }
}

}  // namespace codesign
