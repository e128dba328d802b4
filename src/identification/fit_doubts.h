// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <vector>

#include "description/identification.h"
#include "identification/effort/effort_doubts.h"
#include "identification/fit/identification_result.h"
#include "mechanism_codesign/problem.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// unexplained_outputs() with the doubts about the recordings that were judged: efforts or motions
/// that are not explained, and recordings that contradict the model as it stands although the fit
/// explains them. @param cancel once set, without the latter
Warnings doubts_about(const Problem& problem, const std::vector<JointRecording>& recordings,
                      const IdentificationResult& result, const std::atomic<bool>* cancel,
                      Status* failure);

/// Warnings `effort_not_explained` or `motion_not_explained` for the outputs of which the fit
/// explains less than half; `recording_effort` for the other doubts about a unit, and for those
/// whose mended mistake explains clearly more than the fit. @param doubts about the recordings as
/// the model stands. @param failure set if the fit explains less than a tenth of an output, or if a
/// mistake in the recording explains more
Warnings unexplained_outputs(const IdentificationDescription& options,
                             const IdentificationResult& result,
                             const std::vector<EffortDoubt>& doubts, Status* failure);

/// Warnings about the result: `holdout_failed` first, `max_evaluations_reached`, `fit_hindered`,
/// `identified_on_bound`, `correlated_residuals`, `delay_in_noise`.
Warnings warnings_of(const IdentificationDescription& options, const IdentificationResult& result);

}  // namespace codesign
