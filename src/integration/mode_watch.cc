// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/mode_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "equations/equation_variant.h"
#include "integration/event_names.h"
#include "integration/step_control.h"
#include "integration/step_points.h"
#include "math/arrays.h"

namespace codesign {
namespace {

/// The place of the lowest point of the parabola through (0, a), (1, b), (2, c), if it is between
/// them.
double lowest(double a, double b, double c) {
  const double curvature = a - 2.0 * b + c;
  return curvature > 0.0 ? std::clamp(1.0 + 0.5 * (a - c) / curvature, 0.0, 2.0) : 1.0;
}

}  // namespace

ModeWatch::ModeWatch(const CompiledSystem& system) : system_(system) {}

// The mode of the start is that of the motion behind it, which cross() finds.
void ModeWatch::start(const State<double>& initial, Equations<double>* equations) {
  equations->compiled().release();
  mode_ = equations->compiled().mode_of(initial);
  equations->hold(mode_);
  guard_ = -1;
  sizes_.resize(0);
  returns_ = 0;
  last_change_ = -1.0;
  step_size_ = 0.0;
  is_due_ = is_active();
  if (!is_active()) return;
  if (!along_) along_ = std::make_unique<Equations<Lanes<4>>>(system_);
  const std::vector<double>& parameters = equations->parameters();
  along_->set_design({parameters.begin(), parameters.end()});
  along_->compiled().set_time_direction({1.0, 0.0, 0.0, 0.0});
}

void ModeWatch::restart(Equations<double>* equations) {
  if (!is_active()) return;
  const std::vector<double>& parameters = equations->parameters();
  along_->set_design({parameters.begin(), parameters.end()});
  equations->hold(mode_);
  guard_ = -1;
  is_due_ = true;
}

double ModeWatch::side_at(int k, double theta, OneStep<double>* step) {
  step->interpolate_attempt(theta, &point_);
  step->equations().compiled().switches(point_, &residual_, &right_);
  return side(k, residual_);
}

// At all points; where a guard is lowest between two of them, there as well. The first and the last
// interval may have a lowest point that no point between them shows.
ModeWatch::Crossing ModeWatch::crossing_of(int k, OneStep<double>* step) {
  const auto at = [&](int point) { return side(k, samples_.col(point)); };
  for (int point = 1; point <= points_; ++point) {
    const double from = static_cast<double>(point - 1) / points_;
    if (has_left(k, at(point))) return {k, from, static_cast<double>(point) / points_};
    if (point == points_) break;
    const bool falls = at(point) <= at(point - 1), rises = at(point) <= at(point + 1);
    // A guard that the projection has put beyond zero at the start does not leave its side there.
    const bool at_start = point == 1 && rises && !has_left(k, at(0)),
               at_end = point + 1 == points_ && falls;
    if (!(falls && rises) && !at_start && !at_end) continue;
    const double place = (point - 1 + lowest(at(point - 1), at(point), at(point + 1))) / points_,
                 value = side_at(k, place, step);
    if (has_left(k, value) && value < at(0)) return {k, std::min(from, place), place};
    if (falls && rises) look_for_touch(k, place, value, step);
  }
  return {};
}

// As deep as a crossing at kGrazing of the guard's pace: the parabola of range R over the step
// whose rate at its zeros is kGrazing R per step.
void ModeWatch::look_for_touch(int k, double place, double value, OneStep<double>* step) {
  constexpr double kMoves = 1e4, kWindow = 1e-3;
  constexpr int kMost = 4;
  const double range = along(k).maxCoeff() - along(k).minCoeff(),
               deepest = kGrazing * kGrazing / 4.0 * range;
  if (!(range > kMoves * sizes_[k]) || !(value < kWindow * range)) return;
  // The lowest point of the dense output, by parabolas through ever nearer points.
  double width = 0.5 / points_;
  for (int n = 0; n < kMost && value > deepest; ++n, width *= 0.1) {
    const double a = side_at(k, place - width, step), c = side_at(k, place + width, step);
    place += width * (lowest(a, value, c) - 1.0);
    value = side_at(k, place, step);
  }
  if (value > deepest || (touch_.guard >= 0 && place >= touch_.to)) return;
  touch_ = {k, place, place};
}

// Whether the motion would jump on the other side of the guard, at which it turns round.
bool ModeWatch::has_touched(Assembly* assembly, Equations<double>* equations,
                            EventLog::Entry* entry) {
  if (touch_.guard < 0) return false;
  const int k = std::exchange(touch_.guard, -1);
  *entry = {touched_.t, equations->compiled().switch_origin(mode_, to_index(k)),
            !mode_[to_index(k)], true, true};
  return jumps_beyond(k, touched_, assembly, equations);
}

EventLog::Entry ModeWatch::touch_at(double time, Equations<double>* equations) const {
  return {time, equations->compiled().switch_origin(mode_, to_index(guard_)),
          !mode_[to_index(guard_)], true, true};
}

bool ModeWatch::jumps_beyond(int k, const State<double>& at, Assembly* assembly,
                             Equations<double>* equations) {
  if (is_kink(k, equations)) return false;
  ModeChange change;
  change.before = change.behind = at;
  change.mode = beyond(k);
  const auto solve = [&](const std::vector<bool>& mode, State<double>* state, double* g) {
    equations->hold(mode);
    if (!assembly->rates().solve(equations, state).ok()) return false;
    equations->residual(*state, &residual_, g);
    return true;
  };
  const bool is_solved = solve(change.mode, &change.behind, &change.g) &&
                         solve(mode_, &change.before, &change.g_before);
  equations->hold(mode_);
  return is_solved && has_jump(change);
}

void ModeWatch::find_zeros(const State<double>& at, Equations<double>* equations,
                           std::vector<int>* zeros) {
  zeros->clear();
  if (!is_active()) return;
  equations->compiled().switches(at, &residual_, &right_);
  for (int k = 0; k < static_cast<int>(mode_.size()); ++k)
    if (std::abs(residual_[k]) <=
        kCancelled * (std::abs(right_[k]) + std::abs(right_[k] - residual_[k])))
      zeros->push_back(k);
}

void ModeWatch::sample_at(int points, OneStep<double>* step) {
  const auto count = to_signed(mode_.size());
  points_ = points;
  if (samples_.rows() != count || samples_.cols() <= points)
    samples_.resize(count, std::max<Eigen::Index>(samples_.cols(), points + 1));
  for (int point = 0; point <= points; ++point) {
    if (point == points)
      point_ = step->unprojected();
    else
      step->interpolate_attempt(static_cast<double>(point) / points, &point_);
    step->equations().compiled().switches(point_, &residual_, &right_);
    samples_.col(point) = residual_;
    if (sizes_.size() != count) sizes_.setZero(count);
    if (residual_.hasNaN()) continue;
    sizes_ = sizes_.cwiseMax(kRounding * residual_.cwiseAbs())
                 .cwiseMax(kCancelled * (right_.cwiseAbs() + (right_ - residual_).cwiseAbs()));
  }
}

bool ModeWatch::is_resolved() const {
  for (int k = 0; k < static_cast<int>(mode_.size()); ++k) {
    int turns = 0;
    double before = 0.0;
    for (int point = 1; point <= points_; ++point) {
      const double change = samples_(k, point) - samples_(k, point - 1);
      if (!(std::abs(change) > sizes_[k])) continue;
      if (change * before < 0.0) ++turns;
      before = change;
    }
    if (!show_turns(points_, turns)) return false;
  }
  return true;
}

bool ModeWatch::sample(OneStep<double>* step) {
  int points =
      step_parts(step->step_size() / system_.study().duration, kLeastPoints, kPointsPerStudy);
  sample_at(points, step);
  while (!is_resolved()) {
    points *= 2;
    if (points > kMostStepParts) return false;
    sample_at(points, step);
  }
  return true;
}

ModeWatch::Crossing ModeWatch::first_crossing(OneStep<double>* step) {
  Crossing first;
  double earliest = 2.0;
  for (int k = 0; k < static_cast<int>(mode_.size()); ++k) {
    const Crossing crossing = crossing_of(k, step);
    if (crossing.guard < 0 || crossing.from >= earliest) continue;
    const double place = locate(crossing, step);
    if (place >= earliest) continue;
    earliest = place;
    first = {k, place, place};
  }
  return first;
}

// An end on a guard, as where a switching time is also an instant at which a controller samples:
// the guard is crossed before inputs jump.
ModeWatch::Crossing ModeWatch::crossing_at_end(OneStep<double>* step) {
  for (int k = 0; k < static_cast<int>(mode_.size()); ++k) {
    const double end = side(k, samples_.col(points_)), before = side(k, samples_.col(points_ - 1));
    if (std::abs(end) <= sizes_[k] && before > sizes_[k] &&
        has_left(k, side_at(k, 1.0 + kBeyond, step)))
      return {k, 1.0, 1.0};
  }
  return {};
}

// The Illinois variant of the regula falsi, on the dense output; with bisections where that is
// slow, as at a multiple root.
double ModeWatch::locate(const Crossing& crossing, OneStep<double>* step) {
  constexpr int kMost = 120, kUsual = 12;
  constexpr double kEnough = 1e-14;
  double a = crossing.from, b = crossing.to, at_a = side_at(crossing.guard, a, step),
         at_b = side_at(crossing.guard, b, step);
  if (at_a <= 0.0) {
    // A guard that begins at zero crosses where the step begins, unless it rises before it falls.
    constexpr int kHalvings = 12;
    const double begin = a;
    for (int k = 0; k < kHalvings && at_a <= 0.0; ++k) {
      const double middle = 0.5 * (begin + b), value = side_at(crossing.guard, middle, step);
      (value > sizes_[crossing.guard] ? a : b) = middle;
      (value > sizes_[crossing.guard] ? at_a : at_b) = value;
    }
    if (at_a <= 0.0) return begin;
  }
  int last = 0;
  for (int k = 0; k < kMost && b - a > kEnough; ++k) {
    const bool bisects = k > kUsual && k % 2 == 0;
    const double secant = std::clamp((a * at_b - b * at_a) / (at_b - at_a), a, b),
                 middle = bisects ? 0.5 * (a + b) : secant,
                 value = side_at(crossing.guard, middle, step);
    if (value < 0.0) {
      b = middle, at_b = value;
      if (last == 1) at_a *= 0.5;
      last = 1;
    } else {
      a = middle, at_a = value;
      if (last == 2) at_b *= 0.5;
      last = 2;
      if (value == 0.0) return middle;
    }
  }
  return b;
}

// A step of size h ends where the dense output of the longer one was; its own end differs from that
// by the error of the dense output, which a few secant steps remove.
bool ModeWatch::repeat(int guard, double h, OneStep<double>* step) {
  constexpr int kMost = 6;
  double before = 0.0, value_before = 0.0;
  for (int k = 0; k < kMost; ++k) {
    if (!step->attempt(h)) return false;
    step->equations().compiled().switches(step->unprojected(), &residual_, &right_);
    const double value = side(guard, residual_);
    if (value == 0.0) return true;
    double slope = 0.0;
    if (k == 0) {
      const double back = 1e-3;
      slope = (value - side_at(guard, 1.0 - back, step)) / (back * h);
    } else {
      slope = (value - value_before) / (h - before);
    }
    const double change = -value / slope;
    if (!std::isfinite(change) || std::abs(change) <= 4e-16 * std::max(h, step->state().t) ||
        std::abs(change) > 0.1 * h || (k > 0 && std::abs(value) >= std::abs(value_before)))
      return true;
    before = h, value_before = value;
    h += change;
  }
  return true;
}

// A comparison with NaN counts as equal, so that a guard without a value would never be passed.
Status ModeWatch::undefined_guard(double t) const {
  if (undefined_ < 0) return {};
  return {StatusCode::kNonFinite, t,
          "the guard of " + describe_switch(system_, undefined_at_) +
              " is not a number there, so that it cannot be decided"};
}

// Behind the crossing another mode holds, which may not ask for that guard: sqrt(x) where x < 0.
bool ModeWatch::is_undefined_before(const Crossing& crossing) {
  const double end = crossing.guard < 0 ? 1.0 : crossing.to;
  for (int point = 0; point <= points_ && static_cast<double>(point) / points_ <= end; ++point)
    for (Eigen::Index k = 0; k < samples_.rows(); ++k)
      if (std::isnan(samples_(k, point))) undefined_ = static_cast<int>(k);
  return undefined_ >= 0;
}

// Behind the crossing the attempt follows a motion that does not take place, in which the guard may
// go far.
double ModeWatch::pace_before(const Crossing& crossing) const {
  const auto before =
      samples_.row(crossing.guard).head(1 + static_cast<Eigen::Index>(crossing.to * points_));
  const double range = std::max(0.0, before.maxCoeff()) - std::min(0.0, before.minCoeff());
  return crossing.to > 0.0 ? range / (crossing.to * step_size_) : 0.0;
}

bool ModeWatch::cut(OneStep<double>* step) {
  guard_ = undefined_ = -1;
  if (!is_active()) return true;
  is_due_ = false;
  step_size_ = step->step_size();
  touch_.guard = -1;
  if (!sample(step)) return false;
  Crossing crossing = first_crossing(step);
  if (touch_.guard >= 0 && crossing.guard >= 0 && crossing.to <= touch_.to) touch_.guard = -1;
  if (touch_.guard >= 0) step->interpolate_attempt(touch_.to, &touched_);
  if (is_undefined_before(crossing)) {
    undefined_at_ = step->equations().compiled().switch_origin(mode_, to_index(undefined_));
    return false;
  }
  if (crossing.guard < 0) crossing = crossing_at_end(step);
  if (crossing.guard < 0) return true;
  const double least = smallest_step(step->state().t, system_.study().duration);
  if (returns_to_kink(crossing, step)) {
    if (step_size_ > kShortest * least) return false;
    return is_due_ = true;
  }
  // A guard that is beyond zero from the beginning on jumped there: it has no instant of its own.
  if (!has_left(crossing.guard, side(crossing.guard, samples_.col(0)))) guard_ = crossing.guard;
  is_due_ = true;
  next_mode_ = mode_beyond(crossing, step);
  guard_pace_ = pace_before(crossing);
  return crossing.from >= 1.0 ||
         repeat(crossing.guard, std::max(crossing.to * step_size_, least), step);
}

}  // namespace codesign
