// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/gradient_engine.h"

#include <algorithm>
#include <cmath>

#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "integration/event_names.h"
#include "linear/rest_numbers.h"
#include "math/arrays.h"
#include "math/cpu_timer.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"
#include "sensitivity/adjoint_gradient.h"
#include "sensitivity/gradient_check.h"
#include "sensitivity/idas_gradient.h"
#include "sensitivity/posture_gradient.h"
#include "sensitivity/rosenbrock_gradient.h"
#include "sensitivity/signal_watch.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
bool prefers_adjoint(const CompiledSystem& system) {
  // Postures have derivatives of their own.
  if (system.study().postures > 0) return false;
  const SolverOptions& options = system.study().solver;
  if (options.integrator != IntegratorKind::kRosenbrock ||
      options.gradient == GradientMethod::kDirect)
    return false;
  // The adjoint has no derivatives of the extreme values of watched signals.
  if (!system.watched().empty()) return false;
  if (options.gradient == GradientMethod::kAdjoint) return true;
  return direct_cost(static_cast<int>(system.study().tuned.size())) > kAdjointCost;
}

std::unique_ptr<GradientEngine> make_gradient_engine(const CompiledSystem& system,
                                                     Derivatives derivatives) {
  if (system.study().postures > 0) return std::make_unique<PostureGradient>(system);
  if (system.study().solver.integrator == IntegratorKind::kIdas)
    return std::make_unique<IdasGradient>(system);
  if (derivatives == Derivatives::kGaussNewton) return std::make_unique<RosenbrockGradient>(system);
  if (prefers_adjoint(system)) return std::make_unique<AdjointGradient>(system);
  return std::make_unique<RosenbrockGradient>(system);
}

class Evaluator::Implementation {
 public:
  explicit Implementation(std::shared_ptr<const CompiledSystem> system)
      : system_(std::move(system)), watched_(system_->study()) {}

  Evaluation evaluate(const std::vector<double>& parameters, Derivatives derivatives,
                      const std::atomic<bool>* cancel) {
    Evaluation evaluation;
    std::unique_ptr<GradientEngine>& engine =
        derivatives == Derivatives::kGaussNewton ? root_engine_ : engine_;
    if (!engine) engine = make_gradient_engine(*system_, derivatives);
    if (const ControllerDescription* rounded =
            derivatives == Derivatives::kNone ? nullptr : find_rounded(system_->whole_study())) {
      evaluation.status = {StatusCode::kNonFiniteGradient, 0.0,
                           "there is no gradient: controllers." + rounded->name +
                               ".quantization rounds a measurement"};
      return evaluation;
    }
    const CpuTimer timer;
    engine->obey(cancel);
    evaluation.status = linearize(parameters, derivatives, cancel, &evaluation);
    if (!needs_run(system_->study())) {
      if (evaluation.status.ok()) add_terms(derivatives, &evaluation);
      evaluation.statistics.cpu_seconds = timer.seconds();
      return evaluation;
    }
    if (evaluation.status.ok())
      evaluation.status = run(engine.get(), parameters, derivatives, cancel);
    if (evaluation.status.ok()) collect(engine.get(), derivatives, cancel, &evaluation);
    evaluation.statistics = engine->statistics();
    evaluation.warnings = engine->warnings();
    if (engine->events()) evaluation.events = events_of(*system_, *engine->events());
    evaluation.statistics.cpu_seconds = timer.seconds();
    return evaluation;
  }
  Evaluation evaluate(const Eigen::VectorXd& rho, Derivatives derivatives,
                      const std::atomic<bool>* cancel) {
    parameters_at(system_->study(), rho, &parameters_);
    return evaluate(parameters_, derivatives, cancel);
  }

 private:
  /// Finds the numbers of a study that are those of its linearization at rest, theory (70). What
  /// has no value must not cost a run.
  Status linearize(const std::vector<double>& parameters, Derivatives derivatives,
                   const std::atomic<bool>* cancel, Evaluation* evaluation) {
    if (!needs_linearization(system_->study())) return {};
    if (!linear_) linear_ = std::make_unique<RestNumbers>(*system_);
    const bool with_gradient = derivatives != Derivatives::kNone;
    const Status status = linear_->evaluate(parameters, with_gradient, cancel);
    if (!needs_run(system_->study())) {
      const auto tuned = to_signed(system_->study().tuned.size());
      evaluation->objective = 0.0;
      if (with_gradient) evaluation->gradient.setZero(tuned);
      if (derivatives == Derivatives::kGaussNewton) evaluation->jacobian_root.setZero(tuned, tuned);
    }
    return status;
  }

  /// Puts them into the places that WatchLayout gives them.
  void place_numbers(bool with_gradient, Extremes* extremes) const {
    if (!linear_) return;
    const MotionStudy& study = system_->study();
    const Eigen::Index size = watched_.size();
    if (extremes->values.size() != size) {
      extremes->values.setZero(size);
      extremes->times.setZero(size);
    }
    if (with_gradient && extremes->gradients.cols() != size)
      extremes->gradients.setZero(to_signed(study.tuned.size()), size);
    std::size_t next = 0;
    for (std::size_t k = 0; k < study.watched.size(); ++k) {
      if (!study.watched[k].linear) continue;
      const RestNumbers::Entry& numbers = linear_->entries()[next++];
      const WatchLayout::Entry& entry = watched_.entries()[k];
      extremes->values.segment(entry.first, numbers.values.size()) = numbers.values;
      extremes->times.segment(entry.first, entry.size()).setZero();
      if (with_gradient)
        extremes->gradients.middleCols(entry.first, numbers.values.size()) = numbers.gradients;
      set_measure(study.watched[k], entry, extremes);
    }
  }

