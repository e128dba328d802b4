// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/effort_tangent.h"

#include "description/study.h"
#include "math/arrays.h"

#include <algorithm>
#include <utility>

namespace codesign {

template <int N>
EffortTangent<N>::EffortTangent(const CompiledSystem& system, LaneRange<N> lanes,
                                std::vector<int> shifted)
    : system_(system),
      layout_(system.layout()),
      at_(layout_),
      lanes_(lanes),
      seeded_{lanes.first,
              std::clamp(static_cast<int>(system.whole_study().tuned.size()) - lanes.first, 0,
                         lanes.count)},
      shifted_(std::move(shifted)),
      equations_(system),
      y_(at_.size()),
      G_(layout_.columns() + 1),
      Phi_(layout_.m),
      Phi_rate_(layout_.m),
      solution_(layout_.columns()) {}

template <int N>
void EffortTangent<N>::constraint_errors(const State<double>& state) {
  equations_.constraint_errors(state, y_, &Phi_, &Phi_rate_);
  const int parameters = static_cast<int>(system_.whole_study().tuned.size());
  for (int lane = seeded_.count; lane < lanes_.count; ++lane)
    Phi_(lane, system_.drive_row(shifted_[to_index(lanes_.first + lane - parameters)])) -= 1.0;
}

template <int N>
void EffortTangent<N>::correct(const DrivenMotion& motion, const Directions<N>& errors, int first) {
  solution_.setZero();
  solution_.middleCols(layout_.n, layout_.m) = -errors;
  motion.lu().template solve_rows<N>(solution_.part(0, layout_.columns()));
  y_.middleCols(first, layout_.n) += solution_.leftCols(layout_.n);
}

template <int N>
void EffortTangent<N>::differentiate(const DrivenMotion& motion, const State<double>& state,
                                     Eigen::Index first_row, RowJacobian* jacobian) {
  y_.setZero();
  constraint_errors(state);
  // Positions and velocities do not depend on parameters that do not change the geometry.
  if (!Phi_.isZero(0.0) || !Phi_rate_.isZero(0.0)) {
    // The compliance does not change the converged solution, but it reduces one correction by its
    // share; a second correction removes this error.
    const int rounds = system_.compliance() == 0.0 ? 1 : 2;
    for (int round = 0; round < rounds; ++round) {
      correct(motion, Phi_, at_.x());
      constraint_errors(state);
    }
    for (int round = 0; round < rounds; ++round) {
      if (round > 0) constraint_errors(state);
      correct(motion, Phi_rate_, at_.v());
    }
  }
  equations_.residual(state, y_, &G_);
  solution_.leftCols(layout_.columns()) = G_.leftCols(layout_.columns());
  motion.lu().template solve_rows<N>(solution_.part(0, layout_.columns()));
  // The effort is minus the multiplier, whose derivative is minus the solution.
  for (int k = 0; k < motion.drives(); ++k) {
    const int column = layout_.lambda_column(system_.drive_row(k));
    for (int lane = 0; lane < lanes_.count; ++lane)
      (*jacobian)(first_row + k, lanes_.first + lane) = solution_(lane, column);
  }
  if (!system_.watched().empty())
    differentiate_signals(state, first_row + motion.drives(), jacobian);
}

template <int N>
void EffortTangent<N>::differentiate_signals(const State<double>& state, Eigen::Index first_row,
                                             RowJacobian* jacobian) {
  y_.middleCols(at_.z(), layout_.columns()) = -solution_.leftCols(layout_.columns());
  const State<Lanes<N>>& point = equations_.lanes(state, y_);
  for (std::size_t k = 0; k < system_.watched().size(); ++k) {
    const Lanes<N> signal = equations_.equations().watched(k, point);
    for (int lane = 0; lane < lanes_.count; ++lane)
      (*jacobian)(first_row + to_signed(k), lanes_.first + lane) = signal.directions()(lane);
  }
}

template class EffortTangent<4>;
template class EffortTangent<8>;

}  // namespace codesign
