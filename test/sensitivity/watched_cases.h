// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism/signal_catalog.h"
#include "sensitivity/gradient_cases.h"

namespace codesign {

/// Adds watched signals to a case: its default signals, every second one as a peak in the
/// objective, the others within bounds that the test does not use.
GradientCase with_watched(GradientCase test);

}  // namespace codesign
