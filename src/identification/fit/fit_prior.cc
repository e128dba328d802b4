// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/fit_prior.h"

#include <cmath>

namespace codesign {
namespace {

constexpr Eigen::Index kRowsOfInertia = 20;  // the divergence, then what is stated

/// With E = V V^T the divergence is a sum of squares: of V_ij above the diagonal and of these roots
/// of v^2 - 2 ln v - 1 with v = V_ii.
double diagonal_root(double v) {
  constexpr double kNear = 1e-3;
  const double h = v - 1.0;
  if (std::abs(h) < kNear)
    return h * std::sqrt(2.0 + h * (-2.0 / 3.0 + h * (0.5 + h * (-0.4 + h / 3.0))));
  return std::copysign(std::sqrt(v * v - 2.0 * std::log(v) - 1.0), h);
}

double diagonal_root_slope(double v) {
  const double root = diagonal_root(v);
  return root == 0.0 ? std::sqrt(2.0) : (v - 1.0 / v) / root;
}

Eigen::Matrix<double, 20, 1> rows_of(const InertiaPrior& prior, const RelativeInertia::Ten& x) {
  const Eigen::Matrix4d V = prior.relative.factor(x), E = V * V.transpose();
  Eigen::Matrix4d rows = Eigen::Matrix4d::Zero();
  for (int i = 0; i < 4; ++i) {
    rows(i, i) = diagonal_root(V(i, i));
    for (int j = i + 1; j < 4; ++j) rows(i, j) = V(i, j) / std::sqrt(2.0);
  }
  Eigen::Matrix<double, 20, 1> result;
  result << std::sqrt(prior.weight) * symmetric_numbers(rows),
      prior.stated().cwiseProduct(symmetric_numbers(E - Eigen::Matrix4d::Identity()));
  return result;
}

Eigen::Matrix<double, 20, 10> slopes_of(const InertiaPrior& prior, const RelativeInertia::Ten& x) {
  const Eigen::Matrix4d V = prior.relative.factor(x);
  Eigen::Matrix<double, 20, 10> result;
  for (int k = 0; k < 10; ++k) {
    const Eigen::Matrix4d dV = prior.relative.factor_slope(x, k), half = dV * V.transpose();
    Eigen::Matrix4d rows = dV / std::sqrt(2.0);
    for (int i = 0; i < 4; ++i) rows(i, i) = diagonal_root_slope(V(i, i)) * dV(i, i);
    result.col(k) << std::sqrt(prior.weight) * symmetric_numbers(rows),
        prior.stated().cwiseProduct(symmetric_numbers(half + half.transpose()));
  }
  return result;
}

}  // namespace

SymmetricNumbers InertiaPrior::stated() const {
  const double off = 1.0 / std::sqrt(2.0);  // these coordinates count entries above the diagonal so
  SymmetricNumbers result;
  result << 1.0 / moments, 1.0 / moments, 1.0 / moments, 1.0 / mass, off / moments, off / moments,
      off / centre, off / moments, off / centre, off / centre;
  return result;
}

Eigen::VectorXd FitPrior::rows(const Eigen::VectorXd& x) const {
  Eigen::VectorXd result(deviations.size() +
                         kRowsOfInertia * static_cast<Eigen::Index>(inertias.size()));
  if (deviations.size() > 0) result.head(deviations.size()) = (x - known).cwiseQuotient(deviations);
  Eigen::Index row = deviations.size();
  for (const InertiaPrior& inertia : inertias) {
    result.segment<kRowsOfInertia>(row) = rows_of(inertia, inertia.numbers(x));
    row += kRowsOfInertia;
  }
  return result;
}

Eigen::MatrixXd FitPrior::jacobian(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(
      deviations.size() + kRowsOfInertia * static_cast<Eigen::Index>(inertias.size()), x.size());
  result.topLeftCorner(deviations.size(), deviations.size()).diagonal() = deviations.cwiseInverse();
  Eigen::Index row = deviations.size();
  for (const InertiaPrior& inertia : inertias) {
    const Eigen::Matrix<double, 20, 10> slopes = slopes_of(inertia, inertia.numbers(x));
    for (std::size_t k = 0; k < inertia.columns.size(); ++k)
      result.col(inertia.columns[k]).segment<kRowsOfInertia>(row) =
          slopes.col(static_cast<Eigen::Index>(k));
    row += kRowsOfInertia;
  }
  return result;
}

}  // namespace codesign
