// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_BENCHMARK_SLIDER_CRANK_H_
#define MECHANISM_CODESIGN_BENCHMARK_SLIDER_CRANK_H_

#include <optional>
#include <string>

#include "problem/load_problem.h"

namespace codesign {

/// The shipped case slider_crank_haug, on which solvers are compared: urdf/slider_crank_haug.urdf and config/slider_crank_haug.yaml below
/// the current folder, as the files stand.
Problem load_slider_crank();

/// A solver of the library by the name used in the tables: a Rosenbrock method, kControlled for rodas5p with the sensitivities in its error
/// test, or "idas".
/// @return the same problem with this solver; nothing if the library has no such solver.
std::optional<Problem> with_solver(const Problem& problem, const std::string& name, double relative_tolerance);

constexpr const char* kControlled = "rodas5p, controlled";

/// The same problem with three more parameters, the masses, and the first `tuned` of all eight tuned.
Problem with_tuned(const Problem& problem, int tuned);

/// The dry friction of the slider [N] in with_dry_friction(): 0.3 of the weight of slider and half the rod, about.
constexpr double kDryFriction = 6.5;

/// The same problem with a friction that does not depend on reactions, kDryFriction times tanh(4 v / 0.01 m/s), and three parameters:
/// crank_length, rod_length, Kp.
Problem with_dry_friction(const Problem& problem);

// What an independent implementation found at tolerances down to 1e-12, by complex step and Richardson differences: psi to 1e-12, the
// gradient by crank_length, rod_length, slider_length, slider_width, Kp to the last digit.
constexpr double kReferencePsi = 0.717975196477;
constexpr double kReferenceGradient[5] = {32.0105032, -15.462857, -0.0754624, -0.3394216, -1.0274846};
/// psi at the optimum 0.06, 0.4, 0.06, 0.03, 5 with the constraint.
constexpr double kReferenceOptimum = 0.0212131;

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_BENCHMARK_SLIDER_CRANK_H_
