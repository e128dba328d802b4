// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/optimization.h"

#include <cmath>
#include <limits>

#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "math/cpu_timer.h"
#include "optimization/algorithm.h"
#include "optimization/scaling.h"
#include "optimization/search_warnings.h"
#include "problem/margins.h"

namespace codesign {
namespace {

constexpr double kSlopeLeft = 1e-2;  // a failed line search has converged if the scaled gradient fell below this fraction of the first one

/// One optimization: the state that NLopt's callbacks share.
class Minimization {
 public:
  Minimization(const std::shared_ptr<const CompiledSystem>& system, const OptimizerOptions& options, const TrialObserver& observer,
               const std::atomic<bool>* cancel)
      : study_(system->study()), options_(options), observer_(observer), cancel_(cancel), evaluator_(system), scaling_(system->study()) {}

  OptimizationResult run() {
    nlopt::opt optimizer = make_optimizer(study_, options_, static_cast<unsigned>(study_.tuned.size()));
    configure(&optimizer);
    result_.initial_rho = result_.rho = scaling_.start();
    result_.influences.assign(study_.tuned.size(), false);
    require_numbers_at_start(study_, parameters_at(study_, result_.initial_rho));
    std::vector<double> x = scaling_.to_scaled(result_.initial_rho);
    minimize(&optimizer, &x);
    conclude();
    return std::move(result_);
  }

 private:
  struct Constraint {
    Minimization* owner;
    const ParameterConstraint* constraint;
  };

  void configure(nlopt::opt* optimizer) {
    optimizer->set_lower_bounds(scaling_.lower());
    optimizer->set_upper_bounds(scaling_.upper());
    optimizer->set_min_objective(&Minimization::objective_callback, this);
    optimizer->set_ftol_rel(options_.relative_tolerance);
    optimizer->set_maxeval(options_.max_evaluations);
    constraints_.reserve(study_.constraints.size());
    for (const ParameterConstraint& constraint : study_.constraints) {
      constraints_.push_back({this, &constraint});
      optimizer->add_inequality_constraint(&Minimization::constraint_callback, &constraints_.back(), 1e-9);
    }
  }

  void minimize(nlopt::opt* optimizer, std::vector<double>* x) {
    double value = 0.0;
    try {
      result_.termination = termination_name(optimizer->optimize(*x, value));
    } catch (const nlopt::forced_stop&) {
    } catch (const nlopt::roundoff_limited&) {
      result_.termination = "roundoff_limited";
    } catch (const std::exception& error) {
      result_.termination = "algorithm_failed";
      failure_ = error.what();
    }
    if (result_.termination == "algorithm_failed" && have_best_ && has_converged()) result_.termination = "roundoff_limited";
  }

  /// Sets the status and the termination, with the margins and warnings of the best point.
  void conclude() {
    result_.margins = constraint_margins(study_, parameters_at(study_, result_.rho));
    if (have_best_) append(search_warnings(study_, options_, result_), &result_.warnings);
    result_.status = {StatusCode::kSuccess, study_.duration, ""};
    if (cancelled_) {
      result_.termination = "cancelled";
      result_.status = {StatusCode::kCancelled, 0.0, "cancelled; the best point so far is kept"};
    } else if (!have_best_) {
      result_.status = first_failure_;
      result_.termination = "start_failed";
    } else if (result_.termination == "algorithm_failed") {
      result_.status = {StatusCode::kAlgorithmFailed, study_.duration,
                        "the algorithm \"" + options_.algorithm + "\" failed (" + failure_ +
                            "); the best point so far is kept; try another algorithm or another start"};
    } else if (!all_met(result_.margins)) {
      result_.status = {StatusCode::kInfeasible, study_.duration, describe_unmet(study_, result_.margins)};
    }
  }

