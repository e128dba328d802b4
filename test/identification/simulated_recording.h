// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "description/study.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// The study's run with some parameters at other values, as sensors without errors record it:
/// positions and efforts at equal steps.
JointRecording record_run(const Problem& problem, const std::map<std::string, double>& truth,
                          const std::vector<std::string>& joints, double rate);

}  // namespace codesign
