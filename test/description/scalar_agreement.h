// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "codegen/interpreter.h"
#include "codegen/traced.h"
#include "description/expression.h"
#include "description/formula.h"
#include "math/taylor.h"

namespace codesign {

/// A random expression of `names` whose parts have moderate values and slopes, so that rounding is
/// not magnified. Every function and operator occurs. @param below (count) -> 0 to count - 1
inline std::string random_formula(const std::vector<std::string>& names, int depth,
                                  const std::function<std::size_t(std::size_t)>& below) {
  static const std::vector<std::string> kForms = {"sqrt(1.5 + sin($))",
                                                  "sin($)",
                                                  "cos($)",
                                                  "tan(0.7*sin($))",
                                                  "asin(0.9*sin($))",
                                                  "acos(0.9*cos($))",
                                                  "atan($)",
                                                  "atan2($, 1.5 + cos($))",
                                                  "atan2(sin($), cos($))",
                                                  "sinh(sin($))",
                                                  "cosh(sin($))",
                                                  "tanh($)",
                                                  "exp(sin($))",
                                                  "log(1.5 + sin($))",
                                                  "log10(1.5 + cos($))",
                                                  "pow(1.5 + sin($), cos($))",
                                                  "sin($)**2",
                                                  "sin($)^(1 + 2)",
                                                  "pow(sin($), 12/4)",
                                                  "(1.5 + sin($))**-2",
                                                  "(1.5 + sin($))**2.5",
                                                  "abs($)",
                                                  "sign($)",
                                                  "min($, $, 2)",
                                                  "max($, $)",
                                                  "floor(3*$)",
                                                  "ceil(3*$)",
                                                  "radians($)",
                                                  "degrees($)/60",
                                                  "($) + ($)",
                                                  "($) - ($)",
                                                  "sin($)*($)",
                                                  "($)/(1.5 + sin($))",
                                                  "-($)",
                                                  "(($) < ($) ? ($) : ($))",
                                                  "(($) >= 0.2 ? sin($) : 1)",
                                                  "(($) == 0.2 ? 3 : cos($))"};
  if (depth == 0)
    return below(4) == 0 ? std::to_string(0.01 * static_cast<double>(below(300)))
                         : names[below(names.size())];
  std::string text;
  for (const char c : kForms[below(kForms.size())])
    text += c == '$' ? random_formula(names, depth - 1, below) : std::string(1, c);
  return text;
}

/// The value of an expression as its recording gives it. @param designed the variables that do not
/// vary in the recording, by index.
template <class T>
T recorded_value(const Expression& expression, const std::vector<T>& variables,
                 const std::vector<bool>& designed) {
  std::vector<bool> outcomes;
  for (;;) {
    Recording recording;
    recording.follow(outcomes);
    std::vector<Traced> leaves;
    for (std::size_t k = 0; k < variables.size(); ++k)
      leaves.emplace_back(&recording, recording.leaf(0, static_cast<int>(k), !designed[k]),
                          designed[k] ? value_of(variables[k]) : 0.0);
    const Traced result = evaluate_formula<Traced>(expression.steps(), leaves);
    std::vector<T> nodes;
    for (int n = 0; n < recording.size(); ++n) {
      const Recording::Node& node = recording.node(n);
      if (node.operation == Operation::kLiteral)
        nodes.push_back(T(node.literal));
      else if (node.operation == Operation::kLeaf)
        nodes.push_back(variables[to_index(node.b)]);
      else
        nodes.push_back(operate<T>(node.operation, nodes[to_index(node.a)],
                                   node.b < 0 ? T(0.0) : nodes[to_index(node.b)]));
    }
    const std::vector<Recording::Guard>& guards = recording.guards();
    const auto wrong = std::find_if(guards.begin(), guards.end(), [&](const auto& guard) {
      return (value_of(nodes[to_index(guard.a)]) < value_of(nodes[to_index(guard.b)])) !=
             guard.outcome;
    });
    if (wrong == guards.end())
      return result.is_literal() ? T(result.value()) : nodes[to_index(result.node())];
    outcomes.clear();
    for (auto guard = guards.begin(); guard != wrong; ++guard) outcomes.push_back(guard->outcome);
    outcomes.push_back(!wrong->outcome);
  }
}

/// Why the scalars do not agree on an expression at a point, empty if they do: numbers with
/// derivatives have the value of the double to the last bit; the derivatives of the complex step,
/// lanes, series and recordings agree; the range over a box around the point contains the values.
inline std::string scalar_disagreement(const std::string& text,
                                       const std::vector<std::string>& names,
                                       const std::vector<double>& at) {
  constexpr double kTolerance = 1e-9;  // of composed functions, times their slopes
  const Expression expression(text, names);
  const auto size = expression.dependencies().size();
  std::vector<double> values;
  for (const int index : expression.dependencies()) values.push_back(at[to_index(index)]);
  const double value = expression.value(at);
  const auto near = [](double a, double b, double tolerance) {
    return a == b || std::abs(a - b) <= tolerance * (1.0 + std::abs(a)) ||
           (std::isnan(a) && std::isnan(b));
  };
  const auto fault = [&](const std::string& what, double is, double wanted) {
    return what + " is " + std::to_string(is) + ", not " + std::to_string(wanted) + ": " + text;
  };
  std::vector<Lanes<4>> lanes(values.begin(), values.end());
  std::vector<Taylor<double>> series(values.begin(), values.end());
  double along = 0.0;
  for (std::size_t k = 0; k < size; ++k) {
    std::vector<std::complex<double>> step(values.begin(), values.end());
    step[k] += std::complex<double>(0.0, 1e-30);
    const double real = expression.evaluate<std::complex<double>>(step).real(),
                 slope = expression.derivative_of(k, values);
    if (!near(real, value, 0.0)) return fault("the real part", real, value);
    lanes[k].v[static_cast<int>(k)] = 1.0;
    series[k].c[1] = 1.0 + 0.5 * static_cast<double>(k);
    along += slope * series[k].c[1];
  }
  const Lanes<4> of_lanes = expression.evaluate<Lanes<4>>(lanes);
  const Taylor<double> of_time = evaluate_formula<Taylor<double>>(expression.steps(), series);
  const Lanes<4> recorded = recorded_value(expression, lanes, std::vector<bool>(size, false));
  if (!near(of_lanes.a, value, 0.0)) return fault("the value of lanes", of_lanes.a, value);
  if (!near(of_time.c[0], value, kTolerance)) return fault("a series", of_time.c[0], value);
  if (!near(of_time.c[1], along, kTolerance)) return fault("a rate", of_time.c[1], along);
  if (!near(recorded.a, value, kTolerance)) return fault("a recording", recorded.a, value);
  for (std::size_t k = 0; k < size; ++k) {
    const double slope = expression.derivative_of(k, values);
    const int lane = static_cast<int>(k);
    if (!near(of_lanes.v[lane], slope, 1e-13)) return fault("a lane", of_lanes.v[lane], slope);
    if (!near(recorded.v[lane], slope, kTolerance))
      return fault("a tangent of the recording", recorded.v[lane], slope);
  }
  std::vector<ValueRange> box;
  for (const double x : values) box.emplace_back(x - 0.3, x + 0.2);
  const ValueRange range = expression.evaluate<ValueRange>(box);
  for (int sample = 0; sample <= 30; ++sample) {
    std::vector<double> inside;
    for (std::size_t k = 0; k < size; ++k)
      inside.push_back(box[k].lower +
                       0.5 * std::fmod(0.618 * sample * static_cast<double>(k + 1), 1.0));
    const double there = expression.value_of(inside), slack = 1e-12 * (1.0 + std::abs(there));
    if (there < range.lower - slack) return fault("the least value", range.lower, there);
    if (there > range.upper + slack) return fault("the largest value", range.upper, there);
  }
  return "";
}

}  // namespace codesign
