// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The part of Assembly that starts from a position of a run, not from the study's start.
#include "assembly/assembly.h"

namespace codesign {

Status Assembly::close_from(const TreeCoordinates& from, const std::vector<double>& parameters, Equations<double>* equations) {
  warnings_.clear();
  contradicting_.clear();
  matrix_.forget();
  theta_ = from.theta;
  theta_rate_ = from.rate;
  follow_couplings(equations->constants());
  const Status status = solve_positions(parameters, equations);
  return status.ok() ? solve_velocities(parameters, equations) : status;
}

// A start may give more positions than the mechanism has freedoms, if they happen to fit. They fit no other dimensions, so that a second
// attempt holds none.
Status Assembly::solve_from(const TreeCoordinates& from, const std::vector<double>& parameters, Equations<double>* equations,
                            State<double>* state) {
  const VectorX<double> theta = theta_, rate = theta_rate_;
  const std::vector<bool> positions = position_given_, guesses = guess_given_, velocities = velocity_given_;
  const std::vector<bool> none(positions.size(), false);
  guess_given_ = velocity_given_ = none;
  Status status = close_from(from, parameters, equations);
  if (!status.ok() && positions != none) {
    position_given_ = none;
    status = close_from(from, parameters, equations);
  }
  position_given_ = positions;
  guess_given_ = guesses;
  velocity_given_ = velocities;
  if (!status.ok()) {
    theta_ = theta;
    theta_rate_ = rate;
    status.time = state->t;
    return status;
  }
  const std::vector<double> turns = state->turns;
  place(parameters, equations, state);
  for (std::size_t p = 0; p < system_.topology().pairs.size(); ++p) {
    if (!system_.topology().pairs[p].is_loop) continue;
    for (std::size_t e = 0; e < system_.topology().pairs[p].chain.size(); ++e) {
      const auto slot = static_cast<std::size_t>(system_.layout().turn(static_cast<int>(p), static_cast<int>(e)));
      state->turns[slot] = turns[slot];
    }
  }
  return {};
}

}  // namespace codesign
