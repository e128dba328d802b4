// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ensemble/scenario.h"

namespace codesign {

/// The constraints among parameters of a study, doc/theory.md (24f): each constraint holds in every
/// scenario. If runs or samples change parameters that a constraint reads, it has one row for each
/// combination of their values, otherwise a single row.
class ParameterRows {
 public:
  struct Row {
    std::size_t constraint = 0;  ///< index in Study::constraints
    std::size_t scenario = 0;
  };

  /// Both must outlive this. @param scenarios at least one.
  ParameterRows(const Study& study, const std::vector<Scenario>& scenarios);

  const std::vector<Row>& rows() const { return rows_; }
  bool is_equality(const Row& row) const;
  /// The margin of a row at a design, in the unit of the constraint; negative where it is violated,
  /// of an equality not zero; NaN where it has no real value.
  /// @param by_rho if not null, its derivatives by the tuned parameters.
  double margin(const Row& row, const Eigen::VectorXd& rho, Eigen::VectorXd* by_rho) const;
  /// The least margin_left() of each constraint over its rows, NaN if the margin of a row is NaN;
  /// order of Study::constraints.
  Eigen::VectorXd margins(const Eigen::VectorXd& rho) const;
  /// @throws InputError naming the first constraint and scenario whose margin is not finite at the
  /// start of a search.
  void require_numbers_at(const Eigen::VectorXd& start) const;

 private:
  const Study& study_;
  const std::vector<Scenario>& scenarios_;
  std::vector<Row> rows_;
};

}  // namespace codesign
