// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/servo.h"

#include <memory>
#include <string>

namespace codesign {

std::string servo_study(const std::string& solver) {
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

std::shared_ptr<const CompiledSystem> compile(const std::string& urdf, const std::string& text) {
  const RobotDescription description = read_urdf({"test.urdf", urdf});
  Study study = read_study({"test.yaml", text}, description);
  if (study.solver.coordinates == CoordinatesKind::kAuto)
    study.solver.coordinates = CoordinatesKind::kAbsolute;
  return make_system(description, study);
}

std::shared_ptr<const CompiledSystem> servo(const std::string& solver) {
  return compile(double_pendulum(pin_friction()), servo_study(solver));
}

}  // namespace codesign
