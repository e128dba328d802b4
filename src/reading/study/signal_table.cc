// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/signal_table.h"

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <vector>

#include "text/number_text.h"

namespace codesign {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t kMostKnots = 100;  // values; the expression has their square of terms
constexpr double kNegligible = 1e-14;    // of the largest coefficient of its row

/// Second derivatives of the natural cubic spline at its knots, by the values: f'' = C v, (C2d).
MatrixXd natural_curvature(const Eigen::VectorXd& x) {
  const Index n = x.size();
  MatrixXd of_curvature = MatrixXd::Identity(n, n), of_values = MatrixXd::Zero(n, n);
  for (Index k = 1; k + 1 < n; ++k) {
    const double before = x[k] - x[k - 1], after = x[k + 1] - x[k];
    of_curvature.row(k).segment<3>(k - 1) << before / 6.0, (before + after) / 3.0, after / 6.0;
    of_values.row(k).segment<3>(k - 1) << 1.0 / before, -1.0 / before - 1.0 / after, 1.0 / after;
  }
  return of_curvature.partialPivLu().solve(of_values);
}

/// The function as v_0 + b (s - x_0) + sum_k c_k max(s - x_k, 0)^degree: its rows are b and the
/// c_k, by the values.
MatrixXd truncated_powers(const Eigen::VectorXd& x, bool is_cubic) {
  const Index n = x.size();
  MatrixXd rows = MatrixXd::Zero(1 + n, n);
  rows(0, 0) = -1.0 / (x[1] - x[0]);
  rows(0, 1) = 1.0 / (x[1] - x[0]);
  const MatrixXd curvature = is_cubic ? natural_curvature(x) : MatrixXd::Zero(n, n);
  if (is_cubic) rows.row(0) -= (x[1] - x[0]) / 6.0 * curvature.row(1);
  for (Index k = 0; k + 1 < n; ++k) {
    const double span = x[k + 1] - x[k];
    if (is_cubic) {
      const Eigen::RowVectorXd third = (curvature.row(k + 1) - curvature.row(k)) / (6.0 * span);
      rows.row(1 + k) += third;
      rows.row(2 + k) -= third;
    } else if (k > 0) {
      rows.row(1 + k).segment<3>(k - 1) << 1.0 / (x[k] - x[k - 1]),
          -1.0 / (x[k] - x[k - 1]) - 1.0 / span, 1.0 / span;
    }
  }
  return rows;
}

std::string weighted_sum(const Eigen::RowVectorXd& weights, const std::vector<std::string>& of) {
  const double least = kNegligible * weights.cwiseAbs().maxCoeff();
  std::string text;
  for (Index k = 0; k < weights.size(); ++k)
    if (std::abs(weights[k]) > least)
      text += (text.empty() ? "" : " + ") + ("(" + to_decimal(weights[k]) + ")*") +
              of[static_cast<std::size_t>(k)];
  return text.empty() ? "0" : "(" + text + ")";
}

std::string without_braces(const std::string& text) {
  return "(" + (is_expression(text) ? expression_in(text) : text) + ")";
}

Eigen::VectorXd read_knots(const YamlValue& at) {
  std::vector<double> x;
  for (const YamlValue& item : at.items()) {
    x.push_back(item.number());
    if (x.size() > 1 && !(x[x.size() - 2] < x.back()))
      item.fail("the values of the signal must ascend", "more than " + to_decimal(x[x.size() - 2]));
  }
  if (x.size() < 2 || x.size() > kMostKnots)
    at.fail("a table has " + std::to_string(x.size()) + " values of its signal",
            "2 to " + std::to_string(kMostKnots));
  return Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Index>(x.size()));
}

}  // namespace

SignalDescription read_signal_table(const YamlValue& value, const ParameterTable& table) {
  value.require_keys({"type", "signal", "at", "values"}, {"interpolation"});
  const auto interpolation = value.find("interpolation");
  const bool is_cubic =
      !interpolation || interpolation->choice("interpolation", {"cubic", "linear"}) == "cubic";
  const YamlValue signal = value.at("signal"), at = value.at("at"), values = value.at("values");
  const Eigen::VectorXd x = read_knots(at);
  std::vector<std::string> v;
  for (const YamlValue& item : values.items()) {
    read_quantity(item, table);
    v.push_back(without_braces(item.text()));
  }
  if (static_cast<Index>(v.size()) != x.size())
    values.fail("found " + std::to_string(v.size()) + " values for " + std::to_string(x.size()) +
                    " of the signal",
                "one per value of `at`");
  if (parse_signal(signal.text(), signal.where(), signal.path()).terms.empty())
    signal.fail("no signal", "a signal, such as slide/position");
  const std::string argument = without_braces(signal.text());
  const auto beyond = [&](Index k) { return "( " + argument + " - (" + to_decimal(x[k]) + ") )"; };
  const MatrixXd rows = truncated_powers(x, is_cubic);
  std::string text = v[0] + " + " + weighted_sum(rows.row(0), v) + "*" + beyond(0);
  for (Index k = 0; k < x.size(); ++k) {
    const std::string weight = weighted_sum(rows.row(1 + k), v);
    if (weight == "0") continue;
    text += " + ";
    text += weight;
    text += "*max(" + beyond(k) + ", 0)";
    if (is_cubic) text += "^3";
  }
  return parse_signal("${" + text + "}", value.where(), value.path());
}

}  // namespace codesign
