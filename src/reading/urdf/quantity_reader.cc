// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/quantity_reader.h"

#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>

#include "description/expression.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// Splits at white space outside `${...}`.
std::vector<std::string> split_values(const XmlElement& element, const std::string& attribute) {
  const std::string text = element.text(attribute);
  std::vector<std::string> values;
  bool inside = false, in_word = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool space = text[k] == ' ' || text[k] == '\t' || text[k] == '\n' || text[k] == '\r';
    if (text[k] == '$' && k + 1 < text.size() && text[k + 1] == '{') inside = true;
    if (space && !inside) {
      in_word = false;
      continue;
    }
    if (!in_word) values.emplace_back();
    in_word = true;
    values.back() += text[k];
    if (text[k] == '}') inside = false;
  }
  if (inside) element.fail_at(attribute, "${ without its }");
  return values;
}

/// The expression inside `${...}`, `-${...}` or `+${...}`; empty if `word` has another form.
std::string expression_inside(const std::string& word) {
  const std::size_t begin = word.find("${");
  const bool signed_only = begin == 0 || (begin == 1 && (word[0] == '-' || word[0] == '+'));
  if (!signed_only || word.find('}') != word.size() - 1) return "";
  return word.substr(begin + 2, word.size() - begin - 3);
}

Quantity parse_expression(const XmlElement& element, const std::string& attribute,
                          const std::string& word, const ParameterTable& table) {
  const std::string inner = expression_inside(word);
  if (inner.empty())
    element.fail_at(attribute, "'" + word + "' is not an expression",
                    "a number, ${expression} or -${expression}");
  std::shared_ptr<const Expression> expression;
  try {
    // Check the expression by itself: unbalanced brackets in it could be balanced by those that are
    // put around it for the sign.
    expression = table.parse(inner);
    if (word[0] == '-') expression = table.parse("-(" + inner + ")");
  } catch (const std::invalid_argument& error) {
    element.fail_at(attribute, std::string(error.what()),
                    "an expression of the model's parameters");
  }
  const double nominal = expression->value(table.values);
  if (!std::isfinite(nominal))
    element.fail_at(attribute, "'" + word + "' is not finite at the default parameters",
                    "a finite number");
  return {nominal, expression};
}

Quantity parse_constant(const XmlElement& element, const std::string& attribute,
                        const std::string& word) {
  const std::optional<double> value = parse_number(word);
  if (!value)
    element.fail_at(attribute, "'" + word + "' in " + attribute + " is not a number", "numbers");
  if (!std::isfinite(*value))
    element.fail_at(attribute, attribute + " is not finite", "finite numbers");
  return *value;
}

bool agree(double plain, double twin) {
  constexpr double kRelative = 1e-6, kAbsolute = 1e-12;
  return std::abs(plain - twin) <=
         std::max(kAbsolute, kRelative * std::max(std::abs(plain), std::abs(twin)));
}

std::string nominal_text(const std::vector<Quantity>& quantities) {
  std::vector<double> values;
  for (const Quantity& quantity : quantities) values.push_back(quantity.nominal());
  return format_numbers(values);
}

}  // namespace

std::vector<Quantity> parse_quantities(const XmlElement& element, const std::string& attribute,
                                       std::size_t count, const ParameterTable& table) {
  std::vector<Quantity> result;
  for (const std::string& word : split_values(element, attribute)) {
    const bool is_expression = word.find("${") != std::string::npos;
    result.push_back(is_expression ? parse_expression(element, attribute, word, table)
                                   : parse_constant(element, attribute, word));
  }
  if (result.size() != count)
    element.fail_at(
        attribute,
        attribute + " has the wrong number of values (" + std::to_string(result.size()) + ")",
        std::to_string(count) + (count == 1 ? " value" : " values"));
  return result;
}

