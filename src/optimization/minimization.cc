// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/minimization.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>
#include <limits>

#include "description/study.h"
#include "math/arrays.h"
#include "optimization/algorithm.h"
#include "optimization/scaling.h"
#include "optimization/search_trials.h"
#include "optimization/smooth_program.h"
#include "problem/margins.h"

namespace codesign {
namespace {

// Violation of a constraint row that NLopt accepts, in the unit of the row and of least_margin().
constexpr double kRowTolerance = 1e-9, kRowShare = 1e-2;
constexpr int kMostRestarts = 8;
constexpr std::int64_t kCallsPerEvaluation = 100;
constexpr const char* kInsideFinder = "mma";
// A failed line search has converged if the scaled gradient fell below this fraction of the first.
constexpr double kSlopeLeft = 1e-2;

/// One attempt of a search by an algorithm of NLopt: the state that its callbacks share.
class Minimization {
 public:
  /// @param options its limit counts all evaluations of `trials`.
  Minimization(const Study& study, const OptimizerOptions& options, const Scaling& scaling,
               SmoothProgram* program, SearchTrials* trials)
      : study_(study), options_(options), scaling_(scaling), program_(*program), trials_(*trials) {
    for (const ParameterRows::Row& row : trials_.parameter_rows().rows()) {
      const bool is_equality = trials_.parameter_rows().is_equality(row);
      constraints_.push_back({this, row, is_equality, -1.0});
      if (is_equality) constraints_.push_back({this, row, true, 1.0});
    }
  }

  /// Sets the termination. @returns why the algorithm failed, if it did.
  std::string run(const Eigen::VectorXd& start) {
    nlopt::opt optimizer = make_optimizer(options_, dimension());
    configure(&optimizer);
    take_unit();
    std::vector<double> x = scaling_.to_scaled(start);
    minimize(&optimizer, &x);
    while (should_restart()) restart(&optimizer);
    return failure_;
  }

 private:
  struct Constraint {
    Minimization* owner;
    ParameterRows::Row row;
    bool is_equality;
    double sign;  ///< of the margin in the left side of a row c <= 0
  };

  void configure(nlopt::opt* optimizer) {
    std::vector<double> lower = scaling_.lower(), upper = scaling_.upper();
    for (int k = 0; k < program_.slacks(); ++k) {
      lower.push_back(program_.lower(k));
      upper.push_back(std::numeric_limits<double>::infinity());
    }
    optimizer->set_lower_bounds(lower);
    optimizer->set_upper_bounds(upper);
    optimizer->set_min_objective(&Minimization::objective_callback, this);
    optimizer->set_ftol_rel(options_.relative_tolerance);
    // NLopt counts calls: this limit ends an algorithm that asks for the same points only.
    optimizer->set_maxeval(static_cast<int>(
        std::min<std::int64_t>(kCallsPerEvaluation * options_.max_evaluations + 1000, INT_MAX)));
    add_constraints(optimizer);
    const auto tolerances = [](int n) { return std::vector<double>(to_index(n), kRowTolerance); };
    if (program_.inequalities() > 0)
      optimizer->add_inequality_mconstraint(&Minimization::inequality_callback, this,
                                            tolerances(program_.inequalities()));
    const int equalities = program_.equalities();
    if (equalities > 0 && moves_inside_)
      optimizer->add_inequality_mconstraint(&Minimization::equality_callback, this,
                                            tolerances(2 * equalities));
    else if (equalities > 0)
      optimizer->add_equality_mconstraint(&Minimization::equality_callback, this,
                                          tolerances(equalities));
  }

  /// The constraints among parameters: an equality as one row, or as both of its sides.
  void add_constraints(nlopt::opt* optimizer) {
    for (Constraint& constraint : constraints_) {
      const double tolerance = std::min(
          kRowTolerance,
          kRowShare * -least_margin(study_, study_.constraints[constraint.row.constraint]));
      if (!constraint.is_equality || moves_inside_)
        optimizer->add_inequality_constraint(&Minimization::constraint_callback, &constraint,
                                             tolerance);
      else if (constraint.sign < 0.0)
        optimizer->add_equality_constraint(&Minimization::constraint_callback, &constraint,
                                           tolerance);
    }
  }

  /// Appends the slack variables at the start.
  void add_slack(std::vector<double>* x) {
    if (program_.slacks() == 0) return;
    const Eigen::VectorXd rho = scaling_.from_scaled(*x);
    if (trials_.last_rho().size() == 0 || trials_.last_rho() != rho) evaluate(rho);
    const Eigen::VectorXd y = program_.start(last_, unit_);
    x->insert(x->end(), y.begin(), y.end());
  }

  /// Whether a search that ended at a violated bound of a signal goes on from the best point: SLSQP
  /// may stop by the objective's tolerance while it is still outside.
  bool should_restart() {
    const bool ended_outside = (program_.has_signals() || has_equalities()) &&
                               trials_.have_best() && !trials_.interrupted() &&
                               !trials_.best_keeps_bounds();
    const bool has_progressed =
        trials_.best_violation() < 0.9 * violation_before_ || restarts_ == 0;
    return ended_outside && has_progressed && restarts_ < kMostRestarts &&
           result_.cost.evaluations < options_.max_evaluations;
  }

