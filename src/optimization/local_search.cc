// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/local_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "description/tuned_parameters.h"
#include "optimization/algorithm.h"
#include "optimization/scaling.h"
#include "optimization/search_warnings.h"
#include "optimization/slack_form.h"
#include "problem/margins.h"

namespace codesign {
namespace {

constexpr double kSlopeLeft = 1e-2;  // a failed line search has converged if the scaled gradient fell below this fraction of the first one

/// One optimization: the state that NLopt's callbacks share.
class Minimization {
 public:
  Minimization(const Study& study, const OptimizerOptions& options, const Ensemble& ensemble, const TrialObserver& observer,
               const std::atomic<bool>* cancel)
      : study_(study),
        options_(options),
        observer_(observer),
        cancel_(cancel),
        ensemble_(ensemble),
        scaling_(study),
        slack_(ensemble.options(), ensemble.weights()) {}

  OptimizationResult run(const Eigen::VectorXd& start) {
    const auto dimension = static_cast<unsigned>(study_.tuned.size()) + static_cast<unsigned>(slack_.variables());
    nlopt::opt optimizer = make_optimizer(study_, options_, dimension, slack_.constraints() > 0);
    configure(&optimizer);
    result_.initial_rho = result_.rho = start;
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
    std::vector<double> lower = scaling_.lower(), upper = scaling_.upper();
    for (int k = 0; k < slack_.variables(); ++k) {
      lower.push_back(slack_.lower(k));
      upper.push_back(std::numeric_limits<double>::infinity());
    }
    optimizer->set_lower_bounds(lower);
    optimizer->set_upper_bounds(upper);
    optimizer->set_min_objective(&Minimization::objective_callback, this);
    optimizer->set_ftol_rel(options_.relative_tolerance);
    optimizer->set_maxeval(options_.max_evaluations);
    constraints_.reserve(study_.constraints.size());
    for (const ParameterConstraint& constraint : study_.constraints) {
      constraints_.push_back({this, &constraint});
      optimizer->add_inequality_constraint(&Minimization::constraint_callback, &constraints_.back(), 1e-9);
    }
    if (slack_.constraints() > 0)
      optimizer->add_inequality_mconstraint(&Minimization::slack_callback, this,
                                            std::vector<double>(static_cast<std::size_t>(slack_.constraints()), 1e-9));
  }

  /// The slack variables at the start, in the unit of the scaled objective.
  void add_slack(std::vector<double>* x) {
    if (slack_.variables() == 0) return;
    evaluate(result_.initial_rho);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(slack_.variables());
    if (last_.total.status.ok()) y = slack_.start(last_.values, last_.threshold) / unit_;
    x->insert(x->end(), y.begin(), y.end());
  }

