// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/end_motion.h"

#include "equations/compiled_system.h"
#include "integration/watch_layout.h"
#include "math/arrays.h"
#include "sensitivity/motion_rates.h"

namespace codesign {

Status EndMotion::evaluate(Integrator* integrator, const Eigen::VectorXd& time) {
  state_ = integrator->state();
  if (Status status = solve_motion(integrator, &state_, &rates_); !status.ok()) return status;
  Equations<double>& equations = integrator->equations();
  equations.residual(state_, &residual_, &objective_rate_);
  if (!system_->terminal().empty()) {
    equations.terminal_gradient(state_, &gradient_);
    objective_rate_ += rate_along(gradient_, rates_, system_->layout());
  }
  time_ = time;
  guard_ = -1;
  return {};
}

double EndMotion::watched_rate(std::size_t k, Equations<double>* equations) {
  equations->watched_gradient(k, state_, &gradient_);
  return rate_along(gradient_, rates_, system_->layout());
}

std::complex<double> complex_guard_time(int guard, double rate,
                                        OneStep<std::complex<double>>* step) {
  VectorX<std::complex<double>> guards, right;
  step->equations().compiled().switches(step->state(), &guards, &right);
  return {0.0, -guards[guard].imag() / rate};
}

std::complex<double> EndMotion::complex_time(const std::vector<std::complex<double>>& parameters,
                                             OneStep<std::complex<double>>* step) const {
  if (!moves()) return 0.0;
  if (guard_ >= 0) return complex_guard_time(guard_, guard_rate_, step);
  const Expression* const duration = system_->study().duration_of_design.get();
  return {0.0, duration ? duration->value(parameters).imag() : 0.0};
}

void EndMotion::add_change(const std::complex<double>& time, const Eigen::VectorXd& times,
                           Equations<double>* equations, std::complex<double>* objective,
                           VectorX<std::complex<double>>* watched) {
  if (!moves()) return;
  *objective += time * objective_rate_;
  const WatchLayout layout(system_->study());
  for (std::size_t k = 0; k < system_->watched().size(); ++k) {
    const WatchLayout::Entry& entry = layout.entries()[k];
    const std::complex<double> change = time * watched_rate(k, equations);
    for (int place = entry.first; place < entry.measure(); ++place)
      if (times[place] >= state_.t) (*watched)[place] += change;
  }
}

Eigen::VectorXd duration_gradient(const MotionStudy& study, const std::vector<double>& parameters) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(to_signed(study.tuned.size()));
  if (study.duration_of_design)
    for (std::size_t k = 0; k < study.tuned.size(); ++k)
      gradient[to_signed(k)] = study.duration_of_design->derivative(study.tuned[k], parameters);
  return gradient;
}

}  // namespace codesign
