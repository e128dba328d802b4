// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/signal_table.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Numbers = std::vector<double>;

constexpr double kNegligible = 1e-14;  // of the largest weight of a value in a sum

/// The points of a table.
struct Points {
  Numbers x;                             ///< ascending
  std::vector<std::string> texts;        ///< of the values, as parts of an expression
  Numbers numbers;                       ///< the values; of an expression 0
  std::vector<std::size_t> expressions;  ///< indices of the values that are expressions
  bool is_cubic = true, is_periodic = false;

  std::size_t size() const { return x.size(); }
  double span(std::size_t k) const { return x[k + 1] - x[k]; }
};

/// Solves a tridiagonal system by elimination; no pivots, since the diagonal dominates.
Numbers solve_tridiagonal(const Numbers& below, Numbers diagonal, const Numbers& above,
                          Numbers right) {
  for (std::size_t k = 1; k < right.size(); ++k) {
    const double factor = below[k] / diagonal[k - 1];
    diagonal[k] -= factor * above[k - 1];
    right[k] -= factor * right[k - 1];
  }
  for (std::size_t k = right.size(); k-- > 0;) {
    if (k + 1 < right.size()) right[k] -= above[k] * right[k + 1];
    right[k] /= diagonal[k];
  }
  return right;
}

/// The second derivatives of a cubic spline at its knots by its values, (C2d): those at both ends
/// are zero, or of a periodic one the same as all its derivatives.
class Spline {
 public:
  explicit Spline(const Points& points) : points_(points) {
    const std::size_t count = points.is_periodic ? points.size() - 1 : points.size();
    below_.assign(count, 0.0);
    diagonal_.assign(count, 1.0);
    above_.assign(count, 0.0);
    for (std::size_t k = 0; k < count; ++k) {
      if (is_end(k)) continue;
      below_[k] = before(k) / 6.0;
      above_[k] = points.span(k) / 6.0;
      diagonal_[k] = (before(k) + points.span(k)) / 3.0;
    }
  }

  /// For values `v`, one per point.
  Numbers curvature(const Numbers& v) const {
    Numbers right(below_.size(), 0.0);
    for (std::size_t k = 0; k < right.size(); ++k)
      if (!is_end(k))
        right[k] = (v[k + 1] - v[k]) / points_.span(k) -
                   (v[k] - v[k > 0 ? k - 1 : right.size() - 1]) / before(k);
    if (!points_.is_periodic) return solve_tridiagonal(below_, diagonal_, above_, right);
    Numbers m = solve_cyclic(right);
    m.push_back(m.front());
    return m;
  }

 private:
  bool is_end(std::size_t k) const {
    return !points_.is_periodic && (k == 0 || k + 1 == points_.size());
  }
  /// The interval before a knot; before the first one of a period its last.
  double before(std::size_t k) const { return points_.span(k > 0 ? k - 1 : points_.size() - 2); }

  /// The corners below_[0] and above_[last] by the formula of Sherman and Morrison.
  Numbers solve_cyclic(const Numbers& right) const {
    const std::size_t last = right.size() - 1;
    if (last == 0) return {0.0};
    const double gamma = -diagonal_[0], corner = above_[last];
    Numbers diagonal = diagonal_, u(right.size(), 0.0);
    diagonal[0] -= gamma;
    diagonal[last] -= corner * below_[0] / gamma;
    u[0] = gamma;
    u[last] += corner;
    Numbers m = solve_tridiagonal(below_, diagonal, above_, right);
    const Numbers z = solve_tridiagonal(below_, diagonal, above_, u);
    const auto along = [&](const Numbers& y) { return y[0] + below_[0] / gamma * y[last]; };
    const double factor = along(m) / (1.0 + along(z));
    for (std::size_t k = 0; k <= last; ++k) m[k] -= factor * z[k];
    return m;
  }

  const Points& points_;
  Numbers below_, diagonal_, above_;
};

std::string in_brackets(double number) { return "(" + to_decimal(number) + ")"; }

/// The second derivatives at the knots as texts: numbers, and multiples of values that are
/// expressions.
std::vector<std::string> curvature_texts(const Points& points) {
  std::vector<std::string> texts;
  if (!points.is_cubic) return texts;
  const Spline spline(points);
  for (const double number : spline.curvature(points.numbers)) texts.push_back(to_decimal(number));
  for (const std::size_t of : points.expressions) {
    if (points.is_periodic && of + 1 == points.size()) continue;  // the first one again
    Numbers unit(points.size(), 0.0);
    unit[of] = 1.0;
    if (points.is_periodic && of == 0) unit.back() = 1.0;
    const Numbers weights = spline.curvature(unit);
    double largest = 0.0;
    for (const double weight : weights) largest = std::max(largest, std::abs(weight));
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (std::abs(weights[k]) > kNegligible * largest)
        texts[k] += " + " + in_brackets(weights[k]) + "*" + points.texts[of];
  }
  for (std::string& text : texts) text = "(" + text + ")";
  return texts;
}

/// Writes a table as an expression: nested conditions halve the points until one piece is left.
class Writer {
 public:
  Writer(const Points& points, std::string argument)
      : points_(points), m_(curvature_texts(points)), argument_(std::move(argument)) {
    if (!points_.is_periodic) return;
    const std::string period = in_brackets(points_.x.back() - points_.x.front());
    argument_ = "(" + argument_ + " - " + period + "*floor((" + argument_ + " - " +
                in_brackets(points_.x.front()) + ")/" + period + "))";
  }

