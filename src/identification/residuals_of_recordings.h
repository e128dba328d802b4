// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "identification/effort/driven_system.h"
#include "identification/fit/fit_variables.h"
#include "identification/fit/identification_result.h"
#include "identification/fit/residual_source.h"
#include "mechanism_codesign/problem.h"
#include "mechanism_codesign/warning.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// The residuals of recordings as `identify:` of the study counts them: of efforts, or of motions.
/// Recordings with the same values of parameters have one model.
/// @param joints require_same_joints() of all recordings, which have passed require_same_signals()
/// @param warnings appended to
/// @return null once `cancel` is set. @throws InputError for recordings that do not fit the
/// mechanism
std::unique_ptr<RecordingResiduals> make_residuals(const Problem& problem,
                                                   const FitVariables& variables,
                                                   const std::vector<MeasuredJoint>& joints,
                                                   const std::vector<JointRecording>& recordings,
                                                   const std::atomic<bool>* cancel,
                                                   Warnings* warnings);

/// Recorded and computed outputs. @param residuals rows x outputs of the source
FittedSeries series_of(const RecordingResiduals& source, const Eigen::MatrixXd& residuals);

}  // namespace codesign
