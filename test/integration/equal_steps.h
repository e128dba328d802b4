// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "integration/one_step.h"

namespace codesign {

/// Assembles a system and takes a span in `count` equal steps.
void take_equal_steps(const CompiledSystem& system, double span, int count, OneStep<double>* step);

}  // namespace codesign
