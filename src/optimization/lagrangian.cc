// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/lagrangian.h"

#include <algorithm>
#include <vector>

#include "math/dense.h"

namespace codesign {
namespace {

constexpr double kActive = 1e-6;  // a row or a bound nearer than this, in its unit, is active

}  // namespace

void spread(const SmoothProgram::Value& value, const Scaling& scaling, double* by_x) {
  const std::vector<double> scaled = scaling.scale_gradient(value.by_rho);
  std::copy(value.by_slack.begin(), value.by_slack.end(), std::copy(scaled.begin(), scaled.end(), by_x));
}

double lagrangian_residual(const EnsembleEvaluation& at, const Eigen::VectorXd& rho, const Scaling& scaling, double unit,
                           SmoothProgram* program) {
  program->take(at, rho);
  const Eigen::VectorXd y = program->start(at, unit);
  const std::vector<double> x = scaling.to_scaled(rho), lower = scaling.lower(), upper = scaling.upper();
  const auto size = static_cast<Eigen::Index>(x.size()) + y.size();
  std::vector<Eigen::VectorXd> active;
  const auto add = [&](const SmoothProgram::Value& row) { spread(row, scaling, active.emplace_back(size).data()); };
  for (int i = 0; i < program->inequalities(); ++i)
    if (const SmoothProgram::Value row = program->inequality(i, y); row.value > -kActive) add(row);
  for (int i = 0; i < program->equalities(); ++i) add(program->equality(i));
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::min(x[k] - lower[k], upper[k] - x[k]) < kActive)
      active.emplace_back(Eigen::VectorXd::Unit(size, static_cast<Eigen::Index>(k)));
  Eigen::VectorXd gradient(size);
  spread(program->objective(y), scaling, gradient.data());
  if (active.empty()) return gradient.norm();
  Eigen::MatrixXd rows(size, static_cast<Eigen::Index>(active.size()));
  for (std::size_t k = 0; k < active.size(); ++k) rows.col(static_cast<Eigen::Index>(k)) = active[k];
  return (gradient - rows * least_norm(rows).solve(gradient)).norm();
}

}  // namespace codesign
