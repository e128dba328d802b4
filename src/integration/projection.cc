// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/projection.h"

#include <cmath>

namespace codesign {
namespace {

constexpr int kRounds = 2;

}  // namespace

Projection::Projection(const CompiledSystem& system) : layout_(system.layout()), matrix_(system) { derivatives_.resize(system.patterns()); }

void Projection::correct(const VectorX<double>& error, VectorX<double>* target) {
  correction_.setZero(layout_.columns());
  correction_.segment(layout_.n, layout_.m) = -error;
  matrix_.lu().solve(correction_);
  *target += correction_.head(layout_.n);
}

bool Projection::apply(Equations<double>* equations, State<double>* state) {
  if (layout_.m == 0) return std::isfinite(state->q.sum() + state->v.sum());
  matrix_.forget();
  for (int round = 0; round < kRounds; ++round) {
    equations->linearize_rates(*state, &derivatives_);
    if (!matrix_.factor(derivatives_, 0.0, 0.0, 0.0)) return false;
    equations->constraint_errors(*state, &Phi_, &Phi_rate_);
    correct(Phi_, &state->q);
    equations->constraint_errors(*state, &Phi_, &Phi_rate_);
    correct(Phi_rate_, &state->v);
  }
  return std::isfinite(state->q.sum() + state->v.sum());
}

}  // namespace codesign
