// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/far_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "math/dense.h"

namespace codesign {

using Eigen::Index;

FarRows::FarRows(Index variables, const std::vector<Holder>& holders, std::vector<std::size_t> far, Eigen::VectorXd distances)
    : variables_(variables), holders_(holders), far_(std::move(far)), distances_(std::move(distances)) {
  Index leading = 0;
  for (const std::size_t k : far_) leading = std::max(leading, holders_[k].leading.size());
  leading_.setZero(leading, distances_.size());
  std::map<std::vector<Index>, std::size_t> group_of;
  for (Index row = 0; row < distances_.size(); ++row) {
    const Holder& holder = holders_[far_[static_cast<std::size_t>(row)]];
    if (holder.leading.size() > 0) leading_.col(row) = holder.leading / distances_[row];
    if (holder.is_bound) continue;
    std::vector<Index> pattern;
    for (const auto& other : holder.others) pattern.push_back(other.first);
    const auto [place, is_new] = group_of.try_emplace(std::move(pattern), groups_.size());
    if (is_new) groups_.emplace_back();
    groups_[place->second].push_back(row);
  }
}

Eigen::VectorXd FarRows::along(const Eigen::VectorXd& x) const {
  Eigen::VectorXd products = leading_.transpose() * x.head(leading_.rows());
  for (Index row = 0; row < products.size(); ++row)
    for (const auto& [variable, entry] : holders_[far_[static_cast<std::size_t>(row)]].others)
      products[row] += entry / distances_[row] * x[variable];
  return products;
}

Eigen::VectorXd FarRows::sum(const Eigen::VectorXd& p) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(variables_);
  x.head(leading_.rows()) = leading_ * p;
  for (Index row = 0; row < p.size(); ++row) {
    if (p[row] == 0.0) continue;
    for (const auto& [variable, entry] : holders_[far_[static_cast<std::size_t>(row)]].others)
      x[variable] += entry / distances_[row] * p[row];
  }
  return x;
}

Eigen::MatrixXd FarRows::metric(const std::vector<bool>& active) const {
  Eigen::VectorXd squares = Eigen::VectorXd::Ones(variables_);
  for (std::size_t k = 0; k < far_.size(); ++k)
    if (active[k] && holders_[far_[k]].is_bound) squares[holders_[far_[k]].others[0].first] += std::pow(distance(k), -2);
  Eigen::MatrixXd rows = squares.cwiseSqrt().asDiagonal();
  for (const std::vector<Index>& group : groups_) append(group, active, &rows);
  return rows;
}

/// Appends the active rows of a group, as a triangle if they are more than the variables that they read.
void FarRows::append(const std::vector<Index>& group, const std::vector<bool>& active, Eigen::MatrixXd* rows) const {
  std::vector<Index> chosen;
  for (const Index row : group)
    if (active[static_cast<std::size_t>(row)]) chosen.push_back(row);
  if (chosen.empty()) return;
  const auto others_of = [&](Index row) -> const auto& { return holders_[far_[static_cast<std::size_t>(row)]].others; };
  const auto& pattern = others_of(chosen[0]);
  const Index leading = leading_.rows(), columns = leading + static_cast<Index>(pattern.size());
  Eigen::MatrixXd block(static_cast<Index>(chosen.size()), columns);
  for (Index k = 0; k < block.rows(); ++k) {
    const Index row = chosen[static_cast<std::size_t>(k)];
    block.row(k).head(leading) = leading_.col(row).transpose();
    for (std::size_t i = 0; i < pattern.size(); ++i) block(k, leading + static_cast<Index>(i)) = others_of(row)[i].second / distances_[row];
  }
  if (block.rows() > columns) block = upper_factor(block);
  rows->conservativeResize(rows->rows() + block.rows(), Eigen::NoChange);
  auto added = rows->bottomRows(block.rows());
  added.setZero();
  added.leftCols(leading) = block.leftCols(leading);
  for (std::size_t i = 0; i < pattern.size(); ++i) added.col(pattern[i].first) = block.col(leading + static_cast<Index>(i));
}

}  // namespace codesign
