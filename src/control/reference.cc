// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "codegen/number_types.h"
#include "description/formula.h"
#include "math/arrays.h"
#include "math/taylor_quadrature.h"

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

}  // namespace

template <class T>
void Reference<T>::set(const ReferenceDescription& description, const std::vector<T>& parameters) {
  kind_ = description.kind;
  switch (kind_) {
    case ReferenceDescription::Kind::kConstant:
      offset_ = description.constant.at(parameters);
      break;
    case ReferenceDescription::Kind::kSine: {
      const SineDescription& sine = description.sine;
      const T frequency = sine.frequency.at(parameters);
      offset_ = sine.offset.at(parameters);
      amplitude_ = sine.amplitude.at(parameters);
      phase_ = sine.phase.at(parameters);
      angular_frequency_ = sine.is_period ? T(2.0 * M_PI) / frequency : T(2.0 * M_PI) * frequency;
      break;
    }
    case ReferenceDescription::Kind::kWaypoints:
      set_waypoints(description.waypoints, parameters);
      break;
    case ReferenceDescription::Kind::kSampled:
      samples_ = description.sampled.samples;
      amplitude_ = description.sampled.scale.at(parameters);
      phase_ = description.sampled.delay.at(parameters);
      offset_ = description.sampled.offset.at(parameters);
      break;
    case ReferenceDescription::Kind::kLive:
      live_ = description.live.function;
      planned_ = std::make_shared<const Reference<T>>(*description.live.planned, parameters);
      break;
    case ReferenceDescription::Kind::kIntegral:
      rate_.resize(1);
      rate_[0].set(*description.integral.rate, parameters);
      rate_[0].sum_areas(description.integral.duration);
      offset_ = description.integral.start.at(parameters);
      break;
    case ReferenceDescription::Kind::kExpression:
      expression_ = &description.expression;
      used_.clear();
      for (const int used : expression_->formula->dependencies())
        used_.push_back(used == expression_->time ? T(0.0) : parameters.at(to_index(used)));
      break;
  }
}

template <class T>
typename Reference<T>::Piece Reference<T>::hold(double start, const T& value) {
  const T zero(0.0);
  return {start, {value, zero, zero, zero, zero, zero}};
}

template <class T>
void Reference<T>::set_waypoints(const WaypointsDescription& description,
                                 const std::vector<T>& parameters) {
  const std::vector<double>& times = description.times;
  std::vector<Knot<T>>& knots = knots_;
  knots.assign(times.size(), Knot<T>());
  const auto take = [&](const std::vector<Quantity>& quantities, T Knot<T>::*member) {
    for (std::size_t k = 0; k < quantities.size(); ++k)
      knots[k].*member = quantities[k].at(parameters);
  };
  take(description.positions, &Knot<T>::position);
  const bool is_monotone = description.interpolation == Interpolation::kMonotone;
  if (description.velocities.empty()) choose_velocities(times, &knots);
  if (description.velocities.empty() && is_monotone) limit_velocities(times, &knots);
  take(description.velocities, &Knot<T>::velocity);
  if (description.accelerations.empty()) choose_accelerations(times, &knots);
  if (description.accelerations.empty() && is_monotone) limit_accelerations(times, &knots);
  take(description.accelerations, &Knot<T>::acceleration);
  pieces_.clear();
  pieces_.push_back(hold(-std::numeric_limits<double>::infinity(), knots.front().position));
  for (std::size_t k = 0; k + 1 < knots.size(); ++k)
    pieces_.push_back({times[k], waypoint_polynomial(description.interpolation, knots[k],
                                                     knots[k + 1], times[k + 1] - times[k])});
  pieces_.push_back(hold(times.back(), knots.back().position));
}

// scale f(t + delay) - offset. The first-order part of the delay is carried by the slope of f.
template <class T>
ReferenceMotion<T> Reference<T>::sampled_at(double t) const {
  const double delay = value_of(phase_);
  const T moved = phase_ - T(delay);
  const SampledFunction::Sample sample = samples_->at(t + delay);
  ReferenceMotion<T> motion;
  motion.value = amplitude_ * (T(sample.value) + T(sample.slope) * moved) - offset_;
  motion.rate = amplitude_ * (T(sample.slope) + T(sample.second) * moved);
  motion.acceleration = amplitude_ * (T(sample.second) + T(sample.third) * moved);
  motion.jerk = amplitude_ * T(sample.third);
  return motion;
}

