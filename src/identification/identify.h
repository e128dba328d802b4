// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "identification/fit/identification_result.h"
#include "identification/fit/residual_fit.h"
#include "mechanism_codesign/problem.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// @throws InputError if the study of the problem has no block `identify`, as evaluate_model()
/// needs.
void require_recordings_named(const Problem& problem);

/// @throws InputError if it has none, or has nothing to identify.
void require_identification(const Problem& problem);

/// Fits the tuned parameters and the numbers of effort sensors to recordings, with their
/// uncertainties; doc/theory.md (28)-(43). The holdout only serves to judge the fit; it is never
/// fitted.
/// @param problem with a block `identify` in its study. @param recordings as load_recordings()
/// returns them.
/// @param observer called after each evaluation; false ends the fit. @param cancel the fit ends
/// soon after it is set, from any thread; null: never
/// @throws InputError for recordings that do not fit the mechanism
IdentificationResult identify(const Problem& problem, const StudyRecordings& recordings,
                              const FitObserver& observer, const std::atomic<bool>* cancel);

/// Judges the model as it stands: the residuals of data and holdout at the start of the study, with
/// the doubts about them. Nothing is fitted but, with residuals in motion, the states with which
/// segments begin. The result has outputs and series without numbers; its status is that of the
/// computation, however little the model explains.
/// @param recordings data, holdout or both. The other parameters and exceptions are those of
/// identify().
IdentificationResult evaluate_model(const Problem& problem, const StudyRecordings& recordings,
                                    const std::atomic<bool>* cancel);

}  // namespace codesign