  /// Whether a failed line search ended at an optimum: its points are equal within the relative tolerance, and the gradient is small, or a
  /// constraint is active.
  bool has_converged() const {
    const double difference = std::abs(last_.objective - result_.objective);
    if (!last_.status.ok() || difference > options_.relative_tolerance * std::abs(result_.objective)) return false;
    const Eigen::VectorXd margins = constraint_margins(study_, parameters_at(study_, result_.rho));
    if ((margins.array() < 1e-6).any()) return all_met(margins);
    const double start = scaling_.gradient_norm(result_.initial_gradient);
    return scaling_.free_gradient_norm(result_.rho, result_.gradient) <= kSlopeLeft * start;
  }

  static double objective_callback(const std::vector<double>& x, std::vector<double>& gradient, void* self) {
    return static_cast<Minimization*>(self)->objective(x, &gradient);
  }

  // -margin(rho) <= 0.
  static double constraint_callback(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
    const auto& constraint = *static_cast<Constraint*>(data);
    const Scaling& scaling = constraint.owner->scaling_;
    const std::vector<double> parameters = parameters_at(constraint.owner->study_, scaling.from_scaled(x));
    const Expression& margin = *constraint.constraint->margin;
    const double value = margin.value(parameters);
    if (!std::isfinite(value)) return constraint.owner->step_back_from_constraint(x, &gradient);
    for (std::size_t k = 0; k < gradient.size(); ++k)
      gradient[k] = -margin.derivative(constraint.owner->study_.tuned[k], parameters) * scaling.range(k);
    return -value;
  }

  // A constraint that is not finite counts as violated, with a value that grows with the distance from the best point.
  double step_back_from_constraint(const std::vector<double>& x, std::vector<double>* gradient) const {
    return 1.0 + distance_from_best(x, 1.0, gradient);
  }

  double objective(const std::vector<double>& x, std::vector<double>* gradient) {
    // Some line searches of NLopt continue to call after a forced stop.
    if (cancelled_) stop();
    const Eigen::VectorXd rho = scaling_.from_scaled(x);
    // An algorithm at its bounds may ask for the same point again.
    if (rho.size() != last_rho_.size() || rho != last_rho_) evaluate(rho);
    const Evaluation& evaluation = last_;
    if (!evaluation.status.ok()) return step_back(x, gradient);
    if (!gradient->empty()) {
      *gradient = scaling_.scale_gradient(evaluation.gradient);
      for (double& component : *gradient) component /= unit_;
    }
    worst_ = std::max(worst_, evaluation.objective);
    return evaluation.objective / unit_;
  }

  void evaluate(const Eigen::VectorXd& rho) {
    last_ = evaluator_.evaluate(rho, true, cancel_);
    if (last_.status.code == StatusCode::kCancelled) stop();
    last_rho_ = rho;
    const Trial trial = note(last_, rho);
    if (observer_ && !observer_(trial)) stop();
    // The first step of a quasi-Newton method is as long as the gradient; divided by unit_, it is at most 1 in scaled variables, (24).
    if (trial.evaluation == 1 && last_.status.ok()) unit_ = std::max(1.0, trial.gradient_norm);
  }

  // cancelled_ is kept, because the line searches of NLopt may report another reason than a forced stop.
  [[noreturn]] void stop() {
    cancelled_ = true;
    throw nlopt::forced_stop();
  }

  // The value (24) of a point that cannot be evaluated: worse than all values so far, and larger with growing distance from the best point,
  // so that a line search turns back.
  double step_back(const std::vector<double>& x, std::vector<double>* gradient) const {
    if (!have_best_) throw std::runtime_error("the start could not be evaluated");
    const double weight = std::abs(worst_) + std::abs(result_.objective) + 1e-300;
    return (worst_ + weight * (1.0 + distance_from_best(x, weight / unit_, gradient))) / unit_;
  }

