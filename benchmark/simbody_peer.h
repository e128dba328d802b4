// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

struct SimbodyResult {
  double psi;  ///< objective
  int steps;
};

/// The problem of with_dry_friction(), built from Simbody's own joints (a pin, a ball, a slider)
/// and constraints (a ball and a constant angle), run with Simbody's Runge-Kutta-Merson integrator
/// and projection.
SimbodyResult run_simbody(double crank_length, double rod_length, double Kp, double accuracy);

}  // namespace codesign
