// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "mechanism_codesign/error.h"

namespace codesign {

/// The integrator of the equations of motion: Rosenbrock-Wanner methods, theory (15), or IDAS,
/// theory (25). Each has its own computation of sensitivities, (18) and (27).
enum class IntegratorKind { kRosenbrock, kIdas };
/// The Rosenbrock-Wanner method; the table in theory (15) lists stages, order and source.
enum class RosenbrockMethod { kRodas4, kRodas4P2, kRodas5P, kDopri5, kAuto };
/// The method for the gradient of the objective; with the Rosenbrock integrator only, IDAS always
/// integrates sensitivities.
enum class GradientMethod {
  kAuto,     ///< the method below with the smaller estimated cost
  kDirect,   ///< the tangent of every step, forward; theory (18)
  kAdjoint,  ///< the discrete adjoint of the stored steps, backward; theory (18a)
};

/// The coordinates of the equations of motion; doc/theory.md (56).
enum class CoordinatesKind {
  kAuto,     ///< kJoint where it is possible
  kJoint,    ///< joint coordinates along the tree, constraint rows for the loops
  kAbsolute  ///< centre of mass and Euler parameters of every body, constraint rows for every joint
};

/// The spelling of each enumerator in study files, in the order of the enumerators.
constexpr std::array<const char*, 2> kIntegratorNames{"rosenbrock", "idas"};
constexpr std::array kRosenbrockMethodNames{"rodas4", "rodas4p2", "rodas5p", "dopri5", "auto"};
constexpr std::array<const char*, 3> kGradientMethodNames{"auto", "direct", "adjoint"};
constexpr std::array<const char*, 3> kCoordinatesNames{"auto", "joint", "absolute"};

/// The block `solver:` of a study; doc/study.md describes it.
struct SolverOptions {
  IntegratorKind integrator = IntegratorKind::kRosenbrock;
  CoordinatesKind coordinates = CoordinatesKind::kAuto;
  SourceLocation coordinates_where;                   ///< of the key `coordinates`, for messages
  RosenbrockMethod method = RosenbrockMethod::kAuto;  ///< kRosenbrock only
  double relative_tolerance = 1e-6;                   ///< rtol of the error test, theory (15)
  double absolute_tolerance = 1e-7;  ///< atol of the error test, in the units of q, v and s
  GradientMethod gradient = GradientMethod::kAuto;  ///< kRosenbrock only
  /// kRosenbrock only: relative tolerance of the sensitivities in the error test of a run with
  /// gradient, theory (18f); 0: chosen by relative_tolerance.
  double sensitivity_tolerance = 0.0;
  double initial_step = 0.0;   ///< [s]; 0: chosen automatically
  double maximum_step = 0.0;   ///< [s]; 0: no limit
  int maximum_steps = 200000;  ///< a run that needs more fails
  /// a run fails when a body moves faster [m/s] or turns faster [rad/s]; 0: chosen by MotionWatch
  double maximum_speed = 0.0;
  /// largest closure error of a loop at the start [m and rad]; theory (19)
  double closure_tolerance = 1e-3;
};

}  // namespace codesign
