// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "identification/identification_result.h"
#include "mechanism_codesign/problem.h"

namespace codesign {

/// identified_overlay.urdf, doc/study.md: sets every parameter of the model to the value of the fit, with intervals as comments. Merged
/// after the problem's own overlays, it turns the model into identified.urdf. Numbers that do not belong to the model are in a comment at
/// the end, in the form in which a study takes them.
/// @param result of a fit with a best point
std::string identified_overlay(const Problem& problem, const IdentificationResult& result);

}  // namespace codesign
