// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/IdentificationProgress.h>
#include <mechanism_codesign/IdentifyGoal.h>
#include <mechanism_codesign/IdentifyResult.h>

#include <string>
#include <vector>

#include "jobs/identification_records.h"

namespace codesign {

/// Contents that only the bag of a node's job has.
struct IdentificationAnswer {
  mechanism_codesign::IdentifyGoal request;
  mechanism_codesign::IdentifyResult result;
  std::vector<mechanism_codesign::IdentificationProgress> progress;
};

/// Writes the bag as `path`.active and renames it when it is complete. Topics: doc/ros_api.md.
///
/// Recorded time starts at 1 s, and header stamps are the same; the recordings follow one another with pauses of half a second. TF frames
/// are `measured/<link>` and `identified/<link>`, both at the origin of `world`, so that the measured robot appears as a ghost of the
/// identified robot.
/// @param answer null for the command line. @throws OutputError if writing fails; no unfinished bag is left.
void write_identification_bag(const std::string& path, const IdentificationShow& show, const IdentificationAnswer* answer);

}  // namespace codesign
