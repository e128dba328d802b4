// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/end_motion.h"

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {

Status EndMotion::evaluate(Integrator* integrator, const Eigen::VectorXd& time) {
  Equations<double>& equations = integrator->equations();
  const Layout& layout = system_.layout();
  state_ = integrator->state();
  if (Status status = integrator->assembly().solve_rates(&equations, &state_); !status.ok())
    return status;
  rates_.resize(layout);
  rates_.q = state_.v;
  rates_.v = state_.z.head(layout.n);
  rates_.s = state_.z.tail(layout.states);
  integrator->assembly().differentiate_rates(state_, &equations, &rates_);
  equations.residual(state_, &residual_, &objective_rate_);
  if (!system_.terminal().empty()) {
    equations.terminal_gradient(state_, &gradient_);
    objective_rate_ += rate_of(gradient_);
  }
  time_ = time;
  return {};
}

double EndMotion::watched_rate(std::size_t k, Equations<double>* equations) {
  equations->watched_gradient(k, state_, &gradient_);
  return rate_of(gradient_);
}

double EndMotion::rate_of(const SparseGradient<double>& gradient) const {
  const int n = system_.layout().n;
  double rate = gradient.time;
  for (const auto& e : gradient.position)
    rate += e.value * (e.column < n ? rates_.q[e.column] : rates_.s[e.column - n]);
  for (const auto& e : gradient.velocity) rate += e.value * rates_.v[e.column];
  for (const auto& e : gradient.rate) rate += e.value * rates_.z[e.column];
  return rate;
}

Eigen::VectorXd duration_gradient(const MotionStudy& study, const std::vector<double>& parameters) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(to_signed(study.tuned.size()));
  if (study.duration_of_design)
    for (std::size_t k = 0; k < study.tuned.size(); ++k)
      gradient[to_signed(k)] = study.duration_of_design->derivative(study.tuned[k], parameters);
  return gradient;
}

}  // namespace codesign