template <class T>
ReferenceMotion<T> Reference<T>::along(const Piece& piece, double t) {
  ReferenceMotion<T> motion;
  // Not a T: products with a plain number cost half as much with lanes.
  const double x = t - piece.start;
  for (std::size_t k = piece.c.size(); k-- > 0;) {
    motion.jerk = motion.jerk * x + 3.0 * motion.acceleration;
    motion.acceleration = motion.acceleration * x + 2.0 * motion.rate;
    motion.rate = motion.rate * x + motion.value;
    motion.value = motion.value * x + piece.c[k];
  }
  return motion;
}

template <class T>
ReferenceMotion<T> Reference<T>::commanded_at(const LiveFunction& function, double t) {
  Piece piece{function.start, {}};
  for (std::size_t k = 0; k < piece.c.size(); ++k) piece.c[k] = T(function.c[k]);
  return along(piece, t);
}

template <class T>
std::size_t Reference<T>::piece_at(double t) const {
  const auto next =
      std::upper_bound(pieces_.begin(), pieces_.end(), t,
                       [](double time, const Piece& piece) { return time < piece.start; });
  return to_index(next - pieces_.begin()) - 1;
}

template <class T>
T Reference<T>::area(const Piece& piece, double duration) {
  T sum(0.0);
  for (std::size_t k = piece.c.size(); k-- > 0;)
    sum = sum * duration + piece.c[k] * (1.0 / static_cast<double>(k + 1));
  return sum * duration;
}

// The first piece is a constant without a start; it counts from the first way-point backward.
template <class T>
void Reference<T>::sum_areas(double duration) {
  if (kind_ == ReferenceDescription::Kind::kExpression) return set_panels(duration);
  areas_.assign(pieces_.size(), T(0.0));
  for (std::size_t k = 2; k < pieces_.size(); ++k)
    areas_[k] = areas_[k - 1] + area(pieces_[k - 1], pieces_[k].start - pieces_[k - 1].start);
  if (pieces_.empty()) return;
  const T before = integral_at(0.0);
  for (T& sum : areas_) sum -= before;
}

template <class T>
T Reference<T>::integral_at(double t) const {
  using std::cos;
  if (kind_ == ReferenceDescription::Kind::kConstant) return offset_ * t;
  if (kind_ == ReferenceDescription::Kind::kSine)
    return offset_ * t + amplitude_ / angular_frequency_ *
                             (cos(phase_) - cos(angular_frequency_ * T(t) + phase_));
  const std::size_t k = piece_at(t);
  if (k == 0) return areas_[0] + pieces_[0].c[0] * (t - pieces_[1].start);
  return areas_[k] + area(pieces_[k], t - pieces_[k].start);
}

// Panels are chosen by the values alone, so that all number types have the same ones.
template <class T>
void Reference<T>::set_panels(double duration) {
  std::vector<double> values;
  for (const T& used : used_) values.push_back(value_of(used));
  const auto series_of_values = [&](double t) {
    return time_series(*expression_->formula, expression_->time, values, t);
  };
  panels_.clear();
  for (const double begin : integration_panels(series_of_values, duration)) {
    const Taylor<T> series = series_at(begin);
    T area(0.0);
    if (!panels_.empty()) {
      const Panel& last = panels_.back();
      area = last.area + panel_integral(last.series, series, begin - last.begin);
    }
    panels_.push_back({begin, series, area});
  }
}

// Outside the prepared panels, as in a run that goes on, further ones of their mean width follow.
template <class T>
T Reference<T>::integral_by_panels(double t, const Taylor<T>& there) const {
  const auto next =
      std::upper_bound(panels_.begin(), panels_.end(), t,
                       [](double time, const Panel& panel) { return time < panel.begin; });
  Panel panel = next == panels_.begin() ? *next : *(next - 1);
  const double width = panels_.back().begin / static_cast<double>(panels_.size() - 1);
  while (panel.begin != t) {
    const double step = std::clamp(t - panel.begin, -width, width),
                 end = std::abs(t - panel.begin) <= width ? t : panel.begin + step;
    const Taylor<T> series = end == t ? there : series_at(end);
    panel.area += panel_integral(panel.series, series, end - panel.begin);
    panel.begin = end;
    panel.series = series;
  }
  return panel.area;
}

template <class T>
Taylor<T> Reference<T>::series_at(double t) const {
  return time_series(*expression_->formula, expression_->time, used_, t);
}

