// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "description/quantity.h"
#include "reading/parameter_table.h"
#include "reading/xml/xml_element.h"

namespace codesign {

/// The prefix of our elements and attributes.
inline const char kPrefix[] = "codesign:";

/// The `count` space-separated values of an attribute, each a number or `${expression}`, for example `0 0 -${crank_length/2}`. Nominal
/// values are the values at the default parameters.
/// @throws InputError if a value is not a finite number, an expression is invalid or not finite at the defaults, or the count differs.
std::vector<Quantity> parse_quantities(const XmlElement& element, const std::string& attribute, std::size_t count,
                                       const ParameterTable& table);

/// The values of `attribute`, or of its twin `codesign:attribute` if there is one.
/// @throws InputError as above, and if at the default parameters the twin differs from the plain attribute by more than 1e-6 (relative).
std::vector<Quantity> read_quantities(const XmlElement& element, const std::string& attribute, std::size_t count,
                                      const ParameterTable& table);

}  // namespace codesign
