// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/parameter_reader.h"

#include <set>

#include "description/expression.h"
#include "reading/urdf/quantity_reader.h"
#include "text/number_text.h"

namespace codesign {
namespace {

Parameter read_parameter(const XmlElement& element) {
  Parameter parameter;
  parameter.where = element.where();
  parameter.name = element.text("name");
  const std::string fault = identifier_fault(parameter.name);
  if (!fault.empty()) element.fail_at("name", fault, "an identifier that is not the name of a function or constant");
  parameter.value = read_number(element, "value", Range::kAny);
  parameter.lower = read_number_or(parameter.lower, element, "lower", Range::kAny);
  parameter.upper = read_number_or(parameter.upper, element, "upper", Range::kAny);
  parameter.unit = element.find("unit").value_or("");
  const std::string bounds = "[" + to_decimal(parameter.lower) + ", " + to_decimal(parameter.upper) + "]";
  if (parameter.lower > parameter.upper)
    element.fail_at("lower", "the lower bound is above the upper bound", "at most upper=" + *element.find("upper"));
  if (parameter.value < parameter.lower || parameter.value > parameter.upper)
    element.fail_at("value", "the default value is outside its bounds", bounds);
  return parameter;
}

}  // namespace

std::vector<Parameter> read_parameters(const XmlElement& robot) {
  std::vector<Parameter> parameters;
  std::set<std::string> names;
  for (const XmlElement& element : robot.children("codesign:parameter")) {
    parameters.push_back(read_parameter(element));
    if (!names.insert(parameters.back().name).second) element.fail_at("name", "a second parameter of this name", "unique names");
  }
  return parameters;
}

}  // namespace codesign
