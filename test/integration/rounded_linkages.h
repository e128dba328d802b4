// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "text/number_text.h"

namespace codesign::rounded {

// Closed linkages with redundant rows, angles rounded by some 1e-5 rad and lengths by some 1e-5 m,
// in a frame tilted against all axes, and with friction in a hinge whose reaction the redundant
// rows leave open.

std::string link(const std::string& name, double length);

std::string hinge(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& origin, bool with_friction = false);

std::string closure(const std::string& name, const std::string& predecessor, const std::string& at,
                    const std::string& successor, const std::string& there);

std::string robot(const std::string& content);

std::string four_bar(const std::string& suffix, const std::string& height,
                     const std::string& missed_height, const std::string& rounding);

/// Two four-bars without a common coordinate.
std::string two_four_bars();
const char* two_four_bars_start();

/// A bar on three cranks of one length. It lies flat 0.34 s after the start below.
std::string three_cranks();
const char* three_cranks_start();

/// Bennett's ring: bars of 0.3 m and 0.3 sin 0.9 / sin 0.5 m, twisted by 0.5 and 0.9 rad, to six
/// digits.
std::string bennett();
const char* bennett_start();

/// A platform on two arms. One arm is a pair of parallelograms that keep the platform level: three
/// degrees less than its joints have.
std::string parallel_arms();
const char* parallel_arms_start();

std::string study(const std::string& start, const std::string& signal, double duration,
                  double tolerance, const std::string& integrator = "rosenbrock");

}  // namespace codesign::rounded
