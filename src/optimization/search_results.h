// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ensemble/ensemble.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/progress_meter.h"

namespace codesign {

/// Completes the result of a study with runs or uncertain parameters: names its scenarios, and
/// validates its best point on fresh samples if `robust.validate` asks for it. Does nothing for
/// other studies, and for a result without a point.
/// @param ensemble of the search; its engine runs the validation. @param meter counts the runs of
/// the validation.
void describe_scenarios(const Problem& problem, const Ensemble& ensemble,
                        const std::atomic<bool>* cancel, ProgressMeter* meter,
                        OptimizationResult* result);

/// The scenario that a result describes; one that was added to the samples of the problem, too.
Scenario scenario_of(const Problem& problem, const ScenarioResult& result);

/// Warnings about a finished search: `max_evaluations_reached`, `not_stationary`,
/// `parameter_on_bound`, `parameter_without_influence`, `flat_direction`.
Warnings search_warnings(const Study& study, const OptimizerOptions& options,
                         const OptimizationResult& result);

/// How the search ended, for people: "stationary to 3e-06", "stopped early: the slope is 0.4 of the
/// start's"; empty without a point.
std::string stop_sentence(const OptimizationResult& result);

/// Eigenvalues of the Gauss-Newton matrix below this share of the largest one count as zero.
constexpr double kFlatShare = 1e-8;
/// The directions in which the objective may be flat at a design: eigenvectors of the Gauss-Newton
/// matrix with eigenvalues below kFlatShare of the largest one, doc/theory.md (24i). Each parameter
/// that gives such a direction its name stands alone in it (entry 1), beside the parameters by
/// which it is balanced.
/// @param root R by the scaled parameters, R^T R the Gauss-Newton matrix. @param active gradients
/// of active constraints by the scaled parameters, one per column: a flat direction does not change
/// them. @param held parameters that do not move, such as those on a bound.
/// @returns one direction per column, by the scaled parameters; no columns without any.
Eigen::MatrixXd flat_directions(const Eigen::MatrixXd& root, const Eigen::MatrixXd& active,
                                const std::vector<bool>& held);

/// The least value of psi + g^T p + |R p|^2 over steps p of the parameters that are not held, and
/// the shortest step to it: of a sum of squares beside a design of a curved valley, its floor
/// there.
struct ValleyFloor {
  double value = 0.0;
  Eigen::VectorXd step;
};
/// @param value, gradient, root: psi, g and R. @param active, held as above.
ValleyFloor valley_floor(double value, const Eigen::VectorXd& gradient, const Eigen::MatrixXd& root,
                         const Eigen::MatrixXd& active, const std::vector<bool>& held);

}  // namespace codesign