  std::string text() const {
    const std::size_t pieces = points_.size() - 1;
    if (points_.is_periodic || !points_.is_cubic) return between(0, pieces);
    if (pieces == 1) return tangent(0, false);
    // Beyond its ends the spline goes on along its tangents.
    return "(" + argument_ + " < " + in_brackets(points_.x.front()) + " ? " + tangent(0, false) +
           " : (" + argument_ + " < " + in_brackets(points_.x.back()) + " ? " + between(0, pieces) +
           " : " + tangent(pieces, true) + "))";
  }

 private:
  /// The pieces from `first` to `last` - 1.
  std::string between(std::size_t first, std::size_t last) const {
    if (last - first == 1) return piece(first);
    const std::size_t middle = first + (last - first) / 2;
    return "(" + argument_ + " < " + in_brackets(points_.x[middle]) + " ? " +
           between(first, middle) + " : " + between(middle, last) + ")";
  }

  std::string beyond(std::size_t k) const {
    return "(" + argument_ + " - " + in_brackets(points_.x[k]) + ")";
  }

  /// Has the very values of both knots there, so that the pieces meet.
  std::string piece(std::size_t k) const {
    const double h = points_.span(k);
    const std::string u = beyond(k) + "/" + in_brackets(h), rest = "(1 - " + u + ")";
    std::string text = rest + "*" + points_.texts[k] + " + " + u + "*" + points_.texts[k + 1];
    if (points_.is_cubic)
      text += " - " + in_brackets(h * h / 6.0) + "*" + u + "*" + rest + "*((2 - " + u + ")*" +
              m_[k] + " + (1 + " + u + ")*" + m_[k + 1] + ")";
    return "(" + text + ")";
  }

  /// The line through a knot with the slope of the piece before or after it, where the second
  /// derivative is zero.
  std::string tangent(std::size_t k, bool of_before) const {
    const std::size_t from = of_before ? k - 1 : k;
    const double h = points_.span(from);
    const std::string& m = m_[of_before ? from : from + 1];
    return "(" + points_.texts[k] + " + ((" + points_.texts[from + 1] + " - " +
           points_.texts[from] + ")/" + in_brackets(h) + (of_before ? " + " : " - ") +
           in_brackets(h / 6.0) + "*" + m + ")*" + beyond(k) + ")";
  }

  const Points& points_;
  const std::vector<std::string> m_;
  std::string argument_;
};

std::string without_braces(const std::string& text) {
  return "(" + (is_expression(text) ? expression_in(text) : text) + ")";
}

Numbers read_knots(const YamlValue& at) {
  Numbers x;
  for (const YamlValue& item : at.items()) {
    x.push_back(item.number());
    if (x.size() > 1 && !(x[x.size() - 2] < x.back()))
      item.fail("the values of the signal must ascend", "more than " + to_decimal(x[x.size() - 2]));
  }
  if (x.size() < 2)
    at.fail("a table has " + std::to_string(x.size()) + " values of its signal", "2 or more");
  return x;
}

void read_values(const YamlValue& values, const ParameterTable& table, Points* points) {
  for (const YamlValue& item : values.items()) {
    const Quantity quantity = read_quantity(item, table);
    if (!quantity.is_constant()) points->expressions.push_back(points->texts.size());
    points->numbers.push_back(quantity.is_constant() ? quantity.nominal() : 0.0);
    points->texts.push_back(without_braces(item.text()));
  }
  if (points->texts.size() != points->size())
    values.fail("found " + std::to_string(points->texts.size()) + " values for " +
                    std::to_string(points->size()) + " of the signal",
                "one per value of `at`");
}

/// One period ends as it begins.
void check_period(const YamlValue& values, const Points& points) {
  const bool is_same = points.expressions.empty() || (points.expressions.front() > 0 &&
                                                      points.expressions.back() + 1 < points.size())
                           ? points.numbers.front() == points.numbers.back()
                           : points.texts.front() == points.texts.back();
  if (!is_same)
    values.items().back().fail("the last value of a periodic table differs from the first",
                               points.texts.front());
}

}  // namespace

SignalDescription read_signal_table(const YamlValue& value, const ParameterTable& table) {
  value.require_keys({"type", "signal", "at", "values"}, {"interpolation", "periodic"});
  const auto interpolation = value.find("interpolation"), periodic = value.find("periodic");
  Points points;
  points.is_cubic =
      !interpolation || interpolation->choice("interpolation", {"cubic", "linear"}) == "cubic";
  points.is_periodic = periodic && periodic->boolean();
  const YamlValue signal = value.at("signal"), at = value.at("at"), values = value.at("values");
  points.x = read_knots(at);
  read_values(values, table, &points);
  if (points.is_periodic) check_period(values, points);
  if (parse_signal(signal.text(), signal.where(), signal.path()).terms.empty())
    signal.fail("no signal", "a signal, such as slide/position");
  const std::string text = Writer(points, without_braces(signal.text())).text();
  return parse_signal("${" + text + "}", value.where(), value.path());
}

}  // namespace codesign