  void minimize(nlopt::opt* optimizer, std::vector<double>* x) {
    double value = 0.0;
    try {
      add_slack(x);
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
    const double difference = std::abs(last_.total.objective - result_.objective);
    if (!last_.total.status.ok() || difference > options_.relative_tolerance * std::abs(result_.objective)) return false;
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
    const std::vector<double> parameters = parameters_at(constraint.owner->study_, constraint.owner->design(x));
    const Expression& margin = *constraint.constraint->margin;
    const double value = margin.value(parameters);
    if (!std::isfinite(value)) return constraint.owner->step_back_from_constraint(x, &gradient);
    std::fill(gradient.begin(), gradient.end(), 0.0);
    for (std::size_t k = 0; k < gradient.size() && k < constraint.owner->study_.tuned.size(); ++k)
      gradient[k] = -margin.derivative(constraint.owner->study_.tuned[k], parameters) * scaling.range(k);
    return -value;
  }

  // A constraint that is not finite counts as violated, with a value that grows with the distance from the best point.
  double step_back_from_constraint(const std::vector<double>& x, std::vector<double>* gradient) const {
    return 1.0 + distance_from_best(x, 1.0, gradient);
  }

  // psi_i - t - z_i <= 0, in units of the scaled objective.
  static void slack_callback(unsigned count, double* values, unsigned size, const double* x, double* gradient, void* self) {
    static_cast<Minimization*>(self)->slack_constraints(static_cast<int>(count), values, {x, x + size}, gradient);
  }

  void slack_constraints(int count, double* values, const std::vector<double>& x, double* gradient) {
    evaluate_at(x);
    const bool usable = last_.total.status.ok();
    std::vector<double> back(gradient ? x.size() : 0, 0.0);
    const double refused = usable ? 0.0 : step_back(x, &back);
    const Eigen::VectorXd y = slack(x);
    for (int i = 0; i < count; ++i) {
      values[i] = slack_.constraint(i, usable ? last_.values[i] / unit_ : refused, y);
      if (!gradient) continue;
      double* const row = gradient + static_cast<std::size_t>(i) * x.size();
      const std::vector<double> by_x = usable ? scaling_.scale_gradient(last_.gradients.col(i)) : back;
      for (std::size_t k = 0; k < study_.tuned.size(); ++k) row[k] = usable ? by_x[k] / unit_ : by_x[k];
      for (int k = 0; k < slack_.variables(); ++k) row[study_.tuned.size() + static_cast<std::size_t>(k)] = slack_.by_slack(i, k);
    }
  }

  /// The tuned parameters of NLopt's variables, which the slack variables follow.
  Eigen::VectorXd design(const std::vector<double>& x) const {
    return scaling_.from_scaled({x.begin(), x.begin() + static_cast<std::ptrdiff_t>(study_.tuned.size())});
  }
  Eigen::VectorXd slack(const std::vector<double>& x) const {
    return Eigen::Map<const Eigen::VectorXd>(x.data() + study_.tuned.size(), slack_.variables());
  }

  double objective(const std::vector<double>& x, std::vector<double>* gradient) {
    evaluate_at(x);
    const Evaluation& evaluation = last_.total;
    if (evaluation.status.ok()) worst_ = std::max(worst_, evaluation.objective);
    if (slack_.variables() > 0) return slack_objective(x, gradient);
    if (!evaluation.status.ok()) return step_back(x, gradient);
    if (!gradient->empty()) {
      *gradient = scaling_.scale_gradient(evaluation.gradient);
      for (double& component : *gradient) component /= unit_;
    }
    return evaluation.objective / unit_;
  }

  double slack_objective(const std::vector<double>& x, std::vector<double>* gradient) const {
    if (!have_best_) throw std::runtime_error("the start could not be evaluated");
    std::fill(gradient->begin(), gradient->end(), 0.0);
    const Eigen::VectorXd by_slack = slack_.gradient();
    for (int k = 0; k < slack_.variables() && !gradient->empty(); ++k)
      (*gradient)[study_.tuned.size() + static_cast<std::size_t>(k)] = by_slack[k];
    return slack_.objective(slack(x));
  }

  void evaluate_at(const std::vector<double>& x) {
    // Some line searches of NLopt continue to call after a forced stop.
    if (cancelled_) stop();
    const Eigen::VectorXd rho = design(x);
    // An algorithm at its bounds may ask for the same point again, and constraints are asked for after the objective.
    if (rho.size() != last_rho_.size() || rho != last_rho_) evaluate(rho);
  }

  void evaluate(const Eigen::VectorXd& rho) {
    last_ = ensemble_.evaluate(rho, true, cancel_);
    if (last_.total.status.code == StatusCode::kCancelled) stop();
    last_rho_ = rho;
    const Trial trial = note(last_, rho);
    if (observer_ && !observer_(trial)) stop();
    // The first step of a quasi-Newton method is as long as the gradient; divided by unit_, it is at most 1 in scaled variables, (24).
    if (trial.evaluation == 1 && last_.total.status.ok()) unit_ = std::max(1.0, trial.gradient_norm);
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
    for (std::size_t k = 0; k < best.size(); ++k) {
      const double d = x[k] - best[k];
      distance += d * d;
      if (!gradient->empty()) (*gradient)[k] = 2.0 * weight * d;
    }
    return distance;
  }

  Trial note(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
    const Evaluation& evaluation = all.total;
    Trial trial;
    trial.evaluation = ++result_.evaluations;
    trial.status = evaluation.status;
    trial.rho = rho;
    result_.statistics += evaluation.statistics;
    if (evaluation.status.ok()) {
      trial.objective = evaluation.objective;
      trial.gradient = evaluation.gradient;
      trial.gradient_norm = scaling_.gradient_norm(evaluation.gradient);
      for (std::size_t k = 0; k < result_.influences.size(); ++k)
        if ((all.gradients.row(static_cast<Eigen::Index>(k)).array() != 0.0).any()) result_.influences[k] = true;
      take_best(all, rho);
    } else {
      ++result_.failed_evaluations;
      if (result_.evaluations == 1) first_failure_ = evaluation.status;
    }
    trial.iteration = result_.iterations;
    trial.best_objective = result_.objective;
    return trial;
  }

  // A start that violates the constraints is the best point only until a feasible point is found.
  void take_best(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
    const Evaluation& evaluation = all.total;
    const bool inside = all_met(constraint_margins(study_, parameters_at(study_, rho))), first = !have_best_;
    if (first) {
      result_.initial_objective = evaluation.objective;
      result_.initial_values = all.values;
      result_.initial_failed = all.failed;
      result_.initial_gradient = evaluation.gradient;
    }
    const bool better = first || (inside && !best_feasible_) || (inside == best_feasible_ && evaluation.objective < result_.objective);
    if (!better) return;
    if (!first) ++result_.iterations;
    have_best_ = true;
    best_feasible_ = inside;
    result_.objective = evaluation.objective;
    result_.values = all.values;
    result_.failed = all.failed;
    result_.gradient = evaluation.gradient;
    result_.warnings = evaluation.warnings;
    result_.rho = rho;
  }

  const Study& study_;
  const OptimizerOptions options_;
  const TrialObserver& observer_;
  const std::atomic<bool>* cancel_;
  const Ensemble& ensemble_;
  Scaling scaling_;
  SlackForm slack_;
  Eigen::VectorXd last_rho_;
  EnsembleEvaluation last_;  ///< the evaluation at last_rho_
  std::vector<Constraint> constraints_;
  OptimizationResult result_;
  Status first_failure_{StatusCode::kNonFinite, 0.0, "no trial point could be evaluated"};
  std::string failure_;
  double worst_ = 0.0, unit_ = 1.0;  ///< worst objective so far; NLopt gets objectives divided by `unit_`
  bool have_best_ = false, best_feasible_ = false, cancelled_ = false;
};

}  // namespace

OptimizationResult search_locally(const Study& study, const OptimizerOptions& options, const Eigen::VectorXd& start,
                                  const Ensemble& ensemble, const TrialObserver& observer, const std::atomic<bool>* cancel) {
  return Minimization(study, options, ensemble, observer, cancel).run(start);
}

}  // namespace codesign
