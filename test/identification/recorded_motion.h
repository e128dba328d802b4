// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <cmath>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "assembly/assembly.h"
#include "assembly/make_system.h"
#include "equations/formulas.h"
#include "identification/effort/effort_model.h"
#include "integration/rosenbrock_integrator.h"
#include "math/arrays.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// A simulated motion as an ideal rig would record it, at the ends of the integrator's steps:
/// accelerations and efforts are those of the equations at the very positions and velocities.
struct RecordedMotion {
  MotionSamples motion;
  Eigen::MatrixXd efforts;  ///< of the controllers, joints x samples [N m or N]
};

int joint_index(const RobotDescription& robot, const std::string& name);

RecordedMotion record_motion(const CompiledSystem& system, const std::vector<std::string>& joints,
                             int samples, double largest_step);

std::shared_ptr<const CompiledSystem> compiled(const std::string& urdf, const std::string& study);

std::vector<MeasuredJoint> measured(const std::vector<std::string>& with_effort,
                                    const std::vector<std::string>& without = {});

/// Sinusoidal motions of the joints at samples 0.01 s apart, with their exact derivatives.
MotionSamples swing(int samples, double amplitude, double offset = 0.0, int joints = 1);

}  // namespace codesign
