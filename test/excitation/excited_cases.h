// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "equations/equations.h"
#include "excitation/excite.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {

/// A bar that swings about a horizontal axis, with viscous and Coulomb friction; its centre is 0.5
/// m from the axis. With an upright axis, gravity does not act on it.
std::string pendulum_urdf(const std::string& axis = "0 1 0", const std::string& other_centre = "");

Problem excited_pendulum(
    const std::string& excite,
    const std::string& more = "parameters: {mass: {}, inertia: {}, viscous: {}, coulomb: {}}",
    const std::string& axis = "0 1 0", const std::string& identify = "");

/// Two bars in a vertical plane.
std::string arm_urdf();

Problem arm(const std::string& excite, const std::string& identify = "",
            const std::string& tuned =
                "upper_inertia, upper_viscous, upper_coulomb, fore_mass, fore_inertia, "
                "fore_viscous, fore_coulomb");

std::string file_text(const std::string& path);

/// The spatial slider-crank, a closed loop, whose crank is moved while the slider has to keep
/// limits of its own.
Problem slider_crank(const std::string& excite);

/// The largest |z| of all limited signals along a path.
double worst_along(const MotionLimits& limits, const DrivePath& path, ExcitedMotion* motion);

}  // namespace codesign
