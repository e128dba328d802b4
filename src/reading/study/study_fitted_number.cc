// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_fitted_number.h"

#include "reading/study/study_parameters.h"

namespace codesign {

void read_fitted(const YamlValue& value, double lower, FittedNumber* number) {
  number->where = value.where();
  if (!value.is_map()) {
    number->value = value.number();
    return;
  }
  value.require_keys({}, {"initial", "lower", "upper"});
  Parameter parameter;
  parameter.value = number->value;
  parameter.lower = lower;
  if (const auto initial = value.find("initial")) parameter.value = initial->number();
  read_bounds(value, &parameter);
  number->is_fitted = true;
  number->value = parameter.value;
  number->lower = parameter.lower;
  number->upper = parameter.upper;
}

}  // namespace codesign
