// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/sampled_function.h"

namespace codesign {

/// The recorded effort of one joint; outside the recording its first and last values hold.
using RecordedEffort = SampledFunction;

/// The effort sensor of a joint, often a motor current. From the effort tau on the child it records the number r(t + delay) = (tau(t) +
/// offset) / scale; doc/theory.md (28c).
struct EffortSensor {
  double scale = 1.0;        ///< N m (or N) per unit of the recorded number: the torque constant, gear included
  double offset = 0.0;       ///< recorded in addition to the effort that the mechanism needs [N m or N]
  double delay = 0.0;        ///< delay of the recorded effort relative to the recorded motion [s]; negative: the effort is early
  double start_scale = 1.0;  ///< scale at the start of the identification; it gives residuals their unit
};

/// The residual of one joint at one instant and its derivatives.
struct EffortResidual {
  double value = 0.0;      ///< start_scale ((tau + offset) / scale - r(t + delay)) [N m or N]
  double by_effort = 0.0;  ///< derivative by tau, and by the offset [-]
  double by_scale = 0.0;   ///< [N m or N per unit of the scale]
  double by_delay = 0.0;   ///< [N m/s or N/s]
};

/// @param effort tau of the model at `time`.
EffortResidual effort_residual(const EffortSensor& sensor, const RecordedEffort& recorded, double time, double effort);

}  // namespace codesign
