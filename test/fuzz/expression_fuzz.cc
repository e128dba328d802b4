// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/expression_fuzz.h"

#include <cmath>
#include <stdexcept>

#include "description/expression.h"
#include "description/scalar_agreement.h"
#include "fuzz/mutation.h"

namespace codesign::fuzz {
namespace {

const std::vector<std::string>& names() {
  static const std::vector<std::string> kNames = {"x", "y", "e"};
  return kNames;
}
const std::vector<double>& values() {
  static const std::vector<double> kValues = {0.7, -1.3, 2.0};
  return kValues;
}

/// An expression and its value.
struct Known {
  std::string text;
  double value = 0.0;
};

std::string space(Dice* dice) { return dice->one_in(3) ? dice->one_in(4) ? "\n" : " " : ""; }

Known known_expression(int depth, Dice* dice);

Known known_binary(int depth, Dice* dice) {
  const Known a = known_expression(depth - 1, dice), b = known_expression(depth - 1, dice);
  const std::string left = "(" + a.text + ")" + space(dice),
                    right = space(dice) + "(" + b.text + ")";
  switch (dice->below(5)) {
    case 0:
      return {left + "+" + right, a.value + b.value};
    case 1:
      return {left + "-" + right, a.value - b.value};
    case 2:
      return {left + "*" + right, a.value * b.value};
    case 3:
      return {"atan2" + space(dice) + left.substr(0, left.rfind(')')) + "," +
                  right.substr(right.find('(') + 1),
              std::atan2(a.value, b.value)};
    default:
      return {left + "<" + right + "?" + a.text + ":" + b.text,
              a.value < b.value ? a.value : b.value};
  }
}

Known known_expression(int depth, Dice* dice) {
  if (depth <= 0 || dice->one_in(5)) {
    const std::size_t k = dice->below(names().size());
    if (dice->one_in(2)) return {names()[k], values()[k]};
    const double number = static_cast<double>(dice->below(1000)) / 8.0;
    return {std::to_string(number), number};
  }
  if (dice->one_in(4)) {
    const Known a = known_expression(depth - 1, dice);
    return dice->one_in(2) ? Known{"-(" + a.text + ")", -a.value}
                           : Known{"sin(" + a.text + ")", std::sin(a.value)};
  }
  return known_binary(depth, dice);
}

std::string try_known(Dice* dice) {
  const Known known = known_expression(5, dice);
  const double value = Expression(known.text, names()).value(values());
  if (std::abs(value - known.value) <= 1e-12 * (1.0 + std::abs(known.value))) return "";
  return "an expression of the value " + std::to_string(known.value) + " has " +
         std::to_string(value) + ": " + known.text;
}

std::string try_any(Dice* dice) {
  const std::string text = random_expression(names(), 6, dice);
  try {
    if (const std::string fault = slope_disagreement({text, names(), values()}); !fault.empty())
      return fault;
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    const bool has_place = message.find(" at position ") != std::string::npos ||
                           message.find("empty") != std::string::npos;
    if (!has_place || message.size() > 1000)
      return "refused without a position, or at length: " + text + ": " + message;
  }
  return "";
}

std::string try_scalars(Dice* dice) {
  const auto below = [dice](std::size_t count) { return dice->below(count); };
  std::vector<double> at;
  // No value stands where the forms of random_formula() have their kinks and jumps.
  for (std::size_t k = 0; k < names().size(); ++k)
    at.push_back(0.001 * static_cast<double>(dice->below(4000)) - 2.00037);
  return scalar_disagreement(random_formula(names(), 3, below), names(), at);
}

}  // namespace

std::string try_expressions(int count, Dice* dice) {
  std::string fault;
  for (int k = 0; k < count && fault.empty(); ++k) {
    fault = try_any(dice);
    if (fault.empty()) fault = try_known(dice);
    if (fault.empty()) fault = try_scalars(dice);
  }
  return fault;
}

}  // namespace codesign::fuzz
