// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/quantity.h"

#include "codegen/traced.h"

namespace codesign {

Traced value_at(const Expression& expression, const std::vector<Traced>& parameters) {
  Recording* const recording = parameters.front().recording();
  const UsedNumbers<double> values = expression.used<double>(
      parameters, [](const Traced& parameter) { return parameter.value(); });
  return {recording, recording->supplied(SourceId(expression)), expression.value_of(values)};
}

}  // namespace codesign
