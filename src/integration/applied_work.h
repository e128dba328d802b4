// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "integration/rosenbrock_step.h"

namespace codesign {

/// Kinetic energy of the bodies and potential energy of gravity [J], the latter zero if every centre of mass is at the ground's origin.
struct BodyEnergy {
  double kinetic = 0.0, potential = 0.0;
  double total() const { return kinetic + potential; }
};

/// Speed of a centre of mass [m/s] and angular speed [rad/s].
struct BodySpeed {
  double linear = 0.0, angular = 0.0;
};

/// Energy of the bodies and applied power from the bodies' motion alone, doc/theory.md (17a): no force law is evaluated. Not thread-safe,
/// although const.
class BodyMotion {
 public:
  explicit BodyMotion(const CompiledSystem& system);

  /// @param equations hold the design.
  void set_design(const Equations<double>& equations);
  BodyEnergy energy(const VectorX<double>& q, const VectorX<double>& v) const;
  /// W' of (17a), v^T M a - sum of m g . r' [W]: the power of all forces but gravity, if the motion satisfies the constraints.
  /// @param z of the state, or its first n entries, the accelerations.
  double power(const VectorX<double>& q, const VectorX<double>& v, In<double> z) const;

  /// Distance of a centre of mass from the ground's origin [m]; with a forest after move() only.
  double distance(int body, const VectorX<double>& q) const;
  /// Speed of a body's centre of mass [m/s] and its angular speed [rad/s]; with a forest after move() only.
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
  Eigen::Vector3d of_body(int body, int first) const { return measured_->bodies.segment<3>(9 * body + first); }

  Eigen::Vector3d gravity_;
  std::vector<Body> bodies_;
  const std::unique_ptr<Measured> measured_;  ///< with a forest only
};

/// Work of all forces but gravity over one step, by Simpson's rule with the method's dense output in the middle of the step.
class StepWork {
 public:
  explicit StepWork(const CompiledSystem& system) { middle_.resize(system.layout()); }

  void start(const State<double>& state, const BodyMotion& motion);
  /// Work [J] over the last accepted step. Must be called once for each accepted step: the power at its end is kept for the next one.
  double over(const RosenbrockStep<double>& step, const BodyMotion& motion);

 private:
  State<double> middle_;  ///< in the middle of the step
  double power_ = 0.0;    ///< at the end of the last step [W]
};

}  // namespace codesign
