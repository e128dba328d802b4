// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "description/robot.h"
#include "reading/urdf/twin.h"

namespace codesign {

/// The allowed values of a number: any finite one, >= 0, or > 0.
enum class Range { kAny, kNonNegative, kPositive };

/// The number of an attribute, or of its twin `codesign:...`; the range is checked at the default parameters.
/// @throws InputError
Quantity read_quantity(const XmlElement& element, const std::string& attribute, Range range, const ParameterTable& table);
/// Likewise; `fallback` if the attribute is missing.
Quantity read_quantity_or(const Quantity& fallback, const XmlElement& element, const std::string& attribute, Range range,
                          const ParameterTable& table);

/// Three numbers, or their twin. @throws InputError
QuantityVector read_vector(const XmlElement& element, const std::string& attribute, const ParameterTable& table);
/// The attribute `xyz` of an axis. @throws InputError if it is zero at the default parameters.
QuantityVector read_axis(const XmlElement& element, const ParameterTable& table);

/// The `<origin>` of an element; the identity if there is none.
PoseDescription read_origin(const XmlElement& parent, const ParameterTable& table);

/// A number that cannot depend on parameters. @throws InputError
double read_number(const XmlElement& element, const std::string& attribute, Range range);
double read_number_or(double fallback, const XmlElement& element, const std::string& attribute, Range range);

}  // namespace codesign
