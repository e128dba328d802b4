// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_APPLIED_WORK_H_
#define MECHANISM_CODESIGN_INTEGRATION_APPLIED_WORK_H_

#include "integration/rosenbrock_step.h"

namespace codesign {

/// Kinetic energy and potential energy of gravity [J], zero where every centre of mass is at the ground's origin.
struct BodyEnergy {
  double kinetic = 0.0, potential = 0.0;
  double total() const { return kinetic + potential; }
};

/// What the bodies' motion says of energy, whatever acts on them; doc/theory.md (17a). Inexpensive: no law of force is evaluated.
class BodyMotion {
 public:
  explicit BodyMotion(const CompiledSystem& system);

  void set_design(const Constants<double>& constants);
  BodyEnergy energy(const VectorX<double>& q, const VectorX<double>& v) const;
  /// v^T M a - weight . v [W]: the power of everything but gravity, in a motion that satisfies the constraints.
  double power(const VectorX<double>& q, const VectorX<double>& v, const double* a) const;

 private:
  struct Body {
    double mass = 0.0;
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  };
  Eigen::Vector3d gravity_;
  std::vector<Body> bodies_;
};

/// Work that everything but gravity does over one Rosenbrock step: Simpson's rule, with the method's dense output in the middle.
class StepWork {
 public:
  StepWork(const CompiledSystem& system, const RosenbrockTableau& tableau);

  void start(const State<double>& state, const BodyMotion& motion);
  /// [J] over the last step that was taken. Each step must be asked for.
  double over(const RosenbrockStep<double>& step, const BodyMotion& motion);

 private:
  RosenbrockTableau::Row middle_{};  ///< y(1/2) = y_0 + sum of middle_j u_j
  double power_ = 0.0;               ///< at the end of the last step [W]
  VectorX<double> q_, v_, a_;        ///< in the middle
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_APPLIED_WORK_H_
