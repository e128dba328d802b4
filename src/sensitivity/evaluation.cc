// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/gradient.h"

#include <cmath>

#include "equations/compiled_system.h"
#include "math/cpu_timer.h"
#include "sensitivity/gradient_engine.h"
#include "sensitivity/peaks.h"
#include "text/cancel.h"

namespace codesign {

namespace {

const std::string& tuned_name(const CompiledSystem& system, Eigen::Index k) {
  const Study& study = system.study();
  return study.parameters[static_cast<std::size_t>(study.tuned[static_cast<std::size_t>(k)])].name;
}

}  // namespace

class Evaluator::Implementation {
 public:
  explicit Implementation(std::shared_ptr<const CompiledSystem> system) : system_(std::move(system)) {}

  Evaluation evaluate(const std::vector<double>& parameters, bool with_gradient, const std::atomic<bool>* cancel) {
    Evaluation evaluation;
    if (!engine_) engine_ = make_gradient_engine(*system_, cancel);
    if (!engine_) {
      evaluation.status = {StatusCode::kCancelled, 0.0, "cancelled"};
      return evaluation;
    }
    const CpuTimer timer;
    engine_->obey(cancel);
    evaluation.status = run(parameters, with_gradient, cancel);
    if (evaluation.status.ok()) collect(with_gradient, cancel, &evaluation);
    evaluation.statistics = engine_->statistics();
    evaluation.warnings = engine_->warnings();
    evaluation.statistics.cpu_seconds = timer.seconds();
    return evaluation;
  }
  const CompiledSystem& system() const { return *system_; }

 private:
  void collect(bool with_gradient, const std::atomic<bool>* cancel, Evaluation* evaluation) {
    const double time = engine_->time();
    evaluation->objective = engine_->objective();
    evaluation->extremes = engine_->extremes();
    evaluation->objective += peak_terms(system_->study(), evaluation->extremes, nullptr);
    if (!std::isfinite(evaluation->objective)) {
      evaluation->status = {StatusCode::kNonFinite, time, "the objective is not finite"};
      return;
    }
    if (!with_gradient) return;
    engine_->gradient(&evaluation->gradient);
    peak_terms(system_->study(), evaluation->extremes, &evaluation->gradient);
    if (is_set(cancel)) {
      evaluation->status = {StatusCode::kCancelled, time, "cancelled"};
      return;
    }
    for (Eigen::Index k = 0; k < evaluation->gradient.size(); ++k)
      if (!std::isfinite(evaluation->gradient[k])) {
        evaluation->status = {StatusCode::kNonFiniteGradient, time,
                              "the gradient by \"" + tuned_name(*system_, k) + "\" is not finite, though the objective is"};
        return;
      }
  }

  Status run(const std::vector<double>& parameters, bool with_gradient, const std::atomic<bool>* cancel) {
    Status status = engine_->start(parameters, with_gradient);
    const double duration = system_->study().duration;
    while (status.ok() && engine_->time() < duration) {
      if (is_set(cancel)) return {StatusCode::kCancelled, engine_->time(), "cancelled"};
      status = engine_->advance(duration);
    }
    return status;
  }

  std::shared_ptr<const CompiledSystem> system_;
  std::unique_ptr<GradientEngine> engine_;  // made by the first evaluation, which can be cancelled meanwhile
};

Evaluator::Evaluator(std::shared_ptr<const CompiledSystem> system) : implementation_(std::make_unique<Implementation>(std::move(system))) {}
Evaluator::Evaluator(const Problem& problem) : Evaluator(problem.system()) {}
Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;
Evaluator& Evaluator::operator=(Evaluator&&) noexcept = default;

Evaluation Evaluator::evaluate(const Eigen::VectorXd& rho, bool with_gradient, const std::atomic<bool>* cancel) {
  return implementation_->evaluate(implementation_->system().parameters(rho), with_gradient, cancel);
}

Evaluation Evaluator::evaluate_design(const std::vector<double>& parameters, bool with_gradient, const std::atomic<bool>* cancel) {
  return implementation_->evaluate(parameters, with_gradient, cancel);
}

}  // namespace codesign
