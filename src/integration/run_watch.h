// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

template <class T>
class OneStep;

/// Kinetic energy of the bodies and potential energy of gravity [J], the latter zero if every
/// centre of mass is at the ground's origin.
struct BodyEnergy {
  double kinetic = 0.0, potential = 0.0;
  double total() const { return kinetic + potential; }
};

/// Speed of a centre of mass [m/s] and angular speed [rad/s].
struct BodySpeed {
  double linear = 0.0, angular = 0.0;
};

/// Energy of the bodies and applied power from the bodies' motion alone, doc/theory.md (17a): no
/// force law is evaluated. Not thread-safe, although const.
class BodyMotion {
 public:
  explicit BodyMotion(const CompiledSystem& system);

  /// @param equations hold the design.
  void set_design(const Equations<double>& equations);
  BodyEnergy energy(const VectorX<double>& q, const VectorX<double>& v) const;
  /// W' of (17a), v^T M a - sum of m g . r' [W]: the power of all forces but gravity, if the motion
  /// satisfies the constraints.
  /// @param z of the state, or its first n entries, the accelerations.
  double power(const VectorX<double>& q, const VectorX<double>& v, In<double> z) const;

  /// Distance of a centre of mass from the ground's origin [m]; with a forest after move() only.
  double distance(int body, const VectorX<double>& q) const;
  /// Speed of a body's centre of mass [m/s] and its angular speed [rad/s]; with a forest after
  /// move() only.
  BodySpeed speed(int body, const VectorX<double>& v) const;
  /// Computes the motion of the bodies of a forest, which distance() and speed() read.
  void move(const VectorX<double>& q, const VectorX<double>& v) const;

 private:
  struct Body {
    double mass = 0.0;
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  };
  /// body_energies() at a state, of which at_ has q and v.
  struct Measured {
    explicit Measured(const CompiledSystem& system);

    CompiledEquations<double> equations;
    State<double> at;
    VectorX<double> energies, bodies;
    bool is_known = false;  ///< whether the results belong to `at` and the design
  };
  void measure(const VectorX<double>& q, const VectorX<double>& v, In<double> a) const;
  /// Entry `first` of a body's numbers in Measured::bodies and the next two.
  Eigen::Vector3d of_body(int body, int first) const {
    return measured_->bodies.segment<3>(9 * body + first);
  }

  Eigen::Vector3d gravity_;
  std::vector<Body> bodies_;
  const std::unique_ptr<Measured> measured_;  ///< with a forest only
};

/// Work of all forces but gravity over one step, by Simpson's rule with the method's dense output
/// in the middle of the step.
class StepWork {
 public:
  explicit StepWork(const CompiledSystem& system) { middle_.resize(system.layout()); }

  void start(const State<double>& state, const BodyMotion& motion);
  /// Work [J] over the last accepted step. Must be called once for each accepted step: the power at
  /// its end is kept for the next one.
  double over(const OneStep<double>& step, const BodyMotion& motion);
  /// The same step, after over(), by Gauss's formula of five points on each half. Simpson's rule is
  /// exact for cubic powers only: a step under a force that is a polynomial of the time, say, has
  /// no error and becomes as long as the run.
  double refined(const OneStep<double>& step, const BodyMotion& motion);

 private:
  State<double> middle_;  ///< within the step
  double power_ = 0.0;    ///< at the end of the last step [W]
};

/// Limits of a measure of a run's accuracy: beyond `warning` the run warns, beyond `failure` it
/// fails.
struct RunLimit {
  double warning = 0.0, failure = 0.0;
};

/// Limits of Statistics::constraint_drift, doc/theory.md (17a): next to a singular position an
/// accurate step may drift by up to 1/sqrt(relative_tolerance).
RunLimit drift_limit(double relative_tolerance);
/// Limits of Statistics::energy_error, doc/theory.md (17a). Accurate runs stay within a hundred
/// times the relative tolerance.
RunLimit energy_limit(double relative_tolerance);

/// Checks after each step the drift off the constraints and the energy balance, doc/theory.md
/// (17a). No allocation in check().
class RunWatch {
 public:
  explicit RunWatch(const CompiledSystem& system);

  /// @param equations must hold the design. @param initial its initial state.
  void start(const Equations<double>& equations, const State<double>& initial);
  /// Continues after an instant at which design or inputs jump; the energy that the jump adds or
  /// removes does not count as an error. The balance of what came before is closed, unless it is so
  /// short that it could not fail.
  void go_on(const Equations<double>& equations, const State<double>& state);
  /// Says where the run ends [s], in place of the study's duration. An energy error there fails at
  /// once.
  void end_at(double time) { end_ = time; }
  const BodyMotion& motion() const { return motion_; }

  /// The drift d of (17a) [-]: the largest projection correction of a coordinate or velocity over
  /// its error tolerance.
  /// @param position_correction, velocity_correction delta q and delta v of (17) in the first n
  /// entries.
  double drift(const State<double>& state, const VectorX<double>& position_correction,
               const VectorX<double>& velocity_correction) const;

  /// To be called after each step, with its end. @param drift of the step, from drift(). @param
  /// work of all forces but gravity over the step [J]. @param statistics receives the largest drift
  /// and energy error so far. @returns kConstraintDrift, kEnergyError or ok.
  Status check(const State<double>& state, double drift, double work, Statistics* statistics);
  /// The same. @param energy at the state.
  Status check(const State<double>& state, const BodyEnergy& energy, double drift, double work,
               Statistics* statistics);
  /// Whether `work` leaves a change of the energy over the step open that counts in the limits, so
  /// that it should be computed more exactly before check(). @param energy at its end.
  bool doubts(const BodyEnergy& energy, double work) const;

  /// `constraint_drift` and `energy_error`, if the run so far exceeds their limits.
  Warnings warnings(const Statistics& statistics) const;

 private:
  double smallest_scale(const Constants<double>& constants, const State<double>& initial) const;
  void note_reach(const VectorX<double>& change, const VectorX<double>& of);
  /// Begins to balance the energy, at a state whose energy is given.
  void begin_balance(const State<double>& state, const BodyEnergy& energy);
  /// Keeps the error of the balance so far and begins another one.
  void close_balance(const State<double>& state, const BodyEnergy& energy);
  double balance_error() const { return scale_ > 0.0 ? reach_ * worst_error_ / scale_ : 0.0; }

  const CompiledSystem& system_;
  const SolverOptions& options_;
  const RunLimit drift_limit_, energy_limit_;
  BodyMotion motion_;
  double end_ = 0.0;                                     ///< of the run [s]
  double balance_begin_ = 0.0;                           ///< [s]
  int balanced_steps_ = 0;                               ///< since then
  double smallest_scale_ = 0.0;                          ///< [J]
  double closed_error_ = 0.0, closed_error_time_ = 0.0;  ///< largest error of closed balances; [s]
  double start_potential_ = 0.0, start_energy_ = 0.0;    ///< [J]
  double potential_ = 0.0;                               ///< at the last step [J]
  double imbalance_ = 0.0;  ///< energy not explained by work, at the last step [J]
  double work_ = 0.0, turnover_ = 0.0, scale_ = 0.0, worst_error_ = 0.0;  ///< [J]
  double worst_drift_time_ = 0.0, worst_error_time_ = 0.0;                ///< [s]
  VectorX<double> start_q_, moved_;  ///< q where the balance begins, and what it has changed by
  /// r of (17a), at most 1: how far the motion has come, relative to what its tolerances resolve
  double reach_ = 0.0;
  int unbalanced_steps_ = 0;  ///< consecutive steps with an energy error above RunLimit::failure
};

}  // namespace codesign
