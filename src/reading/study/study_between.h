// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "description/quantity.h"
#include "reading/parameter_table.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// The bounds of a constraint, at least one of them.
struct Between {
  std::optional<Quantity> lower, upper;
};

/// Reads `between: [lower, upper]`, or `at_least` and `at_most` or one of these. Their order is not checked. @throws InputError
Between read_between(const YamlValue& value, const ParameterTable& table);

}  // namespace codesign
