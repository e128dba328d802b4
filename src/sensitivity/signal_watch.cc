// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/signal_watch.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "math/arrays.h"
#include "sensitivity/motion_rates.h"

namespace codesign {
namespace {

// Fraction of a step: at its ends a reference may have a kink, so that slopes are taken just
// inside.
constexpr double kInside = 1e-10;
// Fraction of the duration: where a step ends at a break time, the two may differ by rounding.
constexpr double kRounding = 1e-14;
constexpr int kBits = 50;  // accuracy of the instant of an extremum
constexpr std::uintmax_t kMostIterations = 60;
constexpr double kShort = 4.0;   // in units of what slopes are taken inside of a step
constexpr double kAtEnd = 1e-7;  // fraction of the duration: nearer to an end that moves is at it
// Fraction of the duration: a number just inside a step beside one at its end.
constexpr double kNear = 1e-9;

bool jumps(double before, double after) {
  return std::abs(after - before) > 1e-8 * (std::abs(before) + std::abs(after));
}

}  // namespace

SignalWatch::SignalWatch(const CompiledSystem& system)
    : system_(system),
      layout_(system.study()),
      clock_(system.study()),
      curves_(system.watched().size()) {
  state_.resize(system.layout());
  rates_.resize(system.layout());
}

Status SignalWatch::start(Integrator* integrator, Differentiate differentiate) {
  integrator_ = integrator;
  differentiate_ = std::move(differentiate);
  status_ = {};
  time_ = integrator->state().t;
  clock_.start();
  begins_at_jump_ = ends_at_jump_ = false;
  begin_time_.resize(0);
  end_time_.resize(0);
  slopes_.setZero(layout_.size());
  const auto parameters = to_signed(differentiate_ ? system_.study().tuned.size() : 0);
  extremes_.values.setConstant(layout_.size(), std::numeric_limits<double>::quiet_NaN());
  extremes_.times.setZero(layout_.size());
  extremes_.gradients.setZero(parameters, layout_.size());
  for (std::size_t k = 0; k < curves_.size() && status_.ok(); ++k) {
    curves_[k] = {};
    state_ = integrator->state();
    integrator->equations().watched_gradient(k, state_, &sparse_);
    curves_[k].reads_rates = !sparse_.rate.empty();
    if (has_band(system_.study().watched[k]))
      curves_[k].band.start(system_.study(), system_.study().watched[k],
                            integrator->equations().parameters(), parameters);
    if (layout_.entries()[k].instants.front() <= time_) reach_instant(k, time_);
  }
  return status_;
}

Status SignalWatch::look(const Eigen::VectorXd& end_time) {
  const double from = time_, to = integrator_->state().t;
  begins_at_jump_ = ends_at_jump_;
  begin_time_.swap(end_time_);
  end_time_ = end_time;
  ends_at_jump_ = !clock_.due(to).empty() || integrator_->ends_at_switch();
  for (std::size_t k = 0; k < curves_.size() && status_.ok(); ++k) follow(k, from, to);
  time_ = to;
  return integrator_->has_ended() ? end() : status_;
}

// Instants and windows that the run does not reach have the values at its end.
Status SignalWatch::end() {
  for (std::size_t k = 0; k < curves_.size(); ++k)
    while (status_.ok() && curves_[k].next < layout_.entries()[k].instants.size())
      reach_instant(k, integrator_->state().t);
  return status_;
}

/// Sets state_ to the point of the dense output at `time`.
bool SignalWatch::go_to(std::size_t k, double time) {
  double psi = 0.0;
  integrator_->interpolate(time, &state_, &psi);
  if (!curves_[k].reads_rates) return true;
  const Status solved = integrator_->assembly().rates().solve(&integrator_->equations(), &state_);
  if (!solved.ok()) status_ = solved;
  return solved.ok();
}

double SignalWatch::value(std::size_t k, double time) {
  if (!go_to(k, time)) return 0.0;
  const double value = integrator_->equations().watched(k, state_);
  if (!std::isfinite(value)) status_ = failed(k, time);
  return value;
}

// The slope is the gradient of the signal times the rates of the dense output; the rates of
// accelerations and multipliers follow from the derivatives of the equations.
SignalWatch::Sample SignalWatch::sample(std::size_t k, double time) {
  Sample result;
  result.time = time;
  if (!status_.ok() || !go_to(k, time)) return result;
  integrator_->interpolate_rates(time, &rates_);
  if (curves_[k].reads_rates)
    integrator_->assembly().rates().differentiate(state_, &integrator_->equations(), &rates_);
  result.value = integrator_->equations().watched_gradient(k, state_, &sparse_);
  result.slope = rate_along(sparse_, rates_, system_.layout());
  if (!std::isfinite(result.value) || !std::isfinite(result.slope)) status_ = failed(k, time);
  return result;
}

/// Follows a signal through a step, from instant to instant.
void SignalWatch::follow(std::size_t k, double from, double to) {
  const std::vector<double>& instants = layout_.entries()[k].instants;
  Curve& curve = curves_[k];
  const double slack = kInside * (to - from) + kRounding * system_.study().duration;
  std::optional<double> break_time = layout_.break_near(to, slack);
  if (to < instants.front() - slack || curve.next >= instants.size()) return;
  const double begin = std::max(from, instants.front()), end = std::min(to, instants.back());
  // Where an end that moves meets an instant, the value there moves with it: as a constant it would
  // hold a search at this end.
  const bool ends_run = has_moving_end(system_.study()) && integrator_->has_ended();
  const auto reach = [&](double time, double at) {
    while (status_.ok() && curve.next < instants.size() && instants[curve.next] <= time + slack &&
           !(ends_run && instants[curve.next] >= to - kAtEnd * system_.study().duration))
      reach_instant(k, at);
  };
  // Two guards that are zero at the same instant end steps whose slopes are rounding.
  if (instants.size() == 1 || to - from < kShort * slack) return reach(end, end);
  take_pieces(k, {from, to, slack}, begin, end);
  reach(begin, begin);
  if (!status_.ok()) return;
  Sample last = samples_.front();
  pass_gap(k, last);
  // Where one step ends and the next begins, the slope may jump.
  if (last.slope * curve.end_slope < 0.0 || begins_at_jump_)
    offer(k, last.time, begin == from ? begin_time_ : fixed_);
  if (begin == from) settle(k, last, slack);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!status_.ok()) return;
    const double point = points_[i];
    const Sample next = samples_[i + 1];
    if (next.time > last.time) search(k, last, next);
    pass(k, next);
    const bool is_break = break_time && point >= to - 2.0 * slack;
    // Functions of time are those behind a break time from that time on, which rounding may have
    // put behind the end of the step.
    const double behind =
        is_break ? std::min(std::max(point, *break_time), system_.study().duration) : point;
    if (is_break)
      look_for_jump(k, next, behind,
                    curve.next < instants.size() && instants[curve.next] <= point + slack);
    // A step ends with the state before the jump of sampled controllers, which the next one begins
    // with.
    if (ends_at_jump_ && point == end && end == to && next.time > last.time) {
      offer(k, next.time, end_time_);
      curve.end_value = next.value;
    }
    reach(point, behind);
    if (is_break) break_time.reset();
    last = next;
  }
  curve.end_slope = end < to ? 0.0 : last.slope;
}

