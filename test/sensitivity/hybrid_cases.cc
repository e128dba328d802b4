// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/hybrid_cases.h"

#include "integration/mechanisms.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

const char* const kStart = R"(
initial_state: {shoulder: {position: "${start}"}, elbow: {velocity: 1.0}}
parameters: {Kp: {initial: 40}, Kd: {initial: 3}, start: {initial: 1.0}, edge: {initial: 0.6},
  push: {initial: 3}, ts: {initial: 0.2}}
)";

const char* const kTerms = R"(objective:
  integral:
    - {signal: servo/error}
    - {signal: "${elbow/position > 0.1 ? shoulder/velocity : edge}", weight: 0.3}
  terminal:
    - {signal: elbow/position, reference: "${start}"}
    - {signal: shoulder/acceleration, weight: 0.01}
)";

/// Terms with each loss, most of which pass their kinks.
const char* const kLosses = R"(objective:
  integral:
    - {signal: servo/error, loss: absolute}
    - {signal: shoulder/velocity, loss: huber, scale: "${edge}", weight: 0.3}
    - {signal: elbow/velocity, loss: soft_l1, scale: "${0.1*push}"}
    - {signal: elbow/position, reference: 0.05, loss: above, weight: "${push}"}
    - {signal: shoulder/position, reference: "${edge}", loss: below, weight: 5}
  terminal:
    - {signal: elbow/position, reference: "${start}", loss: huber, scale: 0.1}
    - {signal: shoulder/acceleration, weight: 0.01, loss: absolute}
    - {signal: shoulder/velocity, loss: below}
)";

std::string servo_with(const std::string& keys, const std::string& setpoint = "0.3") {
  return "controllers: {servo: {type: pid, input: shoulder/position, setpoint: " + setpoint +
         ", output: shoulder, gains: {p: \"${Kp}\", d: \"${Kd}\"}" + keys + "}}\n";
}

/// Its slope, and with it the effort of the d gain, jumps at given instants.
const char* const kPolygon =
    "{type: waypoints, times: [0.1, 0.25, 0.4], positions: [0.9, 0.3, \"${edge}\"], "
    "interpolation: linear}";

/// Jumps by a position and by a time, and a kink.
const char* const kLoads = R"(loads:
  - {joint: elbow, effort: "${(shoulder/position > edge ? push : -0.5*push) + (t < ts ? 1 : 0)}"}
  - {joint: shoulder, effort: "${-20*max(0, elbow/position - 0.05)}"}
)";

/// A parallelogram that is pushed by its angle and its speed.
std::string linkage(const std::string& pin) {
  std::string urdf = four_bar(pin_friction());
  const std::string plain = "<mass value='1'/>", loop = "<loop name='right_pin'";
  urdf.replace(urdf.find(plain), plain.size(), "<mass value='1' codesign:value='${mass}'/>");
  urdf.insert(urdf.find("<link name='ground'/>"),
              "<codesign:parameter name='mass' value='1' lower='0.5' upper='2'/>");
  return urdf.insert(urdf.find(loop) + loop.size(), pin);
}

const char* const kLinkage = R"(duration: 0.5
initial_state: {left_hinge: {position: 0.4}, right_hinge: {guess: 0.4}}
parameters: {mass: {}, edge: {initial: 0.35}, push: {initial: 4.0}, ts: {initial: 0.31}}
loads: [{joint: left_hinge,
  effort: "${(left_hinge/position > edge ? 0 : push) - 2*sign(t - ts) + abs(left_hinge/velocity)}"}]
objective: {integral: [{signal: left_hinge/velocity}, {signal: left_hinge/friction, weight: 0.1}],
  terminal: [{signal: coupler/position/z, weight: "${mass}"}]}
)";

}  // namespace

std::shared_ptr<const CompiledSystem> HybridCase::compile(const std::string& solver) const {
  const RobotDescription robot = read_urdf({name + ".urdf", urdf});
  return make_system(robot,
                     read_study({name + ".yaml", study + "solver: {" + solver + "}\n"}, robot));
}

std::vector<HybridCase> hybrid_cases() {
  const std::string arm = double_pendulum(pin_friction()), free_arm = double_pendulum(""),
                    usual = std::string(kStart) + kTerms, lasting = "duration: 0.6\n",
                    sampled = ", sample_time: 0.02, delay: 0.007, derivative_filter: 0.01",
                    until = "until: \"${shoulder/position < 0.8*edge or t > 0.55}\"\n";
  return {{"switched_arm", arm, lasting + usual + servo_with("") + kLoads},
          {"switched_arm_without_friction", free_arm, lasting + usual + servo_with("") + kLoads},
          {"arm_along_a_polygon", free_arm, lasting + usual + servo_with("", kPolygon) + kLoads},
          {"arm_with_losses", arm, lasting + kStart + kLosses + servo_with("")},
          {"sampled_arm", arm, lasting + usual + servo_with(sampled)},
          {"sampled_and_switched_arm", free_arm, lasting + usual + servo_with(sampled) + kLoads},
          {"arm_that_ends", free_arm, lasting + until + usual + servo_with("") + kLoads},
          {"sampled_arm_that_ends", arm, lasting + until + usual + servo_with(sampled) + kLoads},
          {"parallelogram", linkage(""), kLinkage},
          {"planar_parallelogram", linkage(" codesign:out_of_plane='zero'"), kLinkage}};
}

GradientRun run_to_end(GradientEngine* engine, const CompiledSystem& system) {
  GradientRun run;
  run.status = engine->start(system.parameters(), Derivatives::kGradient);
  while (run.status.ok() && !engine->integrator().has_ended())
    run.status = engine->advance(engine->integrator().end());
  if (!run.status.ok()) return run;
  run.objective = engine->objective();
  engine->gradient(&run.gradient);
  run.steps = engine->statistics().steps;
  return run;
}

}  // namespace codesign
