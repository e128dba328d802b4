// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DESCRIPTION_SOLVER_OPTIONS_H_
#define MECHANISM_CODESIGN_DESCRIPTION_SOLVER_OPTIONS_H_

#include <array>

namespace codesign {

/// Which integrator steps the equations of motion. Each has direct sensitivities of its own.
enum class IntegratorKind { kRosenbrock, kIdas };
/// The Rosenbrock-Wanner method, doc/theory.md (15).
enum class RosenbrockMethod { kRodas4, kRodas4P2, kRodas5P };
/// How the gradient of the objective is computed with the Rosenbrock integrator.
enum class GradientMethod {
  kAuto,     ///< the cheaper of the two, by an estimate
  kDirect,   ///< tangents of every step by the parameters, forward
  kAdjoint,  ///< the discrete adjoint of the stored steps, backward
};

/// The spelling of each enumerator in study files, in the order of the enumerators.
constexpr std::array<const char*, 2> kIntegratorNames{"rosenbrock", "idas"};
constexpr std::array<const char*, 3> kRosenbrockMethodNames{"rodas4", "rodas4p2", "rodas5p"};
constexpr std::array<const char*, 3> kGradientMethodNames{"auto", "direct", "adjoint"};

/// The block `solver:` of a study.
struct SolverOptions {
  IntegratorKind integrator = IntegratorKind::kRosenbrock;
  RosenbrockMethod method = RosenbrockMethod::kRodas4;  ///< of the Rosenbrock integrator
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-7;
  GradientMethod gradient = GradientMethod::kAuto;  ///< of the Rosenbrock integrator
  double sensitivity_tolerance = 0.0;  ///< rosenbrock: relative, of each parameter's sensitivities; 0: they stay out of the error test
  double initial_step = 0.0;           ///< [s]; 0: chosen
  double maximum_step = 0.0;           ///< [s]; 0: none
  int maximum_steps = 200000;
  double maximum_speed = 0.0;       ///< of any body [m/s] and [rad/s]; 0: chosen, see MotionWatch
  double closure_tolerance = 1e-3;  ///< largest miss of a loop that still counts as closed at the start [m and rad]
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DESCRIPTION_SOLVER_OPTIONS_H_
