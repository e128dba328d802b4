// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <string>
#include <vector>

#include "ensemble/ensemble.h"

namespace codesign {

/// Most evaluations of the objective that a check by differences takes.
constexpr int kMostEvaluations = 12;

/// A gradient of the measure of an ensemble at a design, and what is known there.
struct ClaimedGradient {
  Eigen::VectorXd gradient;  ///< of the measure by the tuned parameters
  Eigen::VectorXd by_value;  ///< derivative of the measure by psi of each scenario
  double objective = 0.0;    ///< the sum of by_value times psi
  Statistics statistics;     ///< of runs with the study's own steps
  double runs = 1.0;         ///< their number
  /// A difference per range of a parameter that counts as none, at the end of a search.
  double allowed_per_range = 0.0;
};

/// Compares a gradient with differences of the objective along one line, from runs that take other
/// steps, doc/theory.md (22c): kMostEvaluations at most. Of a measure, the sum over the scenarios
/// with the weights `by_value`, which is smooth where the measure is not.
/// @param is_thorough false: ends as soon as the differences confirm the gradient, with the change
/// by the last extrapolation as the error.
IndependentCheck check_other_steps(const Ensemble& ensemble, const Eigen::VectorXd& rho,
                                   const ClaimedGradient& claim, bool is_thorough,
                                   const std::atomic<bool>* cancel);

/// Sets GradientCheck::independent of an ended check, with the warning `gradient_disagrees` in its
/// evaluation if the differences refute the gradient.
void check_other_steps(const Ensemble& ensemble, const Eigen::VectorXd& rho,
                       const std::atomic<bool>* cancel, GradientCheck* check);

/// The warning `gradient_disagrees`. @param objective as ClaimedGradient::objective.
Warning disagreement(const Ensemble& ensemble, const IndependentCheck& check, double objective);

/// Scenarios that failed count as the worst of the others: their weight is that one's.
void count_worst_for_failed(const std::vector<int>& failed, const Eigen::VectorXd& values,
                            Eigen::VectorXd* by_value);

/// How the differences were computed: "rodas5p, tolerance 1e-08, steps of at most 0.01 s".
std::string describe_steps(const IndependentCheck& check);

}  // namespace codesign
