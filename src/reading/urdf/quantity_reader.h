// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "description/expression.h"
#include "description/robot.h"
#include "mechanism_codesign/parameter.h"
#include "reading/parameter_table.h"
#include "reading/xml/xml_element.h"

namespace codesign {

/// The prefix of our elements and attributes.
inline const char kPrefix[] = "codesign:";

/// The `count` space-separated values of an attribute, each a number or `${expression}`, for
/// example `0 0 -${crank_length/2}`. Nominal values are the values at the default parameters.
/// @throws InputError if a value is not a finite number, an expression is invalid or not finite at
/// the defaults, or the count differs.
std::vector<Quantity> parse_quantities(const XmlElement& element, const std::string& attribute,
                                       std::size_t count, const ParameterTable& table);

/// The values of `attribute`, or of its twin `codesign:attribute` if there is one.
/// @throws InputError as above, and if at the default parameters the twin differs from the plain
/// attribute by more than 1e-6 (relative).
std::vector<Quantity> read_quantities(const XmlElement& element, const std::string& attribute,
                                      std::size_t count, const ParameterTable& table);

/// The allowed values of a number: any finite one, >= 0, or > 0.
enum class Range { kAny, kNonNegative, kPositive };

/// The number of an attribute, or of its twin `codesign:...`; the range is checked at the default
/// parameters.
/// @throws InputError
Quantity read_quantity(const XmlElement& element, const std::string& attribute, Range range,
                       const ParameterTable& table);
/// Likewise; `fallback` if the attribute is missing.
Quantity read_quantity_or(const Quantity& fallback, const XmlElement& element,
                          const std::string& attribute, Range range, const ParameterTable& table);

/// Three numbers, or their twin. @throws InputError
QuantityVector read_vector(const XmlElement& element, const std::string& attribute,
                           const ParameterTable& table);
/// The attribute `xyz` of an axis. @throws InputError if it is zero at the default parameters.
QuantityVector read_axis(const XmlElement& element, const ParameterTable& table);

/// The `<origin>` of an element; the identity if there is none.
PoseDescription read_origin(const XmlElement& parent, const ParameterTable& table);

/// A number that cannot depend on parameters. @throws InputError
double read_number(const XmlElement& element, const std::string& attribute, Range range);
double read_number_or(double fallback, const XmlElement& element, const std::string& attribute,
                      Range range);

/// The `<codesign:parameter>` elements in file order. @throws InputError for invalid or repeated
/// names and for values outside their bounds.
std::vector<Parameter> read_parameters(const XmlElement& robot);

}  // namespace codesign
