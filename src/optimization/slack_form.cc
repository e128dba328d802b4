// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/slack_form.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace codesign {

SlackForm::SlackForm(const RobustOptions& options, Eigen::VectorXd weights)
    : measure_(options.measure), level_(options.level), weights_(std::move(weights)) {}

int SlackForm::variables() const {
  if (weights_.size() <= 1) return 0;
  if (measure_ == RobustMeasure::kWorst) return 1;
  return measure_ == RobustMeasure::kCvar ? 1 + static_cast<int>(weights_.size()) : 0;
}

double SlackForm::lower(int k) const { return k == 0 ? -std::numeric_limits<double>::infinity() : 0.0; }

Eigen::VectorXd SlackForm::start(const Eigen::VectorXd& psi, double threshold) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(variables());
  y[0] = threshold;
  for (int k = 1; k < y.size(); ++k) y[k] = std::max(0.0, psi[k - 1] - threshold);
  return y;
}

Eigen::VectorXd SlackForm::gradient() const {
  Eigen::VectorXd gradient(variables());
  gradient[0] = 1.0;
  if (gradient.size() > 1) gradient.tail(weights_.size()) = weights_ / (1.0 - level_);
  return gradient;
}

double SlackForm::constraint(int i, double psi, const Eigen::VectorXd& y) const { return psi - y[0] - (y.size() > 1 ? y[i + 1] : 0.0); }

}  // namespace codesign
