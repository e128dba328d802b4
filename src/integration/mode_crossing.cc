// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// What a ModeWatch does where the mode changes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "equations/equation_variant.h"
#include "integration/event_names.h"
#include "integration/mode_watch.h"
#include "integration/step_control.h"
#include "math/arrays.h"

namespace codesign {
namespace {

void move(const State<double>& from, const State<double>& rates, double h, State<double>* to) {
  *to = from;
  to->q += h * rates.q;
  to->v += h * rates.v;
  to->s += h * rates.s;
  to->z += h * rates.z;
  to->t += h;
}

}  // namespace

// As near behind the crossing as its guard has another sign: the mode that the motion enters. The
// dense output goes on a little beyond the end of the step.
std::vector<bool> ModeWatch::mode_beyond(const Crossing& crossing, OneStep<double>* step) {
  constexpr double kFarther = 10.0;
  constexpr int kDecades = 9;
  double distance = 1e-9;
  for (int k = 0; k < kDecades; ++k, distance *= kFarther) {
    const double place = std::min(1.0 + kBeyond, crossing.to + distance);
    if (side_at(crossing.guard, place, step) >= 0.0) continue;
    std::vector<bool> mode = step->equations().compiled().mode_of(point_);
    if (mode == mode_) continue;
    return is_alone(crossing.guard) ? mode : mode_of_one(crossing, step);
  }
  // It leaves its side more slowly than that.
  return beyond(crossing.guard);
}

// Whether no other guard is beyond zero where residual_ was evaluated. Those that stay at zero, as
// of bristles at rest, do not count.
bool ModeWatch::is_alone(int guard) const {
  for (int k = 0; k < static_cast<int>(mode_.size()); ++k)
    if (k != guard && side(k, residual_) < 0.0 && along(k).cwiseAbs().maxCoeff() > sizes_[k])
      return false;
  return true;
}

// What decides later switches is expected.
std::vector<bool> ModeWatch::beyond(int guard) const {
  std::vector<bool> begun(mode_.begin(), mode_.begin() + guard);
  begun.push_back(!mode_[to_index(guard)]);
  return system_.record_variant({}, EquationPart::kMotion, begun)->mode();
}

// Guards that are zero at the same instant are crossed one after the other, since each has an
// instant of its own in other designs: two switching times that are equal. The mode in which only
// the first one is beyond: all others, those that only this mode asks for among them, as they are
// just before the crossing.
std::vector<bool> ModeWatch::mode_of_one(const Crossing& crossing, OneStep<double>* step) {
  constexpr double kBefore = 1e-6;
  step->interpolate_attempt(std::max(0.0, crossing.to - kBefore), &point_);
  return beyond_alone(crossing.guard, point_, &step->equations());
}

std::vector<bool> ModeWatch::beyond_alone(int guard, const State<double>& at,
                                          Equations<double>* equations) {
  constexpr int kMost = 64;
  std::vector<bool> mode = beyond(guard);
  const auto wrong = [&] {
    equations->hold(mode);
    equations->compiled().switches(at, &residual_, &right_);
    for (int k = guard + 1; k < static_cast<int>(mode.size()); ++k)
      if (mode[to_index(k)] != (residual_[k] > 0.0)) return k;
    return -1;
  };
  int k = wrong();
  for (int n = 0; k >= 0 && n < kMost; ++n, k = wrong()) {
    std::vector<bool> begun(mode.begin(), mode.begin() + k);
    begun.push_back(!mode[to_index(k)]);
    mode = system_.record_variant({}, EquationPart::kMotion, begun)->mode();
  }
  equations->hold(mode_);
  return mode;
}

double ModeWatch::guard_rate(int k, const State<double>& at, const State<double>& rates) {
  const auto seed = [](const VectorX<double>& value, const VectorX<double>& rate,
                       VectorX<Lanes<4>>* x) {
    *x = value.cast<Lanes<4>>();
    for (Eigen::Index i = 0; i < value.size(); ++i) (*x)[i].directions()[0] = rate[i];
  };
  moving_.resize(system_.layout());
  moving_.t = at.t;
  moving_.turns = at.turns;
  seed(at.q, rates.q, &moving_.q);
  seed(at.v, rates.v, &moving_.v);
  seed(at.s, rates.s, &moving_.s);
  seed(at.z, rates.z, &moving_.z);
  VectorX<Lanes<4>> guards, right;
  along_->compiled().switches(moving_, &guards, &right);
  return guards[k].directions()[0];
}

// Those of z are zero.
State<double> ModeWatch::rates_of(const State<double>& at) const {
  State<double> rates;
  rates.resize(system_.layout());
  rates.q = at.v;
  rates.v = at.z.head(system_.layout().n);
  rates.s = at.z.tail(system_.layout().states);
  rates.z.setZero();
  return rates;
}

// A little further along the motion, where the guards that are zero here have signs.
std::vector<bool> ModeWatch::mode_behind(const State<double>& at, const State<double>& rates,
                                         Equations<double>* equations) const {
  const double least = smallest_step(at.t, system_.study().duration);
  State<double> further;
  move(at, rates, std::max(16.0 * least, 1e-9 * step_size_), &further);
  return equations->compiled().mode_of(further);
}

// Both modes drive the motion to the guard: no step can leave it. Kinks do not hold a motion.
Status ModeWatch::count_return(double t) {
  constexpr int kEnough = 6;
  constexpr double kAtOnce = 1e-7;  // of the duration
  const double since = t - std::exchange(last_change_, t);
  if (guard_ >= 0 && held_at_ != nullptr && held_at_->is_kink) return {};
  returns_ = since < kAtOnce * system_.study().duration ? returns_ + 1 : 0;
  if (returns_ < kEnough + 2 * static_cast<int>(mode_.size())) return {};
  return {StatusCode::kSwitchHolds, t,
          "the motion is held at the switch of " + describe_switch(system_, held_at_) +
              ", whose both sides lead back to it; take a friction law such as coulomb or gonthier "
              "in place of sign() of a velocity, or make the expression continuous"};
}

bool ModeWatch::is_kink(int k, Equations<double>* equations) const {
  const SwitchOrigin* origin = equations->compiled().switch_origin(mode_, to_index(k));
  return origin != nullptr && origin->is_kink;
}

// At a kink both modes have the same rates, so that the guard leaves zero in one direction and
// neither mode leads back: a shorter attempt shows it.
bool ModeWatch::returns_to_kink(const Crossing& crossing, OneStep<double>* step) const {
  const double t = step->state().t, least = smallest_step(t, system_.study().duration);
  constexpr double kAtOnce = 4.0;
  return crossing.guard >= 0 && crossing.to * step_size_ <= least &&
         t - last_change_ <= kAtOnce * least && is_kink(crossing.guard, &step->equations());
}

// At a kink the rates are continuous, and no sensitivity jumps. An acceleration that changes the
// velocity by less than its rounding in the whole run is none: of a stop that a body at constant
// velocity touches, by the rounding of its position.
bool ModeWatch::has_jump(const ModeChange& change) const {
  constexpr double kSame = 1e-10, kEpsilon = std::numeric_limits<double>::epsilon();
  const double least =
      kEpsilon * change.before.v.lpNorm<Eigen::Infinity>() / system_.study().duration;
  const double size = std::max(change.before.z.lpNorm<Eigen::Infinity>(),
                               change.behind.z.lpNorm<Eigen::Infinity>()),
               jump = (change.before.z - change.behind.z).lpNorm<Eigen::Infinity>(),
               of_g = std::abs(change.g_before - change.g);
  return jump > std::max(kSame * size, least) ||
         of_g > kSame * std::max(std::abs(change.g_before), std::abs(change.g));
}

// The guard that the change of the rates itself has moved beyond zero, such as one of an
// acceleration; -1 if there is none. Near zero, where the one is that changed the mode, rounding of
// the rates is no move.
int ModeWatch::jumped_guard(const ModeChange& change, Equations<double>* equations) {
  constexpr double kSame = 1e-9;
  equations->compiled().switches(change.before, &residual_, &right_);
  equations->compiled().switches(change.behind, &ahead_, &right_);
  for (int k = 0; k < static_cast<int>(mode_.size()); ++k) {
    const double size = std::max(std::abs(residual_[k]), std::abs(ahead_[k])),
                 rounding = k == change.guard ? sizes_[k] : 0.0;
    if (side(k, ahead_) < 0.0 &&
        std::abs(ahead_[k] - residual_[k]) > std::max(rounding, kSame * size))
      return k;
  }
  return -1;
}

// The guard at which the motion rests and which its acceleration leaves for the other side, such as
// one of a position where a load begins; -1 if there is none. Its own crossing would come at once,
// at a rate of zero. Its value goes with the square of the time, unlike that of a guard with an
// instant of its own, which another design moves.
int ModeWatch::left_guard(const ModeChange& change, Equations<double>* equations) {
  constexpr double kSmall = 1e-3, kQuadratic = 0.35, kAtRest = 1e-6;
  const double duration = system_.study().duration,
               h = std::max(1e-6 * duration, kSmall * step_size_);
  const auto guards_after = [&](double time, VectorX<double>* guards) {
    const State<double>& at = change.behind;
    const auto accelerations = at.z.head(system_.layout().n);
    point_ = at;
    point_.q += time * (at.v + 0.5 * time * accelerations);
    point_.v += time * accelerations;
    point_.s += time * at.z.tail(system_.layout().states);
    point_.t += time;
    equations->compiled().switches(point_, guards, &right_);
  };
  VectorX<double> now;
  guards_after(0.0, &now);
  guards_after(0.5 * h, &residual_);
  guards_after(h, &ahead_);
  const State<double> rates = rates_of(change.behind);
  along_->hold(mode_);
  for (int k = 0; k < static_cast<int>(mode_.size()); ++k)
    if (const double beyond = side(k, ahead_);
        beyond < 0.0 && std::abs(now[k]) <= kSmall * std::abs(beyond) &&
        side(k, residual_) > kQuadratic * beyond && !is_kink(k, equations) &&
        h * std::abs(guard_rate(k, change.behind, rates)) <= kAtRest * std::abs(beyond))
      return k;
  return -1;
}

// Guards that jump with the rates belong to the same change and the same instant, as do those that
// the motion leaves from rest.
Status ModeWatch::enter(Assembly* assembly, Equations<double>* equations, ModeChange* change) {
  for (std::size_t turn = 0;; ++turn) {
    mode_ = change->mode;
    equations->hold(mode_);
    change->behind = change->before;
    if (Status status = assembly->rates().solve(equations, &change->behind); !status.ok())
      return status;
    if (turn >= mode_.size()) return {};
    const int jumped = jumped_guard(*change, equations);
    if (jumped < 0) {
      const int left = left_guard(*change, equations);
      if (left < 0) return {};
      change->mode = beyond_alone(left, change->behind, equations);
      continue;
    }
    std::vector<bool> begun(mode_.begin(), mode_.begin() + jumped);
    begun.push_back(!mode_[to_index(jumped)]);
    begun.insert(begun.end(), mode_.begin() + jumped + 1, mode_.end());
    change->mode = system_.record_variant({}, EquationPart::kMotion, begun)->mode();
  }
}

// Modes are equal up to the first switch that changed.
int ModeWatch::changed_switch(int guard, const std::vector<bool>& mode) const {
  if (guard >= 0) return guard;
  const std::size_t both = std::min(mode.size(), mode_.size());
  for (std::size_t k = 0; k < both; ++k)
    if (mode[k] != mode_[k]) return static_cast<int>(k);
  return -1;
}

Status ModeWatch::cross(const State<double>& state, Assembly* assembly,
                        Equations<double>* equations, ModeChange* change) {
  is_due_ = false;
  const bool at_start = last_change_ < 0.0;
  if (guard_ >= 0) held_at_ = equations->compiled().switch_origin(mode_, to_index(guard_));
  if (Status status = count_return(state.t); !status.ok()) return status;
  *change = {};
  change->guard = std::exchange(guard_, -1);
  change->end = change->before = state;
  if (Status status = assembly->rates().solve(equations, &change->before); !status.ok())
    return status;
  State<double>& before = change->before;
  State<double> rates = rates_of(before);
  assembly->rates().differentiate(before, equations, &rates);
  equations->residual(before, &residual_, &change->g_before);
  along_->hold(mode_);
  if (change->guard >= 0) change->guard_rate = guard_rate(change->guard, before, rates);
  change->mode = change->guard >= 0 ? next_mode_ : mode_behind(before, rates, equations);
  if (const int k = at_start ? -1 : changed_switch(change->guard, change->mode); k >= 0) {
    change->origin = equations->compiled().switch_origin(mode_, to_index(k));
    change->becomes_true = !mode_[to_index(k)];
  }
  const std::vector<bool> sought = change->mode;
  if (Status status = enter(assembly, equations, change); !status.ok()) return status;
  equations->residual(change->behind, &residual_, &change->g);
  // Where a guard is only touched, its instant has no derivative.
  const bool is_kink = change->mode == sought && change->origin && change->origin->is_kink;
  change->is_jump = !is_kink && has_jump(*change);
  change->is_touched = change->is_jump && change->guard >= 0 &&
                       !(std::abs(change->guard_rate) > kGrazing * guard_pace_);
  if (!change->is_jump || is_touched(change->guard_rate)) change->guard = -1;
  return {};
}

}  // namespace codesign
