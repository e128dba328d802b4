// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/posture_sequence.h"

#include "text/number_text.h"

namespace codesign {

PostureSequence::PostureSequence(const CompiledSystem& system)
    : system_(system), equations_(system), assembly_(system) {
  state_.resize(system.layout());
}

Status PostureSequence::start(const std::vector<double>& parameters) {
  statistics_ = {};
  warnings_.clear();
  psi_ = 0.0;
  begin_methods("postures");
  if (Status status = begin_run(system_.study(), parameters); !status.ok()) return status;
  Status status = repeatable_start_.start(
      system_, parameters,
      [this](const std::vector<double>& design) {
        return assemble_start(system_, design, &assembly_, &equations_, &state_);
      },
      [this] { assembly_.rates().keep_pivots(); });
  return arrive(std::move(status));
}

Status PostureSequence::advance(double /*limit*/) {
  if (cancelled()) return {StatusCode::kCancelled, state_.t, "cancelled"};
  previous_ = state_;
  previous_psi_ = psi_;
  if (state_.t >= system_.study().duration) {
    state_.t += 1.0;
    return {};
  }
  return arrive(assembly_.solve_next(equations_.parameters(), &equations_, &state_));
}

/// Counts the posture that was found; a failure says which one was not.
Status PostureSequence::arrive(Status status) {
  append(assembly_.warnings(), &warnings_);
  if (!status.ok()) {
    if (status.code != StatusCode::kCancelled && status.code != StatusCode::kInvalidDesign)
      status.cause = "posture " + readable(state_.t) + ": " + status.cause;
    return status;
  }
  double g = 0.0;
  equations_.residual(state_, &residual_, &g);
  psi_ += g;
  ++statistics_.steps;
  return {};
}

Status PostureSequence::go_on(double time, const std::vector<double>& parameters) {
  Status status = start(parameters);
  while (status.ok() && state_.t < time) status = advance(time);
  return status;
}

void PostureSequence::interpolate(double time, State<double>* state, double* psi) {
  const bool is_before = time < state_.t && previous_.q.size() > 0;
  *state = is_before ? previous_ : state_;
  *psi = is_before ? previous_psi_ : psi_;
}

void PostureSequence::interpolate_rates(double /*time*/, State<double>* rates) {
  rates->q.setZero(state_.q.size());
  rates->v.setZero(state_.v.size());
  rates->s.setZero(state_.s.size());
}

}  // namespace codesign
