// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/controller_constants.h"

#include "text/decimal.h"

namespace codesign {

std::string find_impossible(const ControllerDescription& description, const ControllerConstants<double>& constants) {
  const ControlRealization& realization = description.realization;
  const struct {
    const char* name;
    bool exists;
    double value;
  } numbers[] = {{"i_clamp", realization.i_clamp.has_value(), constants.i_clamp},
                 {"derivative_filter", realization.derivative_filter.has_value(), constants.derivative_filter},
                 {"output_limit", realization.output_limit.has_value(), constants.output_limit},
                 {"time_constant", realization.time_constant.has_value(), constants.time_constant}};
  for (const auto& number : numbers)
    if (number.exists && !(number.value > 0.0))
      return "controllers." + description.name + "." + number.name + " is " + to_decimal(number.value) + ", it must be positive";
  return "";
}

}  // namespace codesign
