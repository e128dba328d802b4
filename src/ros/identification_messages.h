// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/IdentifyResult.h>

#include "identification/identification_result.h"
#include "mechanism_codesign/problem.h"

namespace codesign {

/// The message of a result; without job, paths and warnings. @param problem with the request applied.
mechanism_codesign::IdentifyResult identification_message(const Problem& problem, const IdentificationResult& result);

}  // namespace codesign
