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

/// An expression at a point, of which scalar_disagreement() compares the values.
struct ScalarPoint {
  ScalarPoint(const std::string& text, const std::vector<std::string>& names,
              const std::vector<double>& at)
      : expression(text, names), value(expression.value(at)) {
    for (const int index : expression.dependencies()) values.push_back(at[to_index(index)]);
    for (std::size_t k = 0; k < values.size(); ++k)
      slopes.push_back(expression.derivative_of(k, values));
  }

  /// Empty if a number is near the wanted one, or both are not finite; else which one is not.
  std::string fault(const char* what, double is, double wanted, double tolerance) const {
    if (is == wanted || std::abs(is - wanted) <= tolerance * (1.0 + std::abs(wanted)) ||
        (std::isnan(is) && std::isnan(wanted)))
      return "";
    return std::string(what) + " is " + std::to_string(is) + ", not " + std::to_string(wanted) +
           ": " + expression.text();
  }

  /// Every value as a number with derivatives, the k-th with 1 in lane k.
  std::vector<Lanes<4>> lanes() const {
    std::vector<Lanes<4>> result(values.begin(), values.end());
    for (std::size_t k = 0; k < result.size(); ++k) result[k].v[static_cast<int>(k)] = 1.0;
    return result;
  }

  Expression expression;
  double value = 0.0;
  std::vector<double> values, slopes;  ///< of the variables that appear, and by them
};

/// Why the complex step and lanes do not have the value of the double to the last bit, and the same
/// derivatives; empty if they do. Of any expression of at most four variables.
inline std::string slope_disagreement(const ScalarPoint& point) {
  std::string fault;
  const auto check = [&](const char* what, double is, double wanted, double tolerance) {
    if (fault.empty()) fault = point.fault(what, is, wanted, tolerance);
  };
  const Lanes<4> of_lanes = point.expression.evaluate<Lanes<4>>(point.lanes());
  check("the value of lanes", of_lanes.a, point.value, 0.0);
  for (std::size_t k = 0; k < point.values.size(); ++k) {
    std::vector<std::complex<double>> step(point.values.begin(), point.values.end());
    step[k] += std::complex<double>(0.0, 1e-30);
    const std::complex<double> stepped = point.expression.evaluate<std::complex<double>>(step);
    check("the real part", stepped.real(), point.value, 0.0);
    check("a lane", of_lanes.v[static_cast<int>(k)], point.slopes[k], 1e-13);
    if (std::abs(point.slopes[k]) < 1e100)
      check("the imaginary part", stepped.imag() * 1e30, point.slopes[k], 1e-13);
  }
  return fault;
}

/// Why the range over a box around the point does not contain the values in it.
inline std::string range_disagreement(const ScalarPoint& point) {
  constexpr double kBelow = 0.3, kWidth = 0.5, kRounding = 1e-12;
  constexpr int kSamples = 30;
  std::vector<ValueRange> box;
  for (const double x : point.values) box.emplace_back(x - kBelow, x - kBelow + kWidth);
  const ValueRange range = point.expression.evaluate<ValueRange>(box);
  std::string fault;
  for (int sample = 0; sample <= kSamples && fault.empty(); ++sample) {
    std::vector<double> inside;
    for (std::size_t k = 0; k < box.size(); ++k)
      inside.push_back(box[k].lower +
                       kWidth * std::fmod(0.618 * sample * static_cast<double>(k + 1), 1.0));
    const double value = point.expression.value_of(inside);
    fault = point.fault("the range", std::min(std::max(value, range.lower), range.upper), value,
                        kRounding);
  }
  return fault;
}

/// Why the scalars do not agree on an expression at a point, empty if they do: besides the above
/// the value and the rate of a series in time, and the value and the tangents of a recording. Of
/// expressions that do not magnify rounding, such as those of random_formula().
inline std::string scalar_disagreement(const std::string& text,
                                       const std::vector<std::string>& names,
                                       const std::vector<double>& at) {
  constexpr double kTolerance = 1e-9;  // of composed functions, times their slopes
  const ScalarPoint point(text, names, at);
  std::string fault = slope_disagreement(point);
  if (fault.empty()) fault = range_disagreement(point);
  const auto check = [&](const char* what, double is, double wanted) {
    if (fault.empty()) fault = point.fault(what, is, wanted, kTolerance);
  };
  const std::size_t size = point.values.size();
  std::vector<Taylor<double>> series(point.values.begin(), point.values.end());
  double rate = 0.0;
  for (std::size_t k = 0; k < size; ++k) {
    series[k].c[1] = 1.0 + 0.5 * static_cast<double>(k);
    rate += point.slopes[k] * series[k].c[1];
  }
  const Taylor<double> in_time = evaluate_formula<Taylor<double>>(point.expression.steps(), series);
  const Lanes<4> recorded =
      recorded_value(point.expression, point.lanes(), std::vector<bool>(size, false));
  check("the value of a series", in_time.c[0], point.value);
  check("the rate of a series", in_time.c[1], rate);
  check("the value of a recording", recorded.a, point.value);
  for (std::size_t k = 0; k < size; ++k)
    check("a tangent of a recording", recorded.v[static_cast<int>(k)], point.slopes[k]);
  return fault;
}

}  // namespace codesign
