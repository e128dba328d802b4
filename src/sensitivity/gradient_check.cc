// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/gradient_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "math/differences.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"
#include "sensitivity/complex_steps.h"
#include "sensitivity/linear_check.h"
#include "sensitivity/run_steps.h"
#include "text/cancel.h"

namespace codesign {
namespace {

constexpr int kMostOfReference = 2000000;

/// The directions along which a reference is computed: those given, or each tuned parameter.
Eigen::MatrixXd directions_of(const CompiledSystem& system, const Eigen::MatrixXd& given) {
  const auto count = to_signed(system.study().tuned.size());
  return given.size() > 0 ? given : Eigen::MatrixXd::Identity(count, count);
}

/// Sets a failure if a component of the reference is not finite.
void refuse_non_finite(const CompiledSystem& system, GradientCheck* check) {
  for (Eigen::Index k = 0; k < check->reference.size(); ++k) {
    if (std::isfinite(check->reference[k]) && std::isfinite(check->reference_error[k])) continue;
    const MotionStudy& study = system.study();
    const bool along = check->directions.size() > 0;
    const std::string name = along ? "along direction " + std::to_string(k + 1)
                                   : "by \"" + tuned_parameter(study, k).name + "\"";
    check->status = {StatusCode::kNonFiniteGradient, study.duration,
                     "the reference for the gradient " + name + " is not finite"};
    return;
  }
}

/// Reference by Ridders' extrapolated differences [9]. The error of the objective must be far below
/// the differences, so tolerances are tightened, and no pulse may be passed over.
void check_by_differences(const CompiledSystem& system, const std::vector<double>& parameters,
                          const std::atomic<bool>* cancel, GradientCheck* check) {
  Study study =
      with_steps(system.whole_study(), {RunSteps::Method::kRodas5P, false, kMostOfReference});
  study.solver.relative_tolerance = std::min(study.solver.relative_tolerance, 1e-10);
  study.solver.absolute_tolerance = std::min(study.solver.absolute_tolerance, 1e-11);
  // Of postures, too, whose equations are then those of the implicit methods.
  study.solver.integrator = IntegratorKind::kRosenbrock;
  study.solver.method = RosenbrockMethod::kRodas5P;
  Evaluator evaluator =
      evaluator_of(std::make_shared<const CompiledSystem>(system.robot(), study, system.sharing()));
  const Eigen::MatrixXd directions = directions_of(system, check->directions);
  for (Eigen::Index k = 0; check->status.ok() && k < check->reference.size(); ++k) {
    const auto objective = [&](double step) {
      const Evaluation evaluation = evaluator.evaluate_design(
          moved(study, parameters, directions.col(k), step), false, cancel);
      if (!evaluation.status.ok()) check->status = evaluation.status;
      return evaluation.objective;
    };
    const double largest = step_along(study, parameters, directions.col(k), [](double value) {
      return 1e-2 * std::max(std::abs(value), 1e-3);
    });
    const RiddersDerivative derivative = ridders_derivative(objective, 0.0, largest);
    check->reference[k] = derivative.value;
    check->reference_error[k] = derivative.error;
  }
}

/// The reference along directions: a complex step through the steps of the run, and differences of
/// what is linearized.
Status differentiate(const CompiledSystem& system, const std::vector<double>& parameters,
                     const Eigen::MatrixXd& given, const std::atomic<bool>* cancel,
                     Eigen::VectorXd* objective, Eigen::VectorXd* error, Eigen::MatrixXd* watched) {
  const Eigen::MatrixXd directions = directions_of(system, given);
  objective->setZero(directions.cols());
  error->setZero(directions.cols());
  if (needs_run(system.study()))
    if (Status status = differentiate_steps(system, parameters, Derivatives::kGradient, directions,
                                            cancel, objective, watched);
        !status.ok())
      return status;
  return add_linear_differences(system, parameters, directions, cancel, objective, error, watched);
}

}  // namespace

bool can_replay(const MotionStudy& study) {
  return study.postures == 0 && study.solver.integrator == IntegratorKind::kRosenbrock &&
         std::none_of(study.watched.begin(), study.watched.end(), has_band);
}

Status differentiate_finer_steps(const CompiledSystem& system,
                                 const std::vector<double>& parameters,
                                 const Eigen::MatrixXd& directions, const std::atomic<bool>* cancel,
                                 Eigen::VectorXd* derivatives) {
  Study study = system.whole_study();
  for (double* tolerance : {&study.solver.relative_tolerance, &study.solver.absolute_tolerance})
    *tolerance = std::max(1e-2 * *tolerance, 1e-13);
  study.solver.maximum_steps *= 10;
  const CompiledSystem finer(system.robot(), study, system.sharing());
  Eigen::MatrixXd watched;
  Eigen::VectorXd error;
  return differentiate(finer, parameters, directions, cancel, derivatives, &error, &watched);
}

GradientCheck check_gradient(const Problem& problem, const Eigen::VectorXd& rho, CheckMethod method,
                             const std::atomic<bool>* cancel) {
  return check_gradient(system_of(problem), rho, method, cancel);
}

GradientCheck check_gradient(const std::shared_ptr<const CompiledSystem>& system,
                             const Eigen::VectorXd& rho, CheckMethod method,
                             const std::atomic<bool>* cancel) {
  return check_design(system, system->parameters(rho), method, cancel);
}

namespace {

/// The largest difference of a gradient from its reference along `directions`, relative to the
/// sizes that gradient.h names.
/// @param floor the smallest size.
double largest_difference(const Eigen::MatrixXd& directions, const Eigen::VectorXd& gradient,
                          const Eigen::VectorXd& reference, double floor) {
  const Eigen::VectorXd along =
      directions.size() > 0 ? Eigen::VectorXd(directions.transpose() * gradient) : gradient;
  double largest = 0.0;
  for (Eigen::Index k = 0; k < reference.size(); ++k) {
    const double difference = std::abs(along[k] - reference[k]);
    const double size = directions.size() > 0
                            ? directions.col(k).cwiseProduct(gradient).cwiseAbs().maxCoeff()
                            : std::abs(reference[k]);
    if (difference > 0.0) largest = std::max(largest, difference / std::max(size, floor));
  }
  return largest;
}

}  // namespace

void compare(GradientCheck* check) {
  if (check->reference.size() == 0) return;
  const auto compare_with = [check](const auto& gradient, const auto& reference, double floor) {
    check->largest_relative_difference =
        std::max(check->largest_relative_difference,
                 largest_difference(check->directions, gradient, reference, floor));
  };
  compare_with(check->evaluation.gradient, check->reference,
               1e-3 * check->reference.cwiseAbs().maxCoeff());
  if (check->finer.size() > 0)
    check->largest_change =
        largest_difference(check->directions, check->evaluation.gradient, check->finer,
                           1e-3 * check->finer.cwiseAbs().maxCoeff());
  // Values at the start may have gradients that are zero within rounding, so that differences are
  // compared with the largest gradient of all.
  const Eigen::MatrixXd& references = check->extreme_reference;
  if (references.size() == 0) return;
  const double floor = 1e-3 * references.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < references.cols(); ++k)
    compare_with(check->evaluation.extremes.gradients.col(k), references.col(k), floor);
}

