// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/unused_parameters.h"

#include <algorithm>

namespace codesign {
namespace {

/// Whether a number of the model, the study or the changes of a run depends on a parameter.
bool is_used(const Study& study, int index) {
  const std::vector<RunDescription>& runs = study.ensemble.runs;
  return study.used_parameters.count(index) > 0 || std::any_of(runs.begin(), runs.end(), [index](const RunDescription& run) {
           return run.study && run.study->used_parameters.count(index) > 0;
         });
}

}  // namespace

Warnings unused_parameters(const Study& study) {
  Warnings warnings;
  for (int index : study.tuned) {
    if (is_used(study, index)) continue;
    const Parameter& parameter = study.parameters[static_cast<std::size_t>(index)];
    warnings.push_back(
        warn("unused_parameter", {parameter.where, "parameter " + parameter.name,
                                  "nothing in the model or the study depends on this parameter, which is to be tuned; write ${" +
                                      parameter.name + "} where it belongs, or take it out of the study's parameters",
                                  "", ""}));
  }
  for (const UncertainQuantity& quantity : study.ensemble.uncertain) {
    if (quantity.parameter < 0 || is_used(study, quantity.parameter)) continue;
    warnings.push_back(warn("unused_parameter", {quantity.where, "uncertain." + quantity.name,
                                                 "nothing in the model or the study depends on this parameter, so all its samples are "
                                                 "alike; write ${" +
                                                     quantity.name + "} where it belongs, or take it out of uncertain",
                                                 "", ""}));
  }
  return warnings;
}

}  // namespace codesign