/// A signal may jump where a reference has a kink. Then the value before the jump counts, too, and
/// the one behind it, which at an instant counts anyway.
void SignalWatch::look_for_jump(std::size_t k, const Sample& before, double behind,
                                bool is_instant) {
  if (!status_.ok()) return;
  const double time = std::min(before.time, behind - kRounding * system_.study().duration);
  if (!jumps(value(k, time), value(k, behind))) return;
  if (time > layout_.entries()[k].instants.front()) offer(k, time, fixed_);
  if (!is_instant) offer(k, behind, fixed_);
}

/// Looks for an extremum between two points by the sign of the slope.
void SignalWatch::search(std::size_t k, const Sample& from, const Sample& to) {
  if (!(from.slope * to.slope < 0.0)) return;
  std::uintmax_t iterations = kMostIterations;
  const auto slope = [&](double time) { return sample(k, time).slope; };
  const auto found = boost::math::tools::toms748_solve(
      slope, from.time, to.time, from.slope, to.slope,
      boost::math::tools::eps_tolerance<double>(kBits), iterations);
  if (!status_.ok()) return;
  const double time = 0.5 * (found.first + found.second);
  offer(k, time, fixed_);
  if (has_band(system_.study().watched[k])) pass(k, sample(k, time));
}

/// From the end of one step to just inside the next, where the signal may jump.
void SignalWatch::pass_gap(std::size_t k, const Sample& to) {
  if (!has_band(system_.study().watched[k])) return;
  Curve& curve = curves_[k];
  const double change = std::abs(to.value - curve.last.value),
               smooth = 2.0 * std::abs(to.slope) * (to.time - curve.last.time) +
                        1e-12 * (std::abs(to.value) + std::abs(curve.last.value));
  if (change <= smooth) return pass(k, to);
  // A guard that depends on the design moves the jump.
  if (begin_time_.size() > 0)
    gradient_ = begin_time_;
  else
    gradient_.setZero(extremes_.gradients.rows());
  curve.band.cross(to.time, gradient_, curve.band.holds(to.value));
  curve.last = to;
}

