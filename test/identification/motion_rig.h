// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// A pendulum whose inertia, damping and dry friction are parameters.
std::string motion_pendulum();

/// The blocks of a study that drive the pendulum.
std::string motion_servo();

/// The recording of `joint` on a rig in a run of `study`, at `rate` samples per second, with normal
/// noise on positions and velocities.
struct MotionRig {
  double duration = 6.0, rate = 100.0, noise = 0.0;
  bool with_velocity = false, with_effort = true;
  double begin = 0.0;  ///< of the clock of the recording [s]

  /// @param changes values of parameters that differ from the model
  JointRecording record(const Problem& problem, const std::string& joint,
                        const std::vector<double>& parameters) const;
};

/// A problem of the pendulum that identifies in motion. @param blocks of the study beside
/// `identify` and `parameters`
Problem motion_problem(const std::string& blocks, const std::string& identify,
                       const std::string& parameters);

/// The recording of a pendulum with other parameters than the model's: inertia 0.2, viscous 0.3,
/// dry 0.5.
JointRecording record_pendulum(const MotionRig& rig);

}  // namespace codesign
