// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "linear/linear_model.h"
#include "statics/statics_cases.h"

namespace codesign {

/// Carts of 1 kg on one rail, cart k with the joint `xk`, on cart k - 1 (`carried`) or all on the
/// ground. @param dynamics of each joint.
std::string carts(int count, const std::vector<std::string>& dynamics, bool carried = false);
/// The dynamics of a joint: damping, or a spring with damping.
std::string damped(double c);
std::string sprung(double k, double d = 0.0);

/// A PID of a cart, `servoNUMBER`. @param keys its gains and further keys.
std::string cart_servo(const std::string& keys, const std::string& number = "0",
                       const std::string& input = "position");
/// A study of 10 s without gravity. @param controllers joined by commas.
std::string controlled(const std::string& controllers);

/// linearize_at_rest() with loops; the test fails if it fails.
LinearModel model_of(const std::string& urdf, const std::string& study,
                     const std::vector<std::string>& outputs = {});

/// Compares poles, one of each pair, whatever their order.
void expect_poles(const LinearModel& model, std::vector<std::complex<double>> expected,
                  double tolerance);

}  // namespace codesign
