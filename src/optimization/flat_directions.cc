// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/flat_directions.h"

#include <cmath>
#include <utility>

#include "math/dense.h"

namespace codesign {
namespace {

using Eigen::Index;

constexpr double kFlat = 1e-4;      // singular value of R over the largest one: its square is 1e-8
constexpr double kBalances = 1e-6;  // smaller entries of a direction are rounding

/// The rows of a basis reduced so that each has one parameter of its own, the one that moves most.
void reduce(Eigen::MatrixXd* rows) {
  for (Index k = 0; k < rows->rows(); ++k) {
    Index row = 0, column = 0;
    rows->bottomRows(rows->rows() - k).cwiseAbs().maxCoeff(&row, &column);
    rows->row(k).swap(rows->row(k + row));
    rows->row(k) /= (*rows)(k, column);
    for (Index other = 0; other < rows->rows(); ++other)
      if (other != k) rows->row(other) -= ((*rows)(other, column) * rows->row(k)).eval();
  }
}

}  // namespace

Eigen::MatrixXd flat_directions(const Eigen::MatrixXd& root, const Eigen::MatrixXd& active, const std::vector<bool>& held) {
  std::vector<Index> moving;
  for (Index k = 0; k < root.cols(); ++k)
    if (!held[static_cast<std::size_t>(k)]) moving.push_back(k);
  const auto count = static_cast<Index>(moving.size());
  Eigen::MatrixXd stacked(root.rows() + active.cols(), count);
  for (Index k = 0; k < count; ++k) {
    stacked.col(k).head(root.rows()) = root.col(moving[static_cast<std::size_t>(k)]);
    stacked.col(k).tail(active.cols()) = active.row(moving[static_cast<std::size_t>(k)]).transpose();
  }
  // A constraint holds its direction whatever its unit.
  const double size = stacked.topRows(root.rows()).norm();
  for (Index k = root.rows(); k < stacked.rows(); ++k)
    if (const double norm = stacked.row(k).norm(); norm > 0.0) stacked.row(k) *= size / norm;
  if (count == 0 || !(size > 0.0)) return Eigen::MatrixXd(root.cols(), 0);
  const SingularValues svd = singular_values(stacked, SingularVectors::kRight);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count);
  values.head(svd.values.size()) = svd.values;
  const Index flat = (values.array() < kFlat * values[0]).count();
  Eigen::MatrixXd rows = svd.V.rightCols(flat).transpose();
  reduce(&rows);
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(root.cols(), flat);
  for (Index k = 0; k < count; ++k)
    for (Index d = 0; d < flat; ++d)
      if (std::abs(rows(d, k)) > kBalances) directions(moving[static_cast<std::size_t>(k)], d) = rows(d, k);
  return directions;
}

}  // namespace codesign
