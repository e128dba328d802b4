// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_TWIN_H_
#define MECHANISM_CODESIGN_READING_URDF_TWIN_H_

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "description/expression.h"
#include "description/quantity.h"
#include "mechanism_codesign/parameter.h"
#include "reading/xml/xml_element.h"

namespace codesign {

/// The names expressions may use, and their default values.
struct ParameterTable {
  ParameterTable() = default;
  explicit ParameterTable(const std::vector<Parameter>& parameters);
  /// For expressions; it must not outlive the table.
  ExpressionScope scope() const;

  std::vector<std::string> names;
  std::vector<double> values;
  std::unordered_map<std::string, int> index;  ///< of each name
};

inline const char kPrefix[] = "codesign:";

/// The space-separated values of one attribute that mixes numbers with `${...}`, e.g. `0 0 -${crank_length/2}`.
/// Their nominal values are those at the parameters' defaults.
/// @throws InputError if a value is no number, an expression does not parse, a value is not finite or the count differs.
std::vector<Quantity> parse_quantities(const XmlElement& element, const std::string& attribute, std::size_t count,
                                       const ParameterTable& table);

/// The plain attribute `attribute`, or its twin `codesign:attribute` if there is one.
/// @throws InputError as above, and if the twin disagrees with the plain value at the defaults (relative 1e-6).
std::vector<Quantity> read_quantities(const XmlElement& element, const std::string& attribute, std::size_t count,
                                      const ParameterTable& table);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_TWIN_H_
