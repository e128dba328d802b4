// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/IdentifyGoal.h>
#include <mechanism_codesign/IdentifyResult.h>

#include <atomic>
#include <string>

#include "ros/identification_feedback.h"
#include "ros/job.h"

namespace codesign {

/// The result of an identification, and the identified model.
struct IdentificationOutcome {
  mechanism_codesign::IdentifyResult result;
  std::string identified_urdf;  ///< empty if nothing was fitted
};

/// Reads the recordings of the study, fits, and writes report, identified model, residuals and bag beside each other. Bad input, numerical
/// failures and a full disk are returned as code and message of the result; a file that cannot be written costs that file alone.
/// No ROS master is needed, and it does not throw.
/// @param folder base of relative paths of recordings; empty: only absolute paths are accepted.
/// @param cancel once set, the fit ends with its best point so far, whose files are written.
IdentificationOutcome run_identification(const Problem& problem, const std::string& folder, const mechanism_codesign::IdentifyGoal& request,
                                         const JobOptions& options, const IdentificationObserver& observer,
                                         const std::atomic<bool>& cancel);

}  // namespace codesign