std::vector<Quantity> read_quantities(const XmlElement& element, const std::string& attribute,
                                      std::size_t count, const ParameterTable& table) {
  if (element.text(attribute).find("${") != std::string::npos)
    element.fail_at(attribute, "a plain attribute contains an expression",
                    "a number here, the expression in " + (kPrefix + attribute));
  std::vector<Quantity> plain = parse_quantities(element, attribute, count, table);
  const std::string twin_name = kPrefix + attribute;
  if (!element.has(twin_name)) return plain;
  std::vector<Quantity> twin = parse_quantities(element, twin_name, count, table);
  for (std::size_t k = 0; k < count; ++k) {
    if (agree(plain[k].nominal(), twin[k].nominal())) continue;
    element.fail_at(twin_name,
                    twin_name + " is " + nominal_text(twin) + " at the default parameters, " +
                        attribute + " is " + nominal_text(plain),
                    "equal values");
  }
  return twin;
}

namespace {

void check_range(const XmlElement& element, const std::string& attribute, Range range,
                 double value) {
  if (range == Range::kPositive && value <= 0.0)
    element.fail_at(attribute, attribute + " is not positive", "> 0");
  if (range == Range::kNonNegative && value < 0.0)
    element.fail_at(attribute, attribute + " is negative", ">= 0");
}

}  // namespace

Quantity read_quantity(const XmlElement& element, const std::string& attribute, Range range,
                       const ParameterTable& table) {
  Quantity quantity = read_quantities(element, attribute, 1, table).front();
  check_range(element, attribute, range, quantity.nominal());
  return quantity;
}

Quantity read_quantity_or(const Quantity& fallback, const XmlElement& element,
                          const std::string& attribute, Range range, const ParameterTable& table) {
  return element.has(attribute) ? read_quantity(element, attribute, range, table) : fallback;
}

QuantityVector read_vector(const XmlElement& element, const std::string& attribute,
                           const ParameterTable& table) {
  const std::vector<Quantity> values = read_quantities(element, attribute, 3, table);
  return {values[0], values[1], values[2]};
}

QuantityVector read_axis(const XmlElement& element, const ParameterTable& table) {
  QuantityVector axis = read_vector(element, "xyz", table);
  const double x = axis[0].nominal(), y = axis[1].nominal(), z = axis[2].nominal();
  if (x * x + y * y + z * z < 1e-24)
    element.fail_at("xyz", "the axis is zero", "a vector that is not zero");
  return axis;
}

PoseDescription read_origin(const XmlElement& parent, const ParameterTable& table) {
  PoseDescription pose;
  const std::optional<XmlElement> origin = parent.child("origin");
  if (!origin) return pose;
  if (origin->has("xyz")) pose.xyz = read_vector(*origin, "xyz", table);
  if (origin->has("rpy")) pose.rpy = read_vector(*origin, "rpy", table);
  return pose;
}

double read_number(const XmlElement& element, const std::string& attribute, Range range) {
  return read_quantity(element, attribute, range, ParameterTable()).nominal();
}

double read_number_or(double fallback, const XmlElement& element, const std::string& attribute,
                      Range range) {
  return element.has(attribute) ? read_number(element, attribute, range) : fallback;
}

namespace {

Parameter read_parameter(const XmlElement& element) {
  Parameter parameter;
  parameter.where = element.where();
  parameter.name = element.text("name");
  const std::string fault = identifier_fault(parameter.name);
  if (!fault.empty())
    element.fail_at("name", fault, "an identifier that is not the name of a function or constant");
  parameter.value = read_number(element, "value", Range::kAny);
  parameter.lower = read_number_or(parameter.lower, element, "lower", Range::kAny);
  parameter.upper = read_number_or(parameter.upper, element, "upper", Range::kAny);
  parameter.unit = element.find("unit").value_or("");
  const std::string bounds =
      "[" + to_decimal(parameter.lower) + ", " + to_decimal(parameter.upper) + "]";
  if (parameter.lower > parameter.upper)
    element.fail_at("lower", "the lower bound is above the upper bound",
                    "at most upper=" + *element.find("upper"));
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
    if (!names.insert(parameters.back().name).second)
      element.fail_at("name", "a second parameter of this name", "unique names");
  }
  return parameters;
}

}  // namespace codesign
