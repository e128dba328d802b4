// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/sensitivity_scale.h"

#include <algorithm>
#include <cmath>

#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "sensitivity/lane_directions.h"

namespace codesign {
namespace {

// Rounding of a sensitivity, relative to the motion and the parameter's value.
constexpr double kRoundingShare = 1e-8;
// A value counts as at least this share of the range.
constexpr double kSmallValue = 1e-3;
// A direction that over the range changes the motion, or psi, by less than this share is judged as
// one that changes it so much.
constexpr double kLeastShare = 1e-3;
// Errors that over the range are less than this share of solver.absolute_tolerance do not count:
// rounding, where sensitivities vanish.
constexpr double kAbsoluteShare = 1e-3;

// A contact is short if it turns velocities round in less than this share of the study.
constexpr double kShortShare = 0.1;

double square(double x) { return x * x; }

}  // namespace

template <int N>
void SensitivityScale<N>::start(const CompiledSystem& system,
                                const std::vector<Lanes<N>>& parameters) {
  const MotionStudy& study = system.study();
  for (Array* all : {&q_, &s_, &per_value_, &per_range_}) all->setZero();
  for (Size* all : {&v_, &psi_})
    for (Array* array : {&all->largest, &all->last, &all->integral}) array->setZero();
  time_ = 0.0;
  duration_ = study.duration;
  may_touch_ = system.has_switches();
  // Of lanes without a parameter.
  per_range_.setConstant(1e-200);
  q_square_ = v_square_ = s_square_ = 0.0;
  absolute_ = kAbsoluteShare * study.solver.absolute_tolerance;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double value = std::abs(value_of(parameters[i])),
                 extent = codesign::extent(study.parameters[i], value),
                 range = extent > 0.0 ? extent : 1.0;
    const Array squares = parameters[i].directions().array().square();
    per_range_ = per_range_.max(squares / square(range));
    per_value_ = per_value_.max(squares / square(std::max(value, kSmallValue * range)));
  }
}

template <int N>
bool SensitivityScale<N>::is_short_contact(const State<double>& state) const {
  const double v_square = std::max(v_square_, state.v.squaredNorm());
  return may_touch_ &&
         state.z.head(state.v.size()).squaredNorm() * square(kShortShare * duration_) > v_square;
}

template <int N>
typename SensitivityScale<N>::Array SensitivityScale<N>::counted(const Size& of, const Array& now,
                                                                 double t, bool is_short) const {
  if (!is_short || !(t > 0.0)) return now;
  const Array integral = of.integral + 0.5 * (t - time_) * (of.last + now.sqrt());
  return now.min((integral / t).square());
}

template <int N>
void SensitivityScale<N>::extend(const Array& now, double t, bool is_short, Size* of) const {
  of->largest = of->largest.max(counted(*of, now, t, is_short));
  const Array size = now.sqrt();
  of->integral += 0.5 * (t - time_) * (of->last + size);
  of->last = size;
}

template <int N>
void SensitivityScale<N>::measure(const IncrementLayout& at, const State<double>& state,
                                  const Directions<N>& y) {
  q_square_ = std::max(q_square_, state.q.squaredNorm());
  v_square_ = std::max(v_square_, state.v.squaredNorm());
  s_square_ = std::max(s_square_, state.s.squaredNorm());
  q_ = q_.max(squared_norms(y, at.x(), at.n));
  s_ = s_.max(squared_norms(y, at.s(), at.states));
  const bool is_short = is_short_contact(state);
  extend(squared_norms(y, at.v(), at.n), state.t, is_short, &v_);
  extend(y.col(at.psi()).array().square(), state.t, is_short, &psi_);
  time_ = state.t;
}

template <int N>
double SensitivityScale<N>::error(const IncrementLayout& at, const Attempt& attempt,
                                  double tolerance) const {
  const double motion = std::max({1.0, q_square_, v_square_});
  const Array floor = square(absolute_ / tolerance) * per_range_,
              rounding = floor.max(square(kRoundingShare) * motion * per_value_),
              share = square(kLeastShare) * per_range_;
  const auto judge = [](const Array& error, const Array& size, const Array& least) {
    return (error / size.max(least)).maxCoeff();
  };
  const Directions<N>&u = attempt.estimate, &y = attempt.end;
  const bool is_short = is_short_contact(attempt.state);
  const auto size_of = [&](const Size& of, const Array& now) {
    return Array(of.largest.max(counted(of, now, attempt.state.t, is_short)));
  };
  const double q = judge(squared_norms(u, at.x(), at.n), q_.max(squared_norms(y, at.x(), at.n)),
                         rounding.max(share * q_square_)),
               v = judge(squared_norms(u, at.v(), at.n),
                         size_of(v_, squared_norms(y, at.v(), at.n)),
                         rounding.max(share * v_square_)),
               // Bristles are micrometres beside joints that turn, and carry the whole friction.
      s = at.states == 0
              ? 0.0
              : judge(squared_norms(u, at.s(), at.states),
                      s_.max(squared_norms(y, at.s(), at.states)), floor.max(share * s_square_)),
               psi = judge(u.col(at.psi()).array().square(), size_of(psi_, attempt.psi.square()),
                           floor.max(share * square(attempt.objective)));
  // A derivative that is not finite at any step size is reported by the gradient.
  const double largest = std::max({q, v, s, psi});
  return std::isfinite(q + v + s + psi) ? std::sqrt(largest) / tolerance : 0.0;
}

double sensitivity_tolerance(const SolverOptions& options) {
  constexpr double kFactor = 10.0, kTightFactor = 100.0, kFiveDigits = 1e-5, kMost = 1e-3;
  if (options.sensitivity_tolerance > 0.0) return options.sensitivity_tolerance;
  const double relative = options.relative_tolerance;
  return std::min(kMost,
                  std::max(kFactor * relative, std::min(kFiveDigits, kTightFactor * relative)));
}

template class SensitivityScale<4>;
template class SensitivityScale<8>;

}  // namespace codesign
