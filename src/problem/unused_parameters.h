// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/study.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// A warning `unused_parameter` for each tuned and each uncertain parameter on which no number of the model, the study and its runs
/// depends.
Warnings unused_parameters(const Study& study);

}  // namespace codesign