  void restart(nlopt::opt* optimizer) {
    ++restarts_;
    violation_before_ = trials_.best_violation();
    if (options_.algorithm != kInsideFinder) move_inside();
    run_from(result_.best.rho, optimizer);
  }

  /// Looks for a feasible point by the method of moving asymptotes, which finds one from far away:
  /// from the start, since the best point may lie in a valley of the violation, then from the best.
  /// It takes an equality h = 0 as h <= 0 and -h <= 0.
  void move_inside() {
    OptimizerOptions options = options_;
    options.algorithm = kInsideFinder;
    nlopt::opt optimizer = make_optimizer(options, dimension());
    moves_inside_ = true;
    configure(&optimizer);
    run_from(restarts_ == 1 ? result_.initial.rho : result_.best.rho, &optimizer);
    moves_inside_ = false;
  }

  void run_from(const Eigen::VectorXd& rho, nlopt::opt* optimizer) {
    if (trials_.interrupted() || result_.cost.evaluations >= options_.max_evaluations) return;
    std::vector<double> x = scaling_.to_scaled(rho);
    minimize(optimizer, &x);
  }

  bool has_equalities() const {
    return std::any_of(constraints_.begin(), constraints_.end(),
                       [](const Constraint& one) { return one.is_equality; });
  }

  unsigned dimension() const {
    return static_cast<unsigned>(study_.tuned.size()) + static_cast<unsigned>(program_.slacks());
  }

  void minimize(nlopt::opt* optimizer, std::vector<double>* x) {
    double value = 0.0;
    try {
      add_slack(x);
      result_.termination = termination_name(optimizer->optimize(*x, value));
      if (result_.termination == "max_evaluations_reached")
        result_.termination = "roundoff_limited";
    } catch (const nlopt::forced_stop&) {
    } catch (const nlopt::roundoff_limited&) {
      // SLSQP ends like this also where the gradients of the constraints depend on each other.
      result_.termination = program_.has_signals() ? "algorithm_failed" : "roundoff_limited";
      failure_ =
          "its linear systems are singular to working precision, as with constraints that depend "
          "on each other";
    } catch (const std::exception& error) {
      result_.termination = "algorithm_failed";
      failure_ = error.what();
    }
    // Some algorithms of NLopt call a forced stop a failure.
    if (is_at_limit_) result_.termination = "max_evaluations_reached";
    if (result_.termination == "algorithm_failed" && trials_.have_best() && has_converged())
      result_.termination = "roundoff_limited";
  }

  /// Whether a failed line search ended at an optimum: its points hardly differ, nor do they slope.
  bool has_converged() {
    const double difference = std::abs(last_.total.objective - result_.best.objective),
                 small = options_.relative_tolerance * std::abs(result_.best.objective);
    if (!last_.total.status.ok() || difference > small) return false;
    return trials_.best_keeps_bounds() && trials_.slope_left() <= kSlopeLeft;
  }

  static double objective_callback(const std::vector<double>& x, std::vector<double>& gradient,
                                   void* self) {
    return static_cast<Minimization*>(self)->objective(x, &gradient);
  }

  // -margin(rho) <= 0, or = 0.
  static double constraint_callback(const std::vector<double>& x, std::vector<double>& gradient,
                                    void* data) {
    const auto& constraint = *static_cast<Constraint*>(data);
    const Minimization& owner = *constraint.owner;
    Eigen::VectorXd by_rho;
    const double margin = owner.trials_.parameter_rows().margin(
        constraint.row, owner.design(x), gradient.empty() ? nullptr : &by_rho);
    // A constraint that is not finite counts as violated, the more the farther from the best point.
    if (!std::isfinite(margin))
      return 1.0 + owner.scaling_.square_distance(owner.result_.best.rho, x, 1.0, &gradient);
    std::fill(gradient.begin(), gradient.end(), 0.0);
    for (std::size_t k = 0; k < gradient.size() && k < owner.study_.tuned.size(); ++k)
      gradient[k] = constraint.sign * by_rho[to_signed(k)] * owner.scaling_.range(k);
    return constraint.sign * margin;
  }

  static void inequality_callback(unsigned count, double* values, unsigned size, const double* x,
                                  double* gradient, void* self) {
    auto* owner = static_cast<Minimization*>(self);
    const std::vector<double> at(x, x + size);
    owner->fill_rows(count, values, at, gradient,
                     [&](int row) { return owner->program_.inequality(row, owner->slack(at)); });
  }
  /// Of each equality h the row h, or both h and -h, as many as NLopt was told.
  static void equality_callback(unsigned count, double* values, unsigned size, const double* x,
                                double* gradient, void* self) {
    auto* owner = static_cast<Minimization*>(self);
    const int sides = static_cast<int>(count) / owner->program_.equalities();
    owner->fill_rows(count, values, {x, x + size}, gradient, [&](int row) {
      const SmoothProgram::Value value = owner->program_.equality(row / sides);
      return row % sides == 0 ? value : -value;
    });
  }