template <class T>
ReferenceMotion<T> Reference<T>::at(double t) const {
  using std::cos;
  using std::sin;
  ReferenceMotion<T> motion;
  if (kind_ == ReferenceDescription::Kind::kConstant) {
    motion.value = offset_;
    return motion;
  }
  if (kind_ == ReferenceDescription::Kind::kSampled) return sampled_at(t);
  if (kind_ == ReferenceDescription::Kind::kExpression) {
    const Taylor<T> f = series_at(t);
    return {f.c[0], f.c[1], T(2.0) * f.c[2], T(6.0) * f.c[3]};
  }
  if (kind_ == ReferenceDescription::Kind::kLive)
    return live_->commanded ? commanded_at(*live_, t) : planned_->at(t);
  if (kind_ == ReferenceDescription::Kind::kSine) {
    const T angle = angular_frequency_ * T(t) + phase_, s = amplitude_ * sin(angle),
            c = amplitude_ * cos(angle);
    const T square = angular_frequency_ * angular_frequency_;
    return {offset_ + s, angular_frequency_ * c, -(square * s), -(square * angular_frequency_ * c)};
  }
  if (kind_ == ReferenceDescription::Kind::kIntegral) {
    const Reference& of = rate_[0];
    if (of.kind_ == ReferenceDescription::Kind::kExpression) {
      const Taylor<T> f = of.series_at(t);
      return {offset_ + of.integral_by_panels(t, f), f.c[0], f.c[1], T(2.0) * f.c[2]};
    }
    const ReferenceMotion<T> rate = of.at(t);
    return {offset_ + of.integral_at(t), rate.value, rate.rate, rate.acceleration};
  }
  const Piece& piece = pieces_[piece_at(t)];
  if (!std::isfinite(piece.start)) {
    motion.value = piece.c[0];
    return motion;
  }
  return along(piece, t);
}

void Reference<Traced>::set(const ReferenceDescription& description,
                            const std::vector<Traced>& parameters) {
  motion_ = {};
  switching_ = nullptr;
  if (description.kind == ReferenceDescription::Kind::kConstant) {
    motion_.value = description.constant.at(parameters);
    return;
  }
  Recording* const recording = parameters.front().recording();
  const auto order = [&](int k) {
    return Traced(recording, recording->timed(SourceId(description), k));
  };
  const TimeExpression& expression = description.expression;
  if (description.kind == ReferenceDescription::Kind::kExpression &&
      !expression.parameters.empty()) {
    const Traced t(recording, recording->timed(SourceId(clock_function()), 0));
    variables_.clear();
    for (const auto& parameter : expression.parameters)
      variables_.push_back(parameter ? Taylor<Traced>(value_at(*parameter, parameters))
                                     : Taylor<Traced>::time(t));
    switching_ = expression.formula.get();
    return;
  }
  motion_ = {order(0), order(1), order(2), order(3)};
}

ReferenceMotion<Traced> Reference<Traced>::recorded() const {
  const auto time = std::find_if(variables_.begin(), variables_.end(),
                                 [](const auto& variable) { return !variable.c[0].is_literal(); });
  const NamedSwitches<Traced> named(time->c[0], *switching_);
  const Taylor<Traced> f = evaluate_formula<Taylor<Traced>>(switching_->steps(), variables_);
  return {f.c[0], f.c[1], 2.0 * f.c[2], 6.0 * f.c[3]};
}

#define CODESIGN_INSTANTIATE(T) template class Reference<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

template <class T>
void ShapedInput<T>::set(const BasisDescription& basis, const std::vector<T>& parameters) {
  basis_ = &basis;
  coefficients_.clear();
  for (const Quantity& coefficient : basis.coefficients)
    coefficients_.push_back(coefficient.at(parameters));
}

template <class T>
ReferenceMotion<T> ShapedInput<T>::at(double t) const {
  const BasisWeights weights = basis_weights(*basis_, t);
  ReferenceMotion<T> motion;
  for (int k = 0; k < weights.count; ++k) {
    const T& coefficient = coefficients_[to_index(weights.first + k)];
    motion.value += T(weights.value[to_index(k)]) * coefficient;
    motion.rate += T(weights.rate[to_index(k)]) * coefficient;
  }
  return motion;
}

void ShapedInput<Traced>::set(const BasisDescription& basis,
                              const std::vector<Traced>& parameters) {
  Recording* const recording = parameters.front().recording();
  motion_.value = Traced(recording, recording->timed(SourceId(basis), 0));
  motion_.rate = Traced(recording, recording->timed(SourceId(basis), 1));
}

#define CODESIGN_INSTANTIATE(T) template class ShapedInput<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