/// Compares a piece of the signal, on which it rises or falls, with the edges of its band, in the
/// order in which it meets them.
void SignalWatch::pass(std::size_t k, const Sample& to) {
  if (!status_.ok() || !has_band(system_.study().watched[k])) return;
  Curve& curve = curves_[k];
  const Sample from = curve.last;
  curve.last = to;
  const bool rises = to.value > from.value;
  for (const bool upper : {!rises, rises}) {
    const double edge = curve.band.edge(upper);
    if ((from.value < edge) == (to.value < edge)) continue;
    std::uintmax_t iterations = kMostIterations;
    double time = from.value == edge ? from.time : to.time;
    if (from.value != edge && to.value != edge && to.time > from.time) {
      const auto found = boost::math::tools::toms748_solve(
          [&](double at) { return value(k, at) - edge; }, from.time, to.time, from.value - edge,
          to.value - edge, boost::math::tools::eps_tolerance<double>(kBits), iterations);
      time = 0.5 * (found.first + found.second);
    }
    const Sample at = sample(k, time);
    if (!status_.ok()) return;
    gradient_.setZero(extremes_.gradients.rows());
    if (differentiate_) {
      differentiate_(k, state_, curve.reads_rates, &gradient_);
      gradient_ = curve.band.by_crossing(upper, at.slope, gradient_);
    }
    curve.band.cross(time, gradient_, rises != upper);
  }
}

/// The measure of a signal whose last instant is reached, with its gradient there in gradient_.
void SignalWatch::finish(std::size_t k, double time) {
  const WatchedSignal& watched = system_.study().watched[k];
  const WatchLayout::Entry& entry = layout_.entries()[k];
  if (!has_band(watched)) return set_measure(watched, entry, &extremes_);
  const RangePlaces range = find_range(entry, extremes_.values);
  const auto number = [&](int place) {
    return Differentiated{extremes_.values[place], extremes_.gradients.col(place)};
  };
  const Differentiated result = curves_[k].band.end(time, number(entry.at_instant(entry.windows())),
                                                    number(range.smallest), number(range.largest));
  gradient_ = result.gradient;
  set(entry.measure(), time, result.value);
}

/// Takes the value at the next instant, which ends one window and begins another.
void SignalWatch::reach_instant(std::size_t k, double time) {
  const WatchLayout::Entry& entry = layout_.entries()[k];
  const int instant = static_cast<int>(curves_[k].next);
  const double number = value(k, time);
  if (!status_.ok()) return;
  if (differentiate_) differentiate_(k, state_, curves_[k].reads_rates, &gradient_);
  set(entry.at_instant(instant), time, number);
  // A number that moves with the guard at this instant stays until the next step tells whether the
  // signal turns there.
  const auto exceeds = [&](int place, double by) {
    const double slope = std::abs(slopes_[place]), apart = std::abs(time - extremes_.times[place]);
    return by >
           (slope > 0.0 && apart < kNear * system_.study().duration ? 2.0 * slope * apart : 0.0);
  };
  if (instant > 0) {
    const int largest = entry.largest(instant - 1), smallest = entry.smallest(instant - 1);
    if (exceeds(largest, number - extremes_.values[largest])) set(largest, time, number);
    if (exceeds(smallest, extremes_.values[smallest] - number)) set(smallest, time, number);
  }
  if (instant < entry.windows()) {
    set(entry.largest(instant), time, number);
    set(entry.smallest(instant), time, number);
  }
  if (instant == 0 && has_band(system_.study().watched[k])) {
    curves_[k].last = {time, number, 0.0};
    curves_[k].band.begin(time, number);
  }
  ++curves_[k].next;
  if (instant > 0 && instant == entry.windows() && entry.is_measured) finish(k, time);
}

