// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "problem/load_problem.h"

namespace codesign {

/// The shipped case slider_crank_haug, on which solvers are compared: urdf/slider_crank_haug.urdf
/// and config/slider_crank_haug.yaml below the current folder, unchanged.
Problem load_slider_crank();

/// The same problem with another solver. @param name as in the tables: a Rosenbrock method,
/// kControlled, or "idas".
/// @return no value if the library has no such solver.
std::optional<Problem> with_solver(const Problem& problem, const std::string& name,
                                   double relative_tolerance);

/// rodas5p with the sensitivities in the error test.
constexpr const char* kControlled = "rodas5p, controlled";

/// The same problem with three more parameters, the masses, and the first `tuned` of all eight
/// tuned.
Problem with_tuned(const Problem& problem, int tuned);

/// The same problem with uncertain masses of rod and slider. @param samples of them; 1: the nominal
/// ones. @param engine the block `engine`.
Problem with_uncertain_masses(const Problem& problem, int samples, const std::string& engine);

/// The dry friction of the slider in with_dry_friction() [N]: about 0.3 times the weight of the
/// slider and half the rod.
constexpr double kDryFriction = 6.5;

/// The same problem with a friction force that does not depend on reactions, kDryFriction * tanh(4
/// v / (0.01 m/s)), and three parameters: crank_length, rod_length, Kp.
Problem with_dry_friction(const Problem& problem);

// Reference values from an independent implementation at tolerances down to 1e-12, with a complex
// step and Richardson differences: psi to 1e-12; the gradient by crank_length, rod_length,
// slider_length, slider_width, Kp to the last digit given.
constexpr double kReferencePsi = 0.717975196477;
constexpr double kReferenceGradient[5] = {32.0105032, -15.462857, -0.0754624, -0.3394216,
                                          -1.0274846};
/// psi at the optimum of the problem with its parameter constraint, rho = (0.06, 0.4, 0.06, 0.03,
/// 5).
constexpr double kReferenceOptimum = 0.0212131;

}  // namespace codesign
