// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "optimization/search_trials.h"

namespace codesign {

/// A sum of squares psi = r^T r and its model at one point.
struct LeastSquaresPoint {
  double value = 0.0;        ///< psi
  Eigen::VectorXd gradient;  ///< psi_x = 2 J^T r
  Eigen::MatrixXd root;  ///< upper triangular R with R^T R = J^T J; see triangular_root(), RowRoot
  /// For a model with unknowns of its own, which take a step with each step of x: the decrease of
  /// psi by the step of these unknowns alone, to first order. It is added to the predicted decrease
  /// of a step of x, doc/theory.md (42).
  double inner_decrease = 0.0;
};

/// The sum of squares that minimize_squares() minimizes.
class LeastSquaresModel {
 public:
  enum class Outcome {
    kUsable,
    kFailed,  ///< the point has no value; the search turns back
    kStop     ///< the search must end
  };
  virtual ~LeastSquaresModel() = default;
  /// @param point set if kUsable.
  virtual Outcome evaluate(const Eigen::VectorXd& x, LeastSquaresPoint* point) = 0;
};

struct LevenbergMarquardtOptions {
  int max_evaluations = 200;
  /// of psi: the search ends when both predicted decrease and gain of a step are smaller
  double relative_tolerance = 1e-6;
  double largest_first_step = 1.0;  ///< the first step changes no variable by more
};

enum class LevenbergMarquardtEnd {
  kOptimum,            ///< no step predicts more than rounding of psi
  kValueTolerance,     ///< relative_tolerance is met
  kVariableTolerance,  ///< steps are below rounding of the variables
  kMaxEvaluations,
  kStartFailed,
  kStopped
};

/// The end as OptimizationResult::termination: `objective_tolerance_reached`, ...
const char* name_of(LevenbergMarquardtEnd end);

/// Minimizes a sum of squares within bounds by the method of Levenberg and Marquardt as a trust
/// region with Moré's scaling; doc/theory.md (24g). Each step is the minimum of the model
///   psi + psi_x^T p + p^T R^T R p    over    lower <= x + p <= upper,    |D p| <= Delta,
/// with D_j the largest norm so far of column j of R. The bounds are part of that problem, so that
/// a step slides along them. All points are within the bounds. It does not depend on the origin of
/// the residuals.
/// @param lower, upper may be infinite. @param x the start, within the bounds; receives the best
/// point.
/// @param best receives psi and its model there; unchanged if kStartFailed.
LevenbergMarquardtEnd minimize_squares(const LevenbergMarquardtOptions& options,
                                       const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                       LeastSquaresModel* model, Eigen::VectorXd* x,
                                       LeastSquaresPoint* best);

/// One attempt of a search by Levenberg-Marquardt, doc/theory.md (24g): the mean over the
/// scenarios, as a sum of squares, within bounds. The study must have passed check_search(). Sets
/// the termination. @param options its limit counts all evaluations of `trials`.
void search_squares(const OptimizerOptions& options, const Eigen::VectorXd& start,
                    const Scaling& scaling, SearchTrials* trials);

}  // namespace codesign
