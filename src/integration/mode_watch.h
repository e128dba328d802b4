// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "assembly/assembly.h"
#include "equations/equations.h"
#include "integration/event_log.h"
#include "integration/one_step.h"
#include "mechanism_codesign/status.h"
#include "system/state.h"

namespace codesign {

/// A change of the mode, theory (17d), between the end of a step and the beginning of the next one.
struct ModeChange {
  /// The switch whose guard became zero at the end of the step; -1 where no sensitivity jumps: at
  /// the start, where inputs jump, at a kink, and where a guard is only touched.
  int guard = -1;
  /// The time derivative of that guard along the motion before the change, s_t + s_x f- [per s].
  double guard_rate = 0.0;
  std::vector<bool> mode;          ///< after it
  State<double> end;               ///< of the step, with its own z
  State<double> before, behind;    ///< the same q, v and s with the rates z of both modes
  double g_before = 0.0, g = 0.0;  ///< integrands of the objective
  /// Of the switch that changed; null at the start of a run, and if no switch did.
  const SwitchOrigin* origin = nullptr;
  bool becomes_true = false;  ///< whether its comparison x < y holds after the change
  bool is_jump = false;       ///< whether z or the integrand jump, at an event without a kink
  bool is_touched = false;    ///< whether they jump where the guard is hardly more than touched
};

/// Keeps each step within one mode of the equations: the set of outcomes of their switches, which
/// are the places where formulas have a kink or a jump (is_below()); doc/theory.md (17d). The
/// equations hold the mode during a step; where a guard leaves its sign, the step is cut at the
/// first such instant, and the next one begins in the new mode.
///
/// A guard s_k is the difference y - x of its comparison x < y. It is on its side where s_k > 0 and
/// the mode says x < y, or s_k <= 0 and it says x >= y. Without switches nothing is done.
class ModeWatch {
 public:
  explicit ModeWatch(const CompiledSystem& system);

  /// Holds the mode of a consistent state at the beginning of a run. @param equations of the steps;
  /// must hold the design and outlive the run.
  void start(const State<double>& initial, Equations<double>* equations);
  /// The same while a run goes on from a state that was computed with a design or inputs of now:
  /// the equations hold the mode as before, and it is looked at before the next step.
  void restart(Equations<double>* equations);
  /// Whether the equations have switches.
  bool is_active() const { return !mode_.empty(); }
  const std::vector<bool>& mode() const { return mode_; }

  /// After an attempt that passes the error test: repeats it with the size at which the first guard
  /// is zero, located to rounding, if one leaves its side within the attempt; cross() is then due.
  /// @returns false if such an attempt fails: the step is to be repeated with a smaller size.
  bool cut(OneStep<double>* step);
  /// The guard at whose zero the last attempt was cut, -1 if none; and the mode behind it.
  int guard() const { return guard_; }
  const std::vector<bool>& next_mode() const { return next_mode_; }
  /// The rate of that guard along the motion in the mode that is held [per s]; 0 where the guard is
  /// only touched, so that its instant has no derivative. @param at the end of the step, with its
  /// z. @param rates of that state.
  double end_rate(const State<double>& at, const State<double>& rates) {
    along_->hold(mode_);
    const double rate = guard_rate(guard_, at, rates);
    return is_touched(rate) ? 0.0 : rate;
  }
  /// Whether the motion is hardly more than tangent to the guard at which the last attempt was cut.
  /// @param rate end_rate() of it.
  bool grazes(double rate) const { return !(std::abs(rate) > kGrazing * guard_pace_); }
  /// That guard for the log, as one that is only touched, while the mode before it is held.
  EventLog::Entry touch_at(double time, Equations<double>* equations) const;
  /// The switches of the mode whose guards are zero at a state, but for rounding.
  void find_zeros(const State<double>& at, Equations<double>* equations, std::vector<int>* zeros);
  /// Whether the motion jumps behind a guard that is zero at a state.
  bool jumps_beyond(int k, const State<double>& at, Assembly* assembly,
                    Equations<double>* equations);
  /// Whether the mode must be looked at before the next step.
  bool is_due() const { return is_due_; }
  /// After a step was accepted: whether it touched a guard without passing it, behind which the
  /// motion would jump. @param entry of the log, without an event.
  bool has_touched(Assembly* assembly, Equations<double>* equations, EventLog::Entry* entry);
  /// kNonFinite with its place, if the last cut() failed because a guard is no number.
  Status undefined_guard(double t) const;
  /// After an instant at which inputs jumped or the design changed: the mode is looked at.
  void look_again() { is_due_ = is_active(); }

  /// Changes the mode at `state`, the end of the last step, whose z is solved for again.
  /// @param equations of the steps. @param change what happened; nothing if both modes are equal.
  /// @returns kSwitchHolds where the motion after the change leads back at once, or a status of
  /// RateSolution::solve().
  Status cross(const State<double>& state, Assembly* assembly, Equations<double>* equations,
               ModeChange* change);