Eigen::MatrixXd check_directions(const Eigen::VectorXd& gradient, int count) {
  const double floor = gradient.size() > 0 ? 1e-3 * gradient.cwiseAbs().maxCoeff() : 0.0;
  std::mt19937 bits(1);  // its sequence is the same everywhere
  Eigen::MatrixXd directions(gradient.size(), count);
  for (Eigen::Index column = 0; column < count; ++column)
    for (Eigen::Index k = 0; k < gradient.size(); ++k) {
      const double size = floor > 0.0 ? std::max(std::abs(gradient[k]), floor) : 1.0;
      // Not all of one size, so that a common factor does not cancel.
      const double part = 0.5 + static_cast<double>(bits()) / 4294967296.0;
      directions(k, column) = (bits() % 2 == 0 ? part : -part) / size;
    }
  return directions;
}

GradientCheck check_design(const std::shared_ptr<const CompiledSystem>& system,
                           const std::vector<double>& parameters, CheckMethod method,
                           const std::atomic<bool>* cancel, const Eigen::MatrixXd& directions) {
  const auto count =
      directions.size() > 0 ? directions.cols() : to_signed(system->study().tuned.size());
  GradientCheck check;
  check.directions = directions;
  const MotionStudy& study = system->study();
  check.method = can_replay(study) ? method : CheckMethod::kRidders;
  check.reference.setZero(count);
  check.reference_error.setZero(count);
  check.evaluation = evaluator_of(system).evaluate_design(parameters, true, cancel);
  check.status = check.evaluation.status;
  if (!check.status.ok()) return check;
  if (check.method == CheckMethod::kComplexStep) {
    check.status = differentiate(*system, parameters, directions, cancel, &check.reference,
                                 &check.reference_error, &check.extreme_reference);
  } else {
    check_by_differences(*system, parameters, cancel, &check);
  }
  if (check.status.ok()) refuse_non_finite(*system, &check);
  if (check.status.ok()) compare(&check);
  return check;
}

}  // namespace codesign
