// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_PROBLEM_UNUSED_PARAMETERS_H_
#define MECHANISM_CODESIGN_PROBLEM_UNUSED_PARAMETERS_H_

#include "description/study.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// A warning `unused_parameter` for each tuned parameter on which no number of model or study depends.
Warnings unused_parameters(const Study& study);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_PROBLEM_UNUSED_PARAMETERS_H_
