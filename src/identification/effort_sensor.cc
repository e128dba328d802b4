// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort_sensor.h"

namespace codesign {

EffortResidual effort_residual(const EffortSensor& sensor, const RecordedEffort& recorded, double time, double effort) {
  const RecordedEffort::Sample r = recorded.at(time + sensor.delay);
  EffortResidual residual;
  residual.by_effort = sensor.start_scale / sensor.scale;
  residual.value = residual.by_effort * (effort + sensor.offset) - sensor.start_scale * r.value;
  residual.by_scale = -residual.by_effort * (effort + sensor.offset) / sensor.scale;
  residual.by_delay = -sensor.start_scale * r.slope;
  return residual;
}

}  // namespace codesign
