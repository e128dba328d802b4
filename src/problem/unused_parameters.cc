// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/unused_parameters.h"

namespace codesign {

Warnings unused_parameters(const Study& study) {
  Warnings warnings;
  for (int index : study.tuned) {
    if (study.used_parameters.count(index) > 0) continue;
    const Parameter& parameter = study.parameters[static_cast<std::size_t>(index)];
    warnings.push_back(
        warn("unused_parameter", {parameter.where, "parameter " + parameter.name,
                                  "nothing in the model or the study depends on this parameter, which is to be tuned; write ${" +
                                      parameter.name + "} where it belongs, or take it out of the study's parameters",
                                  "", ""}));
  }
  return warnings;
}

}  // namespace codesign
