// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "control/control_clock.h"
#include "integration/integrator.h"
#include "integration/watch_layout.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/band_stays.h"

namespace codesign {

/// The value of a watched signal of greatest magnitude: its place among the numbers, and its sign.
struct Peak {
  int place = 0;
  double sign = 1.0;
};
Peak find_peak(const WatchLayout::Entry& entry, const Eigen::VectorXd& values);

/// The places of the largest and the smallest value of a signal.
struct RangePlaces {
  int largest = 0, smallest = 0;
};
RangePlaces find_range(const WatchLayout::Entry& entry, const Eigen::VectorXd& values);

/// A signal's term of the objective, theory (21a), (21e): weight max |signal - reference| or weight
/// measure. @param gradient if not null, its gradient is added to it.
double watched_term(const WatchedSignal& watched, const WatchLayout::Entry& entry,
                    const Extremes& extremes, Eigen::VectorXd* gradient);
/// The sum of the terms of all signals; 0 without any. @param layout of the study.
double watched_terms(const MotionStudy& study, const WatchLayout& layout, const Extremes& extremes,
                     Eigen::VectorXd* gradient);

/// Sets the measure of a signal that is a stroke, a maximum or a minimum from its other numbers.
void set_measure(const WatchedSignal& watched, const WatchLayout::Entry& entry, Extremes* extremes);

/// Finds the numbers of the watched signals, doc/theory.md (21a), while an integration runs: their
/// values at given instants and the largest and smallest values between them, with derivatives by
/// the tuned parameters.
///
/// A signal is a function of the dense output, with accelerations and multipliers solved for where
/// it depends on them. Its slope, which is exact, is computed at several points of each step; where
/// it changes sign, a root finder gives the extremum to rounding. At a smooth extremum the
/// derivative by a parameter equals the derivative at a fixed time, because the slope is zero. At a
/// kink or a jump where a guard is zero the instant moves, and the slope of its side counts,
/// (21d').
class SignalWatch {
 public:
  /// The derivatives of watched signal `k` by the tuned parameters at `state`, a point of the dense
  /// output of the last step.
  /// @param reads_rates whether the signal depends on state->z, which is then solved for.
  using Differentiate = std::function<void(std::size_t k, const State<double>& state,
                                           bool reads_rates, Eigen::VectorXd* gradient)>;

  /// @param system must outlive this.
  explicit SignalWatch(const CompiledSystem& system);

  bool is_empty() const { return curves_.empty(); }
  /// Begins a run: to be called after integrator->start(). @param differentiate empty: without
  /// derivatives.
  Status start(Integrator* integrator, Differentiate differentiate);
  /// Searches the last step of the integrator. @param end_time tau' of (18g), the derivatives of
  /// the time at which a guard has ended that step; empty if none did.
  Status look(const Eigen::VectorXd& end_time = {});
  /// Takes the end of the run for all instants that it has not reached; look() does so if the run
  /// has ended.
  Status end();
  /// The numbers so far. At the end of the study all of them are set.
  const Extremes& extremes() const { return extremes_; }
  /// The slope of each number whose instant moves with a guard [unit of the signal per s]; 0 of all
  /// others.
  const Eigen::VectorXd& slopes() const { return slopes_; }

 private:
  struct Sample {
    double time = 0.0, value = 0.0, slope = 0.0;  ///< [s], [unit of the signal], [per s]
  };
  /// The state of the search for one watched signal.
  struct Curve {
    bool reads_rates = false;  ///< whether the signal depends on accelerations or multipliers
    std::size_t next = 0;      ///< the next instant
    /// slope at the end of the previous step, if that was inside the interval; else 0
    double end_slope = 0.0;
    double end_value = 0.0;  ///< just before the last guard that ended a step
    BandStays band;          ///< only of signals with a band, as `last`
    Sample last;             ///< the last point that was compared with the band
  };

  bool go_to(std::size_t k, double time);
  double value(std::size_t k, double time);
  Sample sample(std::size_t k, double time);
  /// The last step [s]. Slopes are taken by `slack` inside of it.
  struct StepSpan {
    double from, to, slack;
  };
  void take_pieces(std::size_t k, const StepSpan& step, double begin, double end);
  void follow(std::size_t k, double from, double to);
  void search(std::size_t k, const Sample& from, const Sample& to);
  void pass_gap(std::size_t k, const Sample& to);
  void pass(std::size_t k, const Sample& to);
  void finish(std::size_t k, double time);
  void reach_instant(std::size_t k, double time);
  void look_for_jump(std::size_t k, const Sample& before, double behind, bool is_instant);
  void offer(std::size_t k, double time, const Eigen::VectorXd& moves);
  void settle(std::size_t k, const Sample& behind, double slack);
  double differentiate(std::size_t k, const Eigen::VectorXd& moves);
  void set(int place, double time, double number, double slope = 0.0);
  void copy(int from, int to);
  Status failed(std::size_t k, double time) const;

  const CompiledSystem& system_;
  const WatchLayout layout_;
  ControlClock clock_;
  /// whether sampled controllers act, or formulas switch, at the begin and at the end of the last
  /// step
  bool begins_at_jump_ = false, ends_at_jump_ = false;
  Integrator* integrator_ = nullptr;
  Differentiate differentiate_;
  std::vector<Curve> curves_;
  Extremes extremes_;
  double time_ = 0.0;  ///< end of the previous step [s]
  State<double> state_, rates_;
  SparseGradient<double> sparse_;
  Eigen::VectorXd gradient_, slopes_;
  Eigen::VectorXd begin_time_, end_time_;  ///< tau' of both ends of the last step; or empty
  const Eigen::VectorXd fixed_;            ///< empty
  std::vector<double> points_;
  std::vector<Sample> samples_;
  Status status_;
};

}  // namespace codesign
