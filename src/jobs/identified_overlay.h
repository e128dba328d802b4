// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOBS_IDENTIFIED_OVERLAY_H_
#define MECHANISM_CODESIGN_JOBS_IDENTIFIED_OVERLAY_H_

#include <string>

#include "identification/identification_result.h"
#include "mechanism_codesign/problem.h"

namespace codesign {

/// identified_overlay.urdf, doc/study.md: sets every parameter of the model to the value of the fit, with intervals as comments. Merged
/// after the problem's own overlays it makes the model identified.urdf. Numbers that are not of the model stand in a comment at the end, as
/// the study takes them.
/// @param result that has a point
std::string identified_overlay(const Problem& problem, const IdentificationResult& result);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOBS_IDENTIFIED_OVERLAY_H_