/// Compares the value at an extremum with the extreme values of its window. @param moves tau' of
/// the instant; empty: it is fixed.
void SignalWatch::offer(std::size_t k, double time, const Eigen::VectorXd& moves) {
  const WatchLayout::Entry& entry = layout_.entries()[k];
  const int window = static_cast<int>(curves_[k].next) - 1;
  if (window < 0 || window >= entry.windows()) return;
  const double number = value(k, time);
  if (!status_.ok()) return;
  const bool largest = number > extremes_.values[entry.largest(window)],
             smallest = number < extremes_.values[entry.smallest(window)];
  if (!largest && !smallest) return;
  const double slope = differentiate(k, moves);
  set(largest ? entry.largest(window) : entry.smallest(window), time, number, slope);
}

/// Sets gradient_ to the derivatives at state_, theory (21d). @returns the slope with which the
/// value moves along with its instant; 0 if that is fixed.
double SignalWatch::differentiate(std::size_t k, const Eigen::VectorXd& moves) {
  if (!differentiate_) return 0.0;
  differentiate_(k, state_, curves_[k].reads_rates, &gradient_);
  if (moves.size() == 0) return 0.0;
  if (Status status = solve_motion(integrator_, &state_, &rates_); !status.ok()) {
    status_ = status;
    return 0.0;
  }
  integrator_->equations().watched_gradient(k, state_, &sparse_);
  const double slope = rate_along(sparse_, rates_, system_.layout());
  gradient_ += slope * moves;
  return slope;
}

void SignalWatch::set(int place, double time, double number, double slope) {
  extremes_.values[place] = number;
  extremes_.times[place] = time;
  slopes_[place] = slope;
  if (differentiate_) extremes_.gradients.col(place) = gradient_;
}

/// Where a guard is zero at an instant between two windows: if the signal turns there, the extreme
/// values of both move with the guard, else they are those at the instant. @param behind just
/// behind it.
void SignalWatch::settle(std::size_t k, const Sample& behind, double slack) {
  const WatchLayout::Entry& entry = layout_.entries()[k];
  const Curve& curve = curves_[k];
  const int instant = static_cast<int>(curve.next) - 1;
  if (begin_time_.size() == 0 || instant <= 0 || instant >= entry.windows() ||
      std::abs(entry.instants[to_index(instant)] - time_) > slack || !status_.ok())
    return;
  const bool jumped = jumps(curve.end_value, behind.value);
  const int at = entry.at_instant(instant);
  for (const double sign : {1.0, -1.0}) {
    const int before = sign > 0.0 ? entry.largest(instant - 1) : entry.smallest(instant - 1),
              after = sign > 0.0 ? entry.largest(instant) : entry.smallest(instant);
    const bool rises = sign * curve.end_slope >= 0.0, falls = sign * behind.slope <= 0.0,
               higher = sign * (behind.value - curve.end_value) > 0.0,
               turns_before = rises && (jumped ? !higher : falls),
               turns_after = falls && (jumped ? higher : rises);
    // Both sides of a kink, and the instant, have the same value.
    if (slopes_[before] != 0.0 && turns_before && !jumped)
      extremes_.values[before] = extremes_.values[at];
    if (slopes_[before] != 0.0 && !turns_before) copy(at, before);
    // In front of a jump the instant has that number, too, and the next window begins with it.
    if (slopes_[before] != 0.0 && turns_before && jumped)
      for (const int place : {at, after}) copy(before, place);
    if (!turns_after || !go_to(k, behind.time)) continue;
    const double slope = differentiate(k, begin_time_);
    set(after, behind.time, jumped ? behind.value : extremes_.values[at], slope);
  }
}

/// Gives a number the value and the derivatives of another one.
void SignalWatch::copy(int from, int to) {
  extremes_.values[to] = extremes_.values[from];
  extremes_.times[to] = extremes_.times[from];
  slopes_[to] = slopes_[from];
  if (differentiate_) extremes_.gradients.col(to) = extremes_.gradients.col(from);
}

Status SignalWatch::failed(std::size_t k, double time) const {
  return {StatusCode::kNonFinite, time,
          "the signal \"" + system_.study().watched[k].signal.text + "\" is not finite"};
}

}  // namespace codesign
