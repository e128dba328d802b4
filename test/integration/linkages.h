// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "integration/mechanisms.h"

namespace codesign {

// Closed linkages with redundant constraints, whose motions are known in closed form.

/// A planar ring of hinges with something more on it, see four_bar().
std::string four_bar_with(const std::string& more);

/// `count` parallelograms side by side: bars of 1 m hang on hinges 1.2 m apart, couplers join their
/// tips. One degree of freedom, 3 `count` constraints too many.
std::string four_bar_row(int count);

/// Bars that swing in parallel carry their couplers along without turning them:
/// ((bars) J + couplers m) theta'' = -g sin theta (bars m/2 + couplers m), J = 0.0834 + 1/4, m = 1,
/// length 1.
double four_bar_row_acceleration(int count, double theta);

/// IFToMM's benchmark A02: `count` parallelograms of uniform bars of 1 m and 1 kg side by side,
/// upright at zero. It passes its flat position, in which every bar could turn by itself.
std::string upright_row(int count);

/// ((bars) / 3 + couplers) theta'' = g sin theta (bars / 2 + couplers)
double upright_row_acceleration(int count, double theta);

/// Bricard's threefold symmetric ring: six hinges, each at right angles to the next, all bars 1 m.
/// It moves though counting says it does not: the turns alternate between theta and phi with cos
/// theta + cos phi + cos theta cos phi = 0 (Chen, You, Tarnai, Int. J. Solids Struct. 42 (2005), at
/// twist pi/2).
std::string bricard();

/// The angle of the even hinges of bricard() for a given angle of the odd ones.
double bricard_partner(double theta);

std::string bricard_start(double theta, double rate);

/// theta(t) of theta'' = f(theta) by Runge and Kutta's fourth-order method in many small steps.
double reference_angle(const std::function<double(double)>& f, double theta, double rate, double t,
                       int steps = 20000);

}  // namespace codesign
