// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/stability_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/arrays.h"

namespace codesign {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
// Dormand and Prince are stable up to 3.3 on the negative real axis, but only up to 1.0 on the
// imaginary one, and in the half of the disk between them.
constexpr double kStable = 1.0;
// Steps within the bound, whose estimate varies a little, and which may be stretched by a tenth.
constexpr double kWithin = 0.9;
// Estimates that differ by less are taken as converged; of later ones those that differ by less
// than the second share, since complex eigenvalues let them vary. At most how many are made in a
// row.
constexpr double kSettled = 0.1, kSame = 1.0;
constexpr int kMostLooks = 6;
// Attempts at rest between two estimates, near the bound and far below it.
constexpr int kWaits = 8, kLongWaits = 64;
constexpr double kFarBelow = 0.1;

}  // namespace

StabilityBound::StabilityBound(const CompiledSystem& system)
    : at_(system.layout()), options_(system.study().solver), direction_(at_.z()) {
  beside_.resize(system.layout());
}

void StabilityBound::start() {
  radius_ = last_ = 0.0;
  largest_ = kNoBound;
  limits_ = has_settled_ = false;
  looks_ = waits_ = 0;
  begin_direction();
}

void StabilityBound::begin_direction() {
  // Without any pattern, so that it has a part along every eigenvector.
  for (Eigen::Index k = 0; k < direction_.size(); ++k)
    direction_[k] = std::sin(1.0 + 7.0 * static_cast<double>(k));
}

/// Whether both differences of (15c), between the last two stages, are below the tolerances. A
/// mechanism that turns evenly rests in this sense.
bool StabilityBound::rests(const OneStep<double>& step) const {
  const std::size_t last = to_index(step.tableau().stages) - 1;
  const State<double>&at = step.stages()[last], &from = step.stages()[last - 1];
  const VectorX<double>&u = step.increments()[last], &before = step.increments()[last - 1];
  const auto small = [&](const VectorX<double>& y, const VectorX<double>& other, int first) {
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      const double tolerance =
          options_.absolute_tolerance + options_.relative_tolerance * std::abs(y[k]);
      if (std::abs(y[k] - other[k]) > tolerance ||
          std::abs(u[first + k] - before[first + k]) > tolerance)
        return false;
    }
    return true;
  };
  // A loop that moves changes its equations with its posture, also where it turns evenly.
  if (at_.z_size - at_.n - at_.states > 0 &&
      at.v.lpNorm<Eigen::Infinity>() > options_.absolute_tolerance)
    return false;
  return small(at.v, from.v, at_.v()) && small(at.q, from.q, at_.x()) &&
         small(at.s, from.s, at_.s());
}

bool StabilityBound::is_due(double h) {
  if (!has_settled_ || --waits_ <= 0) return true;
  // A step that outgrows what the last estimate was for.
  return waits_ > kWaits && h * radius_ > kFarBelow * kStable;
}

/// The length of the direction with positions in units of the rate `per_time` [1/s], so that an
/// oscillation at this rate has the same length at all times.
double StabilityBound::length(double per_time) const {
  const double position = direction_.segment(at_.x(), at_.n).norm() * per_time;
  return std::hypot(position, direction_.tail(direction_.size() - at_.n).norm());
}

/// direction = f_y direction. False if that cannot be computed.
bool StabilityBound::multiply(OneStep<double>* step) {
  const State<double>& at = step->unprojected();
  VectorX<double>& w = direction_;
  // Far above rounding, and within the regularized zones of friction and stops.
  const double e =
      1e-7 * (1.0 + std::max(at.q.lpNorm<Eigen::Infinity>(), at.v.lpNorm<Eigen::Infinity>())) /
      w.norm();
  beside_ = at;
  beside_.q += e * w.segment(at_.x(), at_.n);
  beside_.s += e * w.segment(at_.s(), at_.states);
  beside_.v += e * w.segment(at_.v(), at_.n);
  if (!step->explicit_stages().solve_at(&beside_)) return false;
  w.segment(at_.x(), at_.n) = w.segment(at_.v(), at_.n);
  w.segment(at_.v(), at_.n) = (beside_.z.head(at_.n) - at.z.head(at_.n)) / e;
  w.segment(at_.s(), at_.states) = (beside_.z.tail(at_.states) - at.z.tail(at_.states)) / e;
  return w.allFinite() && w.norm() > 0.0;
}

// Two products, which undamped oscillations need. With complex eigenvalues the estimates go to and
// fro, so that the larger of two counts.
void StabilityBound::estimate(OneStep<double>* step) {
  const double h = step->step_size(), per_time = last_ > 0.0 ? last_ : 1.0 / h;
  direction_ /= length(per_time);
  const bool found = multiply(step) && multiply(step);
  const double now = found ? std::sqrt(length(per_time)) : 0.0;
  radius_ = looks_ == 0 && !has_settled_ ? now : std::max(now, last_);
  const double share = has_settled_ ? kSame : kSettled;
  has_settled_ = ++looks_ >= kMostLooks || std::abs(now - last_) <= share * std::min(now, last_);
  last_ = now;
  if (!found) begin_direction();
  if (!has_settled_) return;
  looks_ = 0;
  waits_ = h * radius_ > kFarBelow * kStable ? kWaits : kLongWaits;
}

bool StabilityBound::allows(OneStep<double>* step) {
  largest_ = kNoBound;
  if (!step->tableau().is_explicit() || !rests(*step)) return true;
  const double h = step->step_size();
  if (is_due(h)) estimate(step);
  if (radius_ > 0.0) largest_ = kStable / radius_;
  return h <= largest_;
}

double StabilityBound::shorten(double proposal) {
  const double most = kWithin * largest_;
  limits_ = proposal > most;
  return limits_ ? most : proposal;
}

}  // namespace codesign
