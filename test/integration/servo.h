// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "assembly/make_system.h"
#include "description/study.h"
#include "integration/mechanisms.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

/// A double pendulum with friction whose shoulder a PID turns; an extra state, terminal terms, five
/// parameters, one of them in the initial state.
inline std::string servo_study(const std::string& solver) {
  return "duration: 0.6\ninitial_state: {shoulder: {position: \"${start}\"}, elbow: {velocity: "
         "1.0}}\n"
         "controllers: {servo: {type: pid, input: shoulder/position, setpoint: 0.3, output: "
         "shoulder, gains: {p: \"${Kp}\", i: \"${Ki}\", "
         "d: \"${Kd}\"}}}\n"
         "parameters: {Kp: {initial: 40.0}, Ki: {initial: 60.0}, Kd: {initial: 3.0}, start: "
         "{initial: 1.0}, weight: {initial: 0.5}}\n"
         "objective: {integral: [{signal: servo/error}, {signal: servo/integral, weight: "
         "\"${weight}\"}],\n"
         "  terminal: [{signal: elbow/position, reference: \"${start}\"}, {signal: "
         "shoulder/acceleration, weight: 0.01}]}\nsolver: " +
         solver + "\n";
}

/// In absolute coordinates, whose places in the state tests know, unless the study names others.
inline std::shared_ptr<const CompiledSystem> compile(const std::string& urdf,
                                                     const std::string& text) {
  const RobotDescription description = read_urdf({"test.urdf", urdf});
  Study study = read_study({"test.yaml", text}, description);
  if (study.solver.coordinates == CoordinatesKind::kAuto)
    study.solver.coordinates = CoordinatesKind::kAbsolute;
  return make_system(description, study);
}

inline std::shared_ptr<const CompiledSystem> servo(const std::string& solver) {
  return compile(double_pendulum(pin_friction()), servo_study(solver));
}

}  // namespace codesign