 private:
  /// What of a guard counts as zero, relative to its largest value and to the sizes of x and y.
  static constexpr double kRounding = 1e-10, kCancelled = 1e-13;
  /// How far beyond the end of a step, in parts of it, its dense output is used.
  static constexpr double kBeyond = 1e-3;
  static constexpr double kTouched = 1e-6;  ///< share of its pace below which a guard is touched
  /// A guard is only touched where its rate is at most this share of its range over the attempt
  /// per second: as sharp as its sign is known within kRounding.
  static constexpr double kGrazing = 1e-4;
  /// An attempt of at most so many smallest steps is accepted although it crosses a kink again.
  static constexpr double kShortest = 1e4;
  /// Points at which guards are evaluated after the start of a step: at least so many, and so many
  /// in the duration of the study; more where show_turns() asks for them.
  static constexpr int kLeastPoints = 5, kPointsPerStudy = 1024;

  struct Crossing {
    int guard = -1;
    double from = 0.0, to = 1.0;  ///< in parts of the step: on its side, and beyond it
  };
  /// s_k, positive on the side of the mode.
  double side(int k, const VectorX<double>& guards) const {
    return mode_[to_index(k)] ? guards[k] : -guards[k];
  }
  double side_at(int k, double theta, OneStep<double>* step);
  /// Whether a value of side() has left its side by more than what rounding makes of the guard,
  /// which may stay at zero: a bristle at rest.
  bool has_left(int k, double value) const { return value < -sizes_[k]; }
  /// Evaluates the guards along the attempt. False if one turns round too often to be followed.
  bool sample(OneStep<double>* step);
  void sample_at(int points, OneStep<double>* step);
  bool is_resolved() const;
  /// A guard at the points of the attempt.
  auto along(int k) const { return samples_.row(k).head(points_ + 1); }
  Crossing first_crossing(OneStep<double>* step);
  bool is_undefined_before(const Crossing& crossing);
  Crossing crossing_of(int k, OneStep<double>* step);
  Crossing crossing_at_end(OneStep<double>* step);
  double locate(const Crossing& crossing, OneStep<double>* step);
  bool repeat(int guard, double h, OneStep<double>* step);
  /// The range of the guard from the start of the attempt to its zero, per second.
  double pace_before(const Crossing& crossing) const;
  State<double> rates_of(const State<double>& at) const;
  double guard_rate(int k, const State<double>& at, const State<double>& rates);
  /// Whether nothing jumps at a switch of the mode, whatever its guard is: a kink by its form.
  bool is_kink(int k, Equations<double>* equations) const;
  /// Whether the attempt crosses a kink at its very beginning, where the mode was just changed: it
  /// is too long to follow the guard.
  bool returns_to_kink(const Crossing& crossing, OneStep<double>* step) const;
  bool is_touched(double rate) const { return !(std::abs(rate) > kTouched * guard_pace_); }
  void look_for_touch(int k, double place, double value, OneStep<double>* step);
  /// The switch that the change of the mode concerns, of the mode before it; -1: none.
  int changed_switch(int guard, const std::vector<bool>& mode) const;
  Status count_return(double t);
  bool has_jump(const ModeChange& change) const;
  std::vector<bool> beyond(int guard) const;
  std::vector<bool> mode_beyond(const Crossing& crossing, OneStep<double>* step);
  std::vector<bool> mode_of_one(const Crossing& crossing, OneStep<double>* step);
  /// Only this guard is beyond zero; those after it are as they are at a state.
  std::vector<bool> beyond_alone(int guard, const State<double>& at, Equations<double>* equations);
  bool is_alone(int guard) const;
  Status enter(Assembly* assembly, Equations<double>* equations, ModeChange* change);
  int jumped_guard(const ModeChange& change, Equations<double>* equations);
  int left_guard(const ModeChange& change, Equations<double>* equations);
  std::vector<bool> mode_behind(const State<double>& at, const State<double>& rates,
                                Equations<double>* equations) const;

  const CompiledSystem& system_;
  std::vector<bool> mode_, next_mode_;
  bool is_due_ = false;
  int guard_ = -1;      ///< that cut the last step
  int undefined_ = -1;  ///< a guard that is NaN in the last attempt
  const SwitchOrigin *held_at_ = nullptr, *undefined_at_ = nullptr;
  int returns_ = 0;            ///< changes in turn without a step between them
  double last_change_ = -1.0;  ///< [s]
  double guard_pace_ = 0.0;    ///< pace_before() of the attempt that it cut
  double step_size_ = 0.0;     ///< of the last attempt before it was cut [s]
  VectorX<double> sizes_;      ///< of what counts as zero of each guard
  Crossing touch_;             ///< the first guard that the attempt touches; guard -1: none
  State<double> point_, touched_;
  VectorX<double> residual_, right_, ahead_;
  int points_ = kLeastPoints;                   ///< of the last attempt
  Eigen::MatrixXd samples_;                     ///< a column of guards per point, and room for more
  std::unique_ptr<Equations<Lanes<4>>> along_;  ///< the first lane is the direction of the motion
  State<Lanes<4>> moving_;
};

}  // namespace codesign
