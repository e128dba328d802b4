// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/rosenbrock_gradient.h"

#include <algorithm>

namespace codesign {

RosenbrockGradient::RosenbrockGradient(const System& system) : system_(system), integrator_(system) {
  const double tolerance = system.study().solver.sensitivity_tolerance;
  stages_ = [this, tolerance](const RosenbrockStep<double>& step) {
    double error = 0.0;
    groups_->for_each([&](auto* group) {
      group->step.attempt(step);
      if (tolerance > 0.0) error = std::max(error, group->step.error(tolerance));
    });
    return error;
  };
}

// Memory for tangents is only taken by who asks for a gradient.
Status RosenbrockGradient::start(const std::vector<double>& parameters, bool with_gradient) {
  with_gradient_ = with_gradient;
  integrator_.watch_singularities(with_gradient);
  Status status = integrator_.start(parameters);
  if (!status.ok() || !with_gradient) return status;
  if (!groups_) groups_.emplace(system_, integrator_.step().tableau());
  groups_->for_each([&](auto* group) {
    group->step.start(group->range.seed(system_, parameters), integrator_.assembly(), integrator_.initial_state(), integrator_.step());
  });
  return status;
}

Status RosenbrockGradient::advance(double limit) {
  if (!with_gradient_) return integrator_.advance(limit);
  Status status = integrator_.advance(limit, stages_);
  if (status.ok()) groups_->for_each([this](auto* group) { group->step.accept(integrator_.step()); });
  return status;
}

double RosenbrockGradient::objective() { return integrator_.psi() + integrator_.equations().terminal(integrator_.state(), nullptr); }

void RosenbrockGradient::gradient(Eigen::VectorXd* gradient) {
  gradient->setZero(static_cast<Eigen::Index>(system_.study().tuned.size()));
  groups_->for_each([&](auto* group) {
    const auto total = (group->step.psi() + group->step.terminal(integrator_.state())).eval();
    gradient->segment(group->range.first, group->range.count) = total.head(group->range.count);
  });
}

}  // namespace codesign