  /// Squared distance from the best point in scaled variables. @param gradient if not empty, set to `weight` times its derivative.
  double distance_from_best(const std::vector<double>& x, double weight, std::vector<double>* gradient) const {
    const std::vector<double> best = scaling_.to_scaled(result_.rho);
    double distance = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double d = x[k] - best[k];
      distance += d * d;
      if (!gradient->empty()) (*gradient)[k] = 2.0 * weight * d;
    }
    return distance;
  }

  Trial note(const Evaluation& evaluation, const Eigen::VectorXd& rho) {
    Trial trial;
    trial.evaluation = ++result_.evaluations;
    trial.status = evaluation.status;
    trial.rho = rho;
    result_.statistics.steps += evaluation.statistics.steps;
    result_.statistics.rejected_steps += evaluation.statistics.rejected_steps;
    result_.statistics.cpu_seconds += evaluation.statistics.cpu_seconds;
    result_.statistics.constraint_drift = std::max(result_.statistics.constraint_drift, evaluation.statistics.constraint_drift);
    result_.statistics.energy_error = std::max(result_.statistics.energy_error, evaluation.statistics.energy_error);
    if (evaluation.status.ok()) {
      trial.objective = evaluation.objective;
      trial.gradient = evaluation.gradient;
      trial.gradient_norm = scaling_.gradient_norm(evaluation.gradient);
      for (std::size_t k = 0; k < result_.influences.size(); ++k)
        if (evaluation.gradient[static_cast<Eigen::Index>(k)] != 0.0) result_.influences[k] = true;
      take_best(evaluation, rho);
    } else {
      ++result_.failed_evaluations;
      if (result_.evaluations == 1) first_failure_ = evaluation.status;
    }
    trial.iteration = result_.iterations;
    trial.best_objective = result_.objective;
    return trial;
  }

  // A start that violates the constraints is the best point only until a feasible point is found.
  void take_best(const Evaluation& evaluation, const Eigen::VectorXd& rho) {
    const bool inside = all_met(constraint_margins(study_, parameters_at(study_, rho))), first = !have_best_;
    if (first) {
      result_.initial_objective = evaluation.objective;
      result_.initial_gradient = evaluation.gradient;
    }
    const bool better = first || (inside && !best_feasible_) || (inside == best_feasible_ && evaluation.objective < result_.objective);
    if (!better) return;
    if (!first) ++result_.iterations;
    have_best_ = true;
    best_feasible_ = inside;
    result_.objective = evaluation.objective;
    result_.gradient = evaluation.gradient;
    result_.warnings = evaluation.warnings;
    result_.rho = rho;
  }

  const Study& study_;
  const OptimizerOptions options_;
  const TrialObserver& observer_;
  const std::atomic<bool>* cancel_;
  Evaluator evaluator_;
  Scaling scaling_;
  Eigen::VectorXd last_rho_;
  Evaluation last_;  ///< the evaluation at last_rho_
  std::vector<Constraint> constraints_;
  OptimizationResult result_;
  Status first_failure_{StatusCode::kNonFinite, 0.0, "no trial point could be evaluated"};
  std::string failure_;
  double worst_ = 0.0, unit_ = 1.0;  ///< worst objective so far; NLopt gets objectives divided by `unit_`
  bool have_best_ = false, best_feasible_ = false, cancelled_ = false;
};

}  // namespace

OptimizationResult optimize(const std::shared_ptr<const CompiledSystem>& system, const OptimizerOptions& options,
                            const TrialObserver& observer, const std::atomic<bool>* cancel) {
  require_tuned(system->study());
  return Minimization(system, options, observer, cancel).run();
}

OptimizationResult optimize(const Problem& problem, const TrialObserver& observer, const std::atomic<bool>* cancel) {
  return optimize(problem.system(), problem.optimizer_options(), observer, cancel);
}

OptimizationResult optimize(const Problem& problem, const OptimizerOptions& options, const TrialObserver& observer,
                            const std::atomic<bool>* cancel) {
  return optimize(problem.system(), options, observer, cancel);
}

}  // namespace codesign
