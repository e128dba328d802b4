// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/twin.h"

#include <cmath>
#include <memory>
#include <stdexcept>

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

Quantity parse_expression(const XmlElement& element, const std::string& attribute, const std::string& word, const ParameterTable& table) {
  const std::string inner = expression_inside(word);
  if (inner.empty()) element.fail_at(attribute, "'" + word + "' is not an expression", "a number, ${expression} or -${expression}");
  std::shared_ptr<const Expression> expression;
  try {
    // Check the expression by itself: unbalanced brackets in it could be balanced by those that are put around it for the sign.
    expression = table.parse(inner);
    if (word[0] == '-') expression = table.parse("-(" + inner + ")");
  } catch (const std::invalid_argument& error) {
    element.fail_at(attribute, std::string(error.what()), "an expression of the model's parameters");
  }
  const double nominal = expression->value(table.values);
  if (!std::isfinite(nominal)) element.fail_at(attribute, "'" + word + "' is not finite at the default parameters", "a finite number");
  return {nominal, expression};
}

Quantity parse_constant(const XmlElement& element, const std::string& attribute, const std::string& word) {
  const std::optional<double> value = parse_number(word);
  if (!value) element.fail_at(attribute, "'" + word + "' in " + attribute + " is not a number", "numbers");
  if (!std::isfinite(*value)) element.fail_at(attribute, attribute + " is not finite", "finite numbers");
  return *value;
}

bool agree(double plain, double twin) {
  constexpr double kRelative = 1e-6, kAbsolute = 1e-12;
  return std::abs(plain - twin) <= std::max(kAbsolute, kRelative * std::max(std::abs(plain), std::abs(twin)));
}

std::string nominal_text(const std::vector<Quantity>& quantities) {
  std::vector<double> values;
  for (const Quantity& quantity : quantities) values.push_back(quantity.nominal());
  return format_numbers(values);
}

}  // namespace

std::vector<Quantity> parse_quantities(const XmlElement& element, const std::string& attribute, std::size_t count,
                                       const ParameterTable& table) {
  std::vector<Quantity> result;
  for (const std::string& word : split_values(element, attribute)) {
    const bool is_expression = word.find("${") != std::string::npos;
    result.push_back(is_expression ? parse_expression(element, attribute, word, table) : parse_constant(element, attribute, word));
  }
  if (result.size() != count)
    element.fail_at(attribute, attribute + " has the wrong number of values (" + std::to_string(result.size()) + ")",
                    std::to_string(count) + (count == 1 ? " value" : " values"));
  return result;
}

std::vector<Quantity> read_quantities(const XmlElement& element, const std::string& attribute, std::size_t count,
                                      const ParameterTable& table) {
  if (element.text(attribute).find("${") != std::string::npos)
    element.fail_at(attribute, "a plain attribute contains an expression", "a number here, the expression in " + (kPrefix + attribute));
  std::vector<Quantity> plain = parse_quantities(element, attribute, count, table);
  const std::string twin_name = kPrefix + attribute;
  if (!element.has(twin_name)) return plain;
  std::vector<Quantity> twin = parse_quantities(element, twin_name, count, table);
  for (std::size_t k = 0; k < count; ++k) {
    if (agree(plain[k].nominal(), twin[k].nominal())) continue;
    element.fail_at(twin_name,
                    twin_name + " is " + nominal_text(twin) + " at the default parameters, " + attribute + " is " + nominal_text(plain),
                    "equal values");
  }
  return twin;
}

}  // namespace codesign