  /// The terms of the objective that are watched signals.
  void add_terms(Derivatives derivatives, Evaluation* evaluation) const {
    const bool with_gradient = derivatives != Derivatives::kNone;
    place_numbers(with_gradient, &evaluation->extremes);
    evaluation->objective += watched_terms(system_->study(), watched_, evaluation->extremes,
                                           with_gradient ? &evaluation->gradient : nullptr);
  }

  void collect(GradientEngine* engine, Derivatives derivatives, const std::atomic<bool>* cancel,
               Evaluation* evaluation) const {
    const double time = engine->time();
    evaluation->objective = engine->objective();
    evaluation->extremes = engine->extremes();
    place_numbers(derivatives != Derivatives::kNone, &evaluation->extremes);
    evaluation->objective +=
        watched_terms(system_->study(), watched_, evaluation->extremes, nullptr);
    if (!std::isfinite(evaluation->objective)) {
      evaluation->status = {StatusCode::kNonFinite, time, "the objective is not finite"};
      return;
    }
    if (derivatives == Derivatives::kNone) return;
    engine->gradient(&evaluation->gradient);
    if (derivatives == Derivatives::kGaussNewton) engine->jacobian_root(&evaluation->jacobian_root);
    watched_terms(system_->study(), watched_, evaluation->extremes, &evaluation->gradient);
    if (is_set(cancel)) {
      evaluation->status = {StatusCode::kCancelled, time, "cancelled"};
      return;
    }
    for (Eigen::Index k = 0; k < evaluation->gradient.size(); ++k)
      if (!is_possible(evaluation->gradient[k], k, *evaluation)) {
        evaluation->status = {StatusCode::kNonFiniteGradient, time,
                              "the gradient by \"" + tuned_parameter(system_->study(), k).name +
                                  "\" is " +
                                  (std::isfinite(evaluation->gradient[k])
                                       ? readable(evaluation->gradient[k], 2) +
                                             ", beyond any size that the objective explains"
                                       : "not finite, though the objective is")};
        return;
      }
    if (!evaluation->jacobian_root.allFinite())
      evaluation->status = {StatusCode::kNonFiniteGradient, time,
                            "the Jacobian of the residuals is not finite, though the objective is"};
  }

  /// Whether a derivative can be one: sensitivities that grow without bound end beyond all of them
  /// before they overflow.
  bool is_possible(double derivative, Eigen::Index k, const Evaluation& evaluation) const {
    constexpr double kLargest = 1e100;
    const MotionStudy& study = system_->study();
    const Parameter& parameter = tuned_parameter(study, k);
    const double change = std::abs(derivative) * extent(parameter, parameter.value);
    return std::isfinite(derivative) &&
           !(change > kLargest * std::max(1.0, std::abs(evaluation.objective)));
  }

  Status run(GradientEngine* engine, const std::vector<double>& parameters, Derivatives derivatives,
             const std::atomic<bool>* cancel) const {
    Status status = engine->start(parameters, derivatives);
    while (status.ok() && !engine->integrator().has_ended()) {
      if (is_set(cancel)) return {StatusCode::kCancelled, engine->time(), "cancelled"};
      status = engine->advance(engine->integrator().end());
    }
    return status;
  }

  std::shared_ptr<const CompiledSystem> system_;
  WatchLayout watched_;
  std::vector<double> parameters_;  // workspace: all named parameters of one design
  std::unique_ptr<RestNumbers> linear_;
  // Made by the first evaluation. That for kGaussNewton may be of another kind; no result depends
  // on which evaluations came before.
  std::unique_ptr<GradientEngine> engine_, root_engine_;
};

struct EvaluatorMaker {
  static Evaluator make(std::shared_ptr<const CompiledSystem> system) {
    return Evaluator(std::make_unique<Evaluator::Implementation>(std::move(system)));
  }
};

Evaluator evaluator_of(std::shared_ptr<const CompiledSystem> system) {
  return EvaluatorMaker::make(std::move(system));
}

Evaluator::Evaluator(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
Evaluator::Evaluator(const Problem& problem)
    : Evaluator(std::make_unique<Implementation>(system_of(problem))) {}
Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;
Evaluator& Evaluator::operator=(Evaluator&&) noexcept = default;

Evaluation Evaluator::evaluate(const Eigen::VectorXd& rho, Derivatives derivatives,
                               const std::atomic<bool>* cancel) {
  return implementation_->evaluate(rho, derivatives, cancel);
}

Evaluation Evaluator::evaluate(const Eigen::VectorXd& rho, bool with_gradient,
                               const std::atomic<bool>* cancel) {
  return evaluate(rho, gradient_if(with_gradient), cancel);
}

Evaluation Evaluator::evaluate_design(const std::vector<double>& parameters,
                                      Derivatives derivatives, const std::atomic<bool>* cancel) {
  return implementation_->evaluate(parameters, derivatives, cancel);
}

Evaluation Evaluator::evaluate_design(const std::vector<double>& parameters, bool with_gradient,
                                      const std::atomic<bool>* cancel) {
  return implementation_->evaluate(parameters, gradient_if(with_gradient), cancel);
}

}  // namespace codesign
