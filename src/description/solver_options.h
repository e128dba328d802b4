// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DESCRIPTION_SOLVER_OPTIONS_H_
#define MECHANISM_CODESIGN_DESCRIPTION_SOLVER_OPTIONS_H_

#include <array>

namespace codesign {

/// The integrator of the equations of motion: Rosenbrock, theory (15), or IDAS, theory (25). Each computes direct sensitivities in its own
/// way.
enum class IntegratorKind { kRosenbrock, kIdas };
/// The Rosenbrock-Wanner method, doc/theory.md (15).
enum class RosenbrockMethod { kRodas4, kRodas4P2, kRodas5P };
/// How the gradient of the objective is computed with the Rosenbrock integrator.
enum class GradientMethod {
  kAuto,     ///< the cheaper of the two, by an estimate of the costs
  kDirect,   ///< the tangent of every step, forward; theory (18)
  kAdjoint,  ///< the discrete adjoint of the stored steps, backward; theory (18a)
};

/// The spelling of each enumerator in study files, in the order of the enumerators.
constexpr std::array<const char*, 2> kIntegratorNames{"rosenbrock", "idas"};
constexpr std::array<const char*, 3> kRosenbrockMethodNames{"rodas4", "rodas4p2", "rodas5p"};
constexpr std::array<const char*, 3> kGradientMethodNames{"auto", "direct", "adjoint"};

/// The block `solver:` of a study.
struct SolverOptions {
  IntegratorKind integrator = IntegratorKind::kRosenbrock;
  RosenbrockMethod method = RosenbrockMethod::kRodas4;  ///< kRosenbrock only
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-7;
  GradientMethod gradient = GradientMethod::kAuto;  ///< kRosenbrock only
  /// kRosenbrock only: relative tolerance of each parameter's sensitivities; 0: they do not take part in the error test.
  double sensitivity_tolerance = 0.0;
  double initial_step = 0.0;  ///< [s]; 0: chosen automatically
  double maximum_step = 0.0;  ///< [s]; 0: no limit
  int maximum_steps = 200000;
  double maximum_speed = 0.0;       ///< bound of every body's speed [m/s] and [rad/s]; 0: chosen automatically, see MotionWatch
  double closure_tolerance = 1e-3;  ///< largest closure error of a loop at the start [m and rad]; theory (19)
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DESCRIPTION_SOLVER_OPTIONS_H_
