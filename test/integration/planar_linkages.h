// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "integration/mechanisms.h"

namespace codesign {

// Linkages that move in the plane x-z, whose loops can be held in this plane only, theory (23c).

/// The same mechanism, which says that nothing acts out of the plane of its loops.
std::string held_in_plane(const std::string& urdf);

/// A crank of 0.3 m, a rod of 1 m and a block at its end that slides along an oblique line of the
/// ground, by a loop with friction. @param friction elements of the loop
std::string block_on_a_loop(const std::string& friction = "");

const char* slide_friction();

const char* block_start();

/// The coupler of a four-bar in two halves, welded together by the loop.
std::string welded_four_bar();

const char* welded_start();

/// A hanging parallelogram of bars 1 m long and 1.2 m apart, whose coupler hangs beside it: its
/// centre is `centre` along the normal y from the left pin, and the right pin `pin`.
std::string offset_four_bar(double centre, double pin);

}  // namespace codesign
