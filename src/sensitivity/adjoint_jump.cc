// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/adjoint_jump.h"

#include "elements/sampled_control.h"
#include "math/arrays.h"

namespace codesign {

AdjointJump::AdjointJump(const CompiledSystem& system)
    : system_(system),
      at_(system.layout()),
      equations_(system),
      samples_(system, EquationPart::kStart),
      output_adjoint_(VectorX<double>::Zero(1)),
      no_integrand_(output_adjoint_) {
  point_.resize(system.layout());
}

void AdjointJump::start(const std::vector<double>& parameters) {
  equations_.set_design(parameters);
  samples_.set_design(parameters);
}

void AdjointJump::hold(const std::vector<bool>& mode) {
  mode.empty() ? equations_.release() : equations_.hold(mode);
}

void AdjointJump::add_guard(int guard, double weight, const State<double>& at,
                            const std::vector<bool>& mode, VectorX<double>* adjoint) {
  hold(mode);
  weights_.setZero(to_signed(mode.size()));
  no_weights_.setZero(weights_.size());
  weights_[guard] = weight;
  equations_.add_transposed(EquationFunction::kSwitches, at, {weights_, no_weights_, {}, {}},
                            *adjoint);
}

// z' = -G_z^-1 (G_q q' + G_v v' + G_s s' + G_rho), whatever z' was before.
bool AdjointJump::reverse_rates(const State<double>& behind, VectorX<double>* adjoint) {
  double g = 0.0;
  if (!matrix_) {
    matrix_ = std::make_unique<StageMatrix<double>>(system_);
    derivatives_.resize(system_.patterns());
  }
  equations_.rates(behind, &residual_, &g, &derivatives_);
  // With pivots of an earlier run the last bits would depend on it.
  matrix_->reset_pivots();
  if (!matrix_->factor(derivatives_, 0.0, 0.0, 0.0)) return false;
  auto z = adjoint->segment(at_.z(), at_.z_size);
  mu_ = -z;
  matrix_->lu().solve_transposed_rows<1>(mu_);
  equations_.add_transposed(EquationFunction::kResidual, behind, {mu_, no_integrand_, {}, {}},
                            *adjoint);
  z.setZero();
  return true;
}

// A sample replaces the memory and one output, an application copies an output.
void AdjointJump::reverse_event(const ControlEvent& event, VectorX<double>* adjoint) {
  const int place = output_state(system_, event);
  auto states = adjoint->segment(at_.s(), at_.states);
  if (event.kind == ControlEvent::Kind::kApply) {
    const int held = system_.controllers()[to_index(event.controller)].states.held;
    const double output = states[held];
    states[held] = 0.0;
    states[place] += output;
    return;
  }
  output_adjoint_[0] = states[place];
  states_adjoint_ = states;
  states_adjoint_[place] = 0.0;
  states.setZero();
  const auto which =
      event.sample == 0 ? ControllerFunction::kFirstSample : ControllerFunction::kSample;
  samples_.add_transposed(controller_function(event.controller, which), point_,
                          {output_adjoint_, states_adjoint_, {}, {}}, *adjoint);
}

void AdjointJump::reverse_events(const std::vector<ControlEvent>& events,
                                 const State<double>& before, VectorX<double>* adjoint) {
  if (states_.size() < events.size()) states_.resize(events.size());
  point_ = before;
  const auto sampled = [this](int controller, bool is_first) {
    return samples_.sample(controller, is_first, &point_);
  };
  for (std::size_t k = 0; k < events.size(); ++k) {
    states_[k] = point_.s;
    jump_controller(system_, events[k], sampled, &point_.s);
  }
  for (std::size_t k = events.size(); k-- > 0;) {
    point_.s = states_[k];
    reverse_event(events[k], adjoint);
  }
}

// Of S+ = S- + (f- - f+) tau' with tau' = -(s_x S- + s_rho) / (s_t + s_x f-).
bool AdjointJump::reverse(const RunJump& jump, const State<double>& before,
                          const State<double>& behind, const std::vector<bool>& mode,
                          double end_rate, VectorX<double>* adjoint) {
  hold(jump.mode);
  if (!reverse_rates(behind, adjoint)) return false;
  reverse_events(jump.events, before, adjoint);
  if (jump.guard < 0) return true;
  const double by_instant = jump.rates.head(at_.n).dot(adjoint->segment(at_.v(), at_.n)) +
                            jump.rates.tail(at_.states).dot(adjoint->segment(at_.s(), at_.states)) +
                            jump.integrand_jump * (*adjoint)[at_.psi()] + end_rate;
  add_guard(jump.guard, -by_instant / jump.guard_rate, before, mode, adjoint);
  return true;
}

void AdjointJump::add_gradient(Out<double> gradient) {
  equations_.add_gradient(gradient);
  samples_.add_gradient(gradient);
}

}  // namespace codesign
