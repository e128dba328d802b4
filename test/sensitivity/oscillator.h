// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mechanism_codesign/problem.h"

namespace codesign {

/// A mass of 1 kg on a spring: slide/position = amplitude cos(sqrt(k) t), k = 4 and amplitude = 1
/// at the start. @param lines of the study, with its duration. @param amplitude the parameter.
Problem oscillator(const std::string& lines,
                   const std::string& amplitude = "{initial: 1.0, lower: 0.1, upper: 2.0}");

}  // namespace codesign