  /// Values and gradients of constraint rows by NLopt's variables. At a point that cannot be
  /// evaluated all are violated, (24).
  template <class RowOf>
  void fill_rows(unsigned count, double* values, const std::vector<double>& x, double* gradient,
                 const RowOf& row_of) {
    evaluate_at(x);
    const bool usable = last_.total.status.ok();
    std::vector<double> back(gradient ? x.size() : 0, 0.0);
    const double refused = usable ? 0.0 : step_back(x, &back);
    for (unsigned i = 0; i < count; ++i) {
      double* const by_x = gradient ? gradient + std::size_t{i} * x.size() : nullptr;
      if (!usable) {
        values[i] = refused;
        if (by_x) std::copy(back.begin(), back.end(), by_x);
        continue;
      }
      const SmoothProgram::Value row = row_of(static_cast<int>(i));
      values[i] = row.value;
      if (by_x) spread(row, scaling_, by_x);
    }
  }

  /// The tuned parameters of NLopt's variables, which the slack variables follow.
  Eigen::VectorXd design(const std::vector<double>& x) const {
    return scaling_.from_scaled({x.begin(), x.begin() + to_signed(study_.tuned.size())});
  }
  Eigen::VectorXd slack(const std::vector<double>& x) const {
    return Eigen::Map<const Eigen::VectorXd>(x.data() + study_.tuned.size(), program_.slacks());
  }

  double objective(const std::vector<double>& x, std::vector<double>* gradient) {
    evaluate_at(x);
    const Evaluation& evaluation = last_.total;
    if (evaluation.status.ok()) worst_ = std::max(worst_, evaluation.objective);
    if (!evaluation.status.ok()) return step_back(x, gradient);
    if (program_.slacks() > 0) {
      const SmoothProgram::Value value = program_.objective(slack(x));
      if (!gradient->empty()) spread(value, scaling_, gradient->data());
      return value.value;
    }
    if (!gradient->empty()) {
      *gradient = scaling_.scale_gradient(evaluation.gradient);
      for (double& component : *gradient) component /= unit_;
    }
    return evaluation.objective / unit_;
  }

  void evaluate_at(const std::vector<double>& x) {
    // Some line searches of NLopt continue to call after a forced stop.
    if (trials_.interrupted()) throw nlopt::forced_stop();
    const Eigen::VectorXd rho = design(x);
    // Algorithms ask for the same point again: at their bounds, and for constraints.
    if (rho.size() != trials_.last_rho().size() || rho != trials_.last_rho()) evaluate(rho);
  }

  void evaluate(const Eigen::VectorXd& rho) {
    is_at_limit_ = result_.cost.evaluations >= options_.max_evaluations;
    if (is_at_limit_ || !trials_.evaluate(rho, Derivatives::kGradient)) throw nlopt::forced_stop();
    if (moves_inside_ && trials_.best_violation() == 0.0) throw nlopt::forced_stop();
    if (result_.cost.evaluations == 1) take_unit();
  }

  // The first step of a quasi-Newton method is as long as the gradient; divided by unit_, at
  // most 1.
  void take_unit() {
    if (trials_.have_best())
      unit_ = std::max(1.0, scaling_.gradient_norm(result_.initial.gradient));
  }

  // The value (24) of a point that cannot be evaluated, from which a line search turns back.
  double step_back(const std::vector<double>& x, std::vector<double>* gradient) const {
    if (!trials_.have_best()) throw std::runtime_error("the start could not be evaluated");
    const double weight = std::abs(worst_) + std::abs(result_.best.objective) + 1e-300;
    return (worst_ + weight * (1.0 + scaling_.square_distance(result_.best.rho, x, weight / unit_,
                                                              gradient))) /
           unit_;
  }

  const Study& study_;
  const OptimizerOptions options_;
  const Scaling& scaling_;
  SmoothProgram& program_;
  SearchTrials& trials_;
  const EnsembleEvaluation& last_ = trials_.last();
  OptimizationResult& result_ = trials_.result();
  std::vector<Constraint> constraints_;
  std::string failure_;
  /// worst objective so far; NLopt gets objectives divided by `unit_`
  double worst_ = 0.0, unit_ = 1.0;
  bool moves_inside_ = false;
  bool is_at_limit_ = false;  ///< whether the search asked for more evaluations than it may have
  double violation_before_ = 0.0;  ///< best_violation() when the search was last restarted
  int restarts_ = 0;
};

}  // namespace

std::string minimize(const Study& study, const OptimizerOptions& options, const Scaling& scaling,
                     const Eigen::VectorXd& start, SmoothProgram* program, SearchTrials* trials) {
  return Minimization(study, options, scaling, program, trials).run(start);
}

}  // namespace codesign
