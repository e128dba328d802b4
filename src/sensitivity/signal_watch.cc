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

namespace codesign {
namespace {

constexpr int kPieces = 4;           // of a step: the slope is computed at their ends
constexpr double kInside = 1e-10;    // fraction of a step: at its ends a reference may have a kink,
                                     // so that slopes are taken just inside
constexpr double kRounding = 1e-14;  // fraction of the duration: where a step ends at a break time,
                                     // the two may differ by rounding
constexpr int kBits = 50;            // accuracy of the instant of an extremum
constexpr std::uintmax_t kMostIterations = 60;

bool jumps(double before, double after) {
  return std::abs(after - before) > 1e-8 * (std::abs(before) + std::abs(after));
}

}  // namespace

Peak find_peak(const WatchLayout::Entry& entry, const Eigen::VectorXd& values) {
  const RangePlaces range = find_range(entry, values);
  if (std::abs(values[range.smallest]) > std::abs(values[range.largest]))
    return {range.smallest, -1.0};
  return {range.largest, values[range.largest] < 0.0 ? -1.0 : 1.0};
}

RangePlaces find_range(const WatchLayout::Entry& entry, const Eigen::VectorXd& values) {
  RangePlaces range{entry.first, entry.first};
  for (int k = entry.first; k < entry.measure(); ++k) {
    if (values[k] > values[range.largest]) range.largest = k;
    if (values[k] < values[range.smallest]) range.smallest = k;
  }
  return range;
}

double watched_term(const WatchedSignal& watched, const WatchLayout::Entry& entry,
                    const Extremes& extremes, Eigen::VectorXd* gradient) {
  if (!is_term(watched)) return 0.0;
  const Peak number = watched.role == WatchedSignal::Role::kPeak ? find_peak(entry, extremes.values)
                                                                 : Peak{entry.measure(), 1.0};
  const double factor = watched.weight * number.sign;
  if (gradient) *gradient += factor * extremes.gradients.col(number.place);
  return factor * extremes.values[number.place];
}

double watched_terms(const MotionStudy& study, const WatchLayout& layout, const Extremes& extremes,
                     Eigen::VectorXd* gradient) {
  double sum = 0.0;
  for (std::size_t k = 0; k < study.watched.size(); ++k)
    sum += watched_term(study.watched[k], layout.entries()[k], extremes, gradient);
  return sum;
}

void set_measure(const WatchedSignal& watched, const WatchLayout::Entry& entry,
                 Extremes* extremes) {
  const RangePlaces range = find_range(entry, extremes->values);
  const bool minimum = watched.measure == WatchedSignal::Measure::kMinimum,
             stroke = watched.measure == WatchedSignal::Measure::kStroke;
  const int from = minimum ? range.smallest : range.largest, place = entry.measure();
  extremes->times[place] = extremes->times[from];
  extremes->values[place] =
      extremes->values[from] - (stroke ? extremes->values[range.smallest] : 0.0);
  if (extremes->gradients.rows() == 0) return;
  extremes->gradients.col(place) = extremes->gradients.col(from);
  if (stroke) extremes->gradients.col(place) -= extremes->gradients.col(range.smallest);
}

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

Status SignalWatch::look() {
  const double from = time_, to = integrator_->state().t;
  begins_at_jump_ = ends_at_jump_;
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
  const Status solved = integrator_->assembly().solve_rates(&integrator_->equations(), &state_);
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
    integrator_->assembly().differentiate_rates(state_, &integrator_->equations(), &rates_);
  result.value = integrator_->equations().watched_gradient(k, state_, &sparse_);
  result.slope = sparse_.time;
  const Layout& layout = system_.layout();
  for (const auto& e : sparse_.position)
    result.slope +=
        e.value * (e.column < layout.n ? rates_.q[e.column] : rates_.s[e.column - layout.n]);
  for (const auto& e : sparse_.velocity) result.slope += e.value * rates_.v[e.column];
  for (const auto& e : sparse_.rate) result.slope += e.value * rates_.z[e.column];
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
  points_.clear();
  for (int piece = 1; piece < kPieces; ++piece)
    points_.push_back(from + (to - from) * piece / kPieces);
  for (std::size_t i = curve.next; i < instants.size() && instants[i] <= end + slack; ++i)
    points_.push_back(std::min(instants[i], end));
  points_.erase(std::remove_if(points_.begin(), points_.end(),
                               [&](double t) { return t < begin || t > end; }),
                points_.end());
  points_.push_back(end);
  std::sort(points_.begin(), points_.end());
  const auto inside = [&](double time) {
    return std::min(std::max(time, from + slack), to - slack);
  };
  const auto reach = [&](double time, double at) {
    while (status_.ok() && curve.next < instants.size() && instants[curve.next] <= time + slack)
      reach_instant(k, at);
  };
  if (instants.size() == 1) return reach(end, end);
  reach(begin, begin);
  if (!status_.ok()) return;
  Sample last = sample(k, inside(begin));
  pass_gap(k, last);
  // Where one step ends and the next begins, the slope may jump.
  if (last.slope * curve.end_slope < 0.0 || begins_at_jump_) offer(k, last.time);
  for (double point : points_) {
    if (!status_.ok()) return;
    const Sample next = sample(k, inside(point));
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
    if (ends_at_jump_ && point == end && end == to) offer(k, next.time);
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
  if (time > layout_.entries()[k].instants.front()) offer(k, time);
  if (!is_instant) offer(k, behind);
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
  offer(k, time);
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
  curve.band.cross(to.time, Eigen::VectorXd::Zero(extremes_.gradients.rows()),
                   curve.band.holds(to.value));
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
  if (instant > 0 && number > extremes_.values[entry.largest(instant - 1)])
    set(entry.largest(instant - 1), time, number);
  if (instant > 0 && number < extremes_.values[entry.smallest(instant - 1)])
    set(entry.smallest(instant - 1), time, number);
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

/// Compares the value at an extremum with the extreme values of its window.
void SignalWatch::offer(std::size_t k, double time) {
  const WatchLayout::Entry& entry = layout_.entries()[k];
  const int window = static_cast<int>(curves_[k].next) - 1;
  if (window < 0 || window >= entry.windows()) return;
  const double number = value(k, time);
  if (!status_.ok()) return;
  const bool largest = number > extremes_.values[entry.largest(window)],
             smallest = number < extremes_.values[entry.smallest(window)];
  if (!largest && !smallest) return;
  if (differentiate_) differentiate_(k, state_, curves_[k].reads_rates, &gradient_);
  set(largest ? entry.largest(window) : entry.smallest(window), time, number);
}

void SignalWatch::set(int place, double time, double number) {
  extremes_.values[place] = number;
  extremes_.times[place] = time;
  if (differentiate_) extremes_.gradients.col(place) = gradient_;
}

Status SignalWatch::failed(std::size_t k, double time) const {
  return {StatusCode::kNonFinite, time,
          "the signal \"" + system_.study().watched[k].signal.text + "\" is not finite"};
}

}  // namespace codesign
