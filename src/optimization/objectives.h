// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "description/study.h"
#include "ensemble/ensemble.h"
#include "optimization/tradeoff.h"

namespace codesign {

/// The objectives of `tradeoff:`, each with the problem in which it is the only one, and searches
/// for the worst of them.
class Objectives {
 public:
  /// Both must outlive this.
  Objectives(const Problem& problem, const std::atomic<bool>* cancel);

  /// The least of one objective alone, from the study's start.
  OptimizationResult search_alone(std::size_t objective) const;
  /// The scenarios of all objectives, each (f_k - offset_k)/scale_k.
  std::vector<Scenario> scaled(const Eigen::VectorXd& offset, const Eigen::VectorXd& scale) const;
  /// The least of the worst of these.
  OptimizationResult search(const Eigen::VectorXd& start,
                            const std::vector<Scenario>& scenarios) const;

  /// Sets all objectives of the design of a point, or its status. @returns whether they exist.
  bool evaluate(TradeoffPoint* point) const;
  /// Sets the objectives of a point from those of scaled() scenarios.
  void take_values(const std::vector<Scenario>& scenarios, const Eigen::VectorXd& values,
                   TradeoffPoint* point) const;

 private:
  std::size_t count() const { return problems_.size(); }

  const std::atomic<bool>* cancel_;
  std::vector<Problem> problems_;
  std::vector<Scenario> scenarios_;  ///< of all objectives
  std::vector<std::size_t> owners_;  ///< per scenario: its objective
  /// The worst of all scenarios, or of the mean of each objective.
  RobustOptions worst_;
  std::shared_ptr<EvaluationEngine> engine_;
  Study study_;  ///< with the terms of all
};

/// Takes over design, end and cost of a search.
void take_search(const OptimizationResult& found, TradeoffPoint* point);

}  // namespace codesign
