// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/parameter_constraint.h"

#include <stdexcept>

namespace codesign {
namespace {

constexpr const char* kFormOfConstraint = "<expression> >= <expression> or <expression> <= <expression>";

/// Positions of the `>=` and `<=` outside parentheses. Those inside belong to conditional expressions.
std::vector<std::size_t> find_operators(const std::string& text) {
  std::vector<std::size_t> positions;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    const bool is_operator = (text[i] == '<' || text[i] == '>') && i + 1 < text.size() && text[i + 1] == '=';
    if (is_operator && depth == 0) positions.push_back(i);
  }
  return positions;
}

}  // namespace

ParameterConstraint parse_constraint(const std::string& text, const std::vector<std::string>& names, const SourceLocation& where,
                                     const std::string& element) {
  const std::vector<std::size_t> operators = find_operators(text);
  if (operators.size() != 1) throw InputError({where, element, "a constraint needs exactly one >= or <=", text, kFormOfConstraint});
  const std::string left = text.substr(0, operators[0]);
  const std::string right = text.substr(operators[0] + 2);
  try {
    return text[operators[0]] == '>' ? make_constraint(text, right, left, names, where, element)
                                     : make_constraint(text, left, right, names, where, element);
  } catch (const std::invalid_argument& error) {
    throw InputError({where, element, error.what(), text, kFormOfConstraint});
  }
}

ParameterConstraint make_constraint(const std::string& text, const std::string& less, const std::string& more,
                                    const std::vector<std::string>& names, const SourceLocation& where, const std::string& element) {
  // Check each side by itself: an empty or unbalanced side could still give a valid expression together with the other side.
  for (const std::string& side : {less, more}) static_cast<void>(Expression(side, names));
  auto margin = std::make_shared<const Expression>("(" + more + ") - (" + less + ")", names);
  if (margin->dependencies().empty()) throw std::invalid_argument("no parameter appears in the constraint");
  return {text, std::move(margin), where, element};
}

}  // namespace codesign
