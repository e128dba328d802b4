// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/sensitivity/evaluation.h"

#include <optional>

#include "mechanism_codesign/dynamics/system.h"
#include "mechanism_codesign/integration/rosenbrock_integrator.h"
#include "mechanism_codesign/math/cpu_timer.h"
#include "mechanism_codesign/sensitivity/tangent_step.h"

namespace codesign {
namespace {

/// Tangents of up to N tuned parameters, starting with the `first`.
template <int N>
class TangentGroup {
 public:
  TangentGroup(const System& system, const RosenbrockTableau& tableau, int first) : system_(system), first_(first), step_(system, tableau) {}

  void start(const std::vector<double>& parameters, RosenbrockIntegrator* integrator) {
    std::vector<Lanes<N>> lanes(parameters.begin(), parameters.end());
    for (int k = 0; k < count(); ++k) {
      auto& lane = lanes[static_cast<std::size_t>(system_.study().tuned[static_cast<std::size_t>(first_ + k)])];
      lane.v[k] = 1.0;
    }
    step_.start(lanes, integrator->assembly(), integrator->initial_state(), integrator->step());
  }
  void advance_stages(const RosenbrockStep<double>& step) { step_.advance_stages(step); }
  void advance_projection(const RosenbrockStep<double>& step) { step_.advance_projection(step); }
  void collect(const State<double>& end, Eigen::VectorXd* gradient) {
    const Eigen::Matrix<double, N, 1> total = step_.psi() + step_.terminal(end);
    gradient->segment(first_, count()) = total.head(count());
  }

 private:
  int count() const { return std::min(N, static_cast<int>(system_.study().tuned.size()) - first_); }

  const System& system_;
  int first_;
  TangentStep<N> step_;
};

}  // namespace

class Evaluator::Implementation {
 public:
  explicit Implementation(std::shared_ptr<const System> system) : system_(std::move(system)), integrator_(*system_) {}

  Evaluation evaluate(const Eigen::VectorXd& rho, bool with_gradient, const std::atomic<bool>* cancel) {
    const CpuTimer timer;
    Evaluation evaluation;
    if (with_gradient) allocate_tangents();
    evaluation.status = run(full_parameters(rho), with_gradient, cancel);
    if (evaluation.status.ok()) {
      RosenbrockStep<double>& step = integrator_.step();
      evaluation.objective = step.psi() + step.equations().terminal(step.state(), nullptr);
      if (!std::isfinite(evaluation.objective)) evaluation.status = {StatusCode::kNonFinite, step.state().t, "the objective is not finite"};
      if (with_gradient) {
        evaluation.gradient.setZero(rho.size());
        for_each_group([&](auto* group) { group->collect(step.state(), &evaluation.gradient); });
      }
    }
    evaluation.statistics = integrator_.statistics();
    evaluation.statistics.cpu_seconds = timer.seconds();
    return evaluation;
  }

 private:
  std::vector<double> full_parameters(const Eigen::VectorXd& rho) const {
    std::vector<double> parameters = system_->parameters();
    for (Eigen::Index k = 0; k < rho.size(); ++k) parameters[static_cast<std::size_t>(system_->study().tuned[static_cast<std::size_t>(k)])] = rho[k];
    return parameters;
  }

  // Eight at a time; a last group of four or fewer takes the narrower kind.
  void allocate_tangents() {
    if (!wide_.empty() || !narrow_.empty()) return;
    const int count = static_cast<int>(system_->study().tuned.size());
    const RosenbrockTableau& tableau = integrator_.step().tableau();
    for (int first = 0; first < count;) {
      if (count - first > 4) {
        wide_.push_back(std::make_unique<TangentGroup<8>>(*system_, tableau, first));
        first += 8;
      } else {
        narrow_.push_back(std::make_unique<TangentGroup<4>>(*system_, tableau, first));
        first += 4;
      }
    }
  }

  template <class Action>
  void for_each_group(const Action& action) {
    for (auto& group : wide_) action(group.get());
    for (auto& group : narrow_) action(group.get());
  }

  Status run(const std::vector<double>& parameters, bool with_gradient, const std::atomic<bool>* cancel) {
    Status status = integrator_.start(parameters);
    if (!status.ok()) return status;
    if (with_gradient) for_each_group([&](auto* group) { group->start(parameters, &integrator_); });
    const double duration = system_->study().duration;
    RosenbrockIntegrator::BeforeAccept stages;
    if (with_gradient) stages = [this](const RosenbrockStep<double>& step) { for_each_group([&step](auto* group) { group->advance_stages(step); }); };
    while (integrator_.step().state().t < duration) {
      if (cancel && *cancel) return {StatusCode::kCancelled, integrator_.step().state().t, "cancelled"};
      status = integrator_.advance(duration, stages);
      if (!status.ok()) return status;
      if (with_gradient) for_each_group([this](auto* group) { group->advance_projection(integrator_.step()); });
    }
    return status;
  }

  std::shared_ptr<const System> system_;
  RosenbrockIntegrator integrator_;
  std::vector<std::unique_ptr<TangentGroup<8>>> wide_;
  std::vector<std::unique_ptr<TangentGroup<4>>> narrow_;
};

Evaluator::Evaluator(std::shared_ptr<const System> system) : implementation_(std::make_unique<Implementation>(std::move(system))) {}
Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;
Evaluator& Evaluator::operator=(Evaluator&&) noexcept = default;

Evaluation Evaluator::evaluate(const Eigen::VectorXd& rho, bool with_gradient, const std::atomic<bool>* cancel) {
  return implementation_->evaluate(rho, with_gradient, cancel);
}

}  // namespace codesign
