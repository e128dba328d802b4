// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/waypoint_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "codegen/number_types.h"
#include "math/arrays.h"

namespace codesign {
namespace {

// Velocities that are not given, theory (C2): the slope of the parabola through a way-point and its
// neighbours; zero at both ends.
template <class T>
void choose_velocities(const std::vector<double>& times, std::vector<Knot<T>>* knots) {
  for (std::size_t k = 1; k + 1 < knots->size(); ++k) {
    const double before = times[k] - times[k - 1], after = times[k + 1] - times[k],
                 both = before + after;
    const T left = ((*knots)[k].position - (*knots)[k - 1].position) / T(before);
    const T right = ((*knots)[k + 1].position - (*knots)[k].position) / T(after);
    (*knots)[k].velocity = (T(after) * left + T(before) * right) / T(both);
  }
}

// Accelerations that are not given, theory (C2): the mean of the accelerations of the two cubic
// pieces that meet at a way-point; zero at both ends.
template <class T>
void choose_accelerations(const std::vector<double>& times, std::vector<Knot<T>>* knots) {
  for (std::size_t k = 1; k + 1 < knots->size(); ++k) {
    const Knot<T>&a = (*knots)[k - 1], &b = (*knots)[k], &c = (*knots)[k + 1];
    const T before(times[k] - times[k - 1]), after(times[k + 1] - times[k]);
    const T left =
        (T(2.0) * a.velocity + T(4.0) * b.velocity - T(6.0) * (b.position - a.position) / before) /
        before;
    const T right =
        (T(6.0) * (c.position - b.position) / after - T(4.0) * b.velocity - T(2.0) * c.velocity) /
        after;
    (*knots)[k].acceleration = T(0.5) * (left + right);
  }
}

/// x, or the end of the smallest interval with zero, a and b that is nearest to x.
template <class T>
T limited(const T& x, const T& a, const T& b) {
  const auto less = [](const T& y, const T& z) { return value_of(y) < value_of(z); };
  const auto [low, high] = std::minmax({T(0.0), a, b}, less);
  return less(x, low) ? low : less(high, x) ? high : x;
}

/// Calls limit(knot, duration h to a neighbour, negative for the earlier one, slope d of the chord)
/// for both neighbours of each inner way-point.
template <class T, class Limit>
void limit_by_neighbours(const std::vector<double>& times, std::vector<Knot<T>>* knots,
                         const Limit& limit) {
  for (std::size_t k = 1; k + 1 < knots->size(); ++k)
    for (const std::size_t other : {k - 1, k + 1}) {
      const T h(times[other] - times[k]);
      limit(&(*knots)[k], h, T(((*knots)[other].position - (*knots)[k].position) / h));
    }
}

// The limits of theory (C2), within which no polynomial leaves the values of its two way-points.
template <class T>
void limit_velocities(const std::vector<double>& times, std::vector<Knot<T>>* knots) {
  limit_by_neighbours(times, knots, [](Knot<T>* knot, const T&, const T& d) {
    knot->velocity = limited(knot->velocity, T(0.0), T(T(1.25) * d));
  });
}
template <class T>
void limit_accelerations(const std::vector<double>& times, std::vector<Knot<T>>* knots) {
  limit_by_neighbours(times, knots, [](Knot<T>* knot, const T& h, const T& d) {
    knot->acceleration = limited(knot->acceleration, T(T(-4.0) * knot->velocity / h),
                                 T((T(10.0) * d - T(8.0) * knot->velocity) / h));
  });
}

template <class T>
TimePolynomial<T> hold(double start, const T& value) {
  const T zero(0.0);
  return {start, {value, zero, zero, zero, zero, zero}};
}

}  // namespace

template <class T>
void WaypointReference<T>::set(const WaypointsDescription& waypoints,
                               const std::vector<T>& parameters) {
  const std::vector<double>& times = waypoints.times;
  std::vector<Knot<T>>& knots = knots_;
  knots.assign(times.size(), Knot<T>());
  const auto take = [&](const std::vector<Quantity>& quantities, T Knot<T>::*member) {
    for (std::size_t k = 0; k < quantities.size(); ++k)
      knots[k].*member = quantities[k].at(parameters);
  };
  take(waypoints.positions, &Knot<T>::position);
  const bool is_monotone = waypoints.interpolation == Interpolation::kMonotone;
  if (waypoints.velocities.empty()) choose_velocities(times, &knots);
  if (waypoints.velocities.empty() && is_monotone) limit_velocities(times, &knots);
  take(waypoints.velocities, &Knot<T>::velocity);
  if (waypoints.accelerations.empty()) choose_accelerations(times, &knots);
  if (waypoints.accelerations.empty() && is_monotone) limit_accelerations(times, &knots);
  take(waypoints.accelerations, &Knot<T>::acceleration);
  pieces_.clear();
  pieces_.push_back(hold(-std::numeric_limits<double>::infinity(), knots.front().position));
  for (std::size_t k = 0; k + 1 < knots.size(); ++k)
    pieces_.push_back({times[k], waypoint_polynomial(waypoints.interpolation, knots[k],
                                                     knots[k + 1], times[k + 1] - times[k])});
  pieces_.push_back(hold(times.back(), knots.back().position));
}

template <class T>
std::size_t WaypointReference<T>::piece_at(double t) const {
  const auto next = std::upper_bound(
      pieces_.begin(), pieces_.end(), t,
      [](double time, const TimePolynomial<T>& piece) { return time < piece.start; });
  return to_index(next - pieces_.begin()) - 1;
}

template <class T>
ReferenceMotion<T> WaypointReference<T>::at(double t) const {
  const TimePolynomial<T>& piece = pieces_[piece_at(t)];
  if (std::isfinite(piece.start)) return piece.at(t);
  ReferenceMotion<T> motion;
  motion.value = piece.c[0];
  return motion;
}

// The first piece is a constant without a start; it counts from the first way-point backward.
template <class T>
void WaypointReference<T>::prepare_integral(double) {
  areas_.assign(pieces_.size(), T(0.0));
  for (std::size_t k = 2; k < pieces_.size(); ++k)
    areas_[k] = areas_[k - 1] + pieces_[k - 1].area(pieces_[k].start - pieces_[k - 1].start);
  const T before = area_to(0.0);
  for (T& sum : areas_) sum -= before;
}

template <class T>
T WaypointReference<T>::area_to(double t) const {
  const std::size_t k = piece_at(t);
  if (k == 0) return areas_[0] + pieces_[0].c[0] * (t - pieces_[1].start);
  return areas_[k] + pieces_[k].area(t - pieces_[k].start);
}

template <class T>
ReferenceMotion<T> WaypointReference<T>::integral_at(double t) const {
  const ReferenceMotion<T> rate = at(t);
  return {area_to(t), rate.value, rate.rate, rate.acceleration};
}

#define CODESIGN_INSTANTIATE(T) template class WaypointReference<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
