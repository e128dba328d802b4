// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/gradient_cases.h"

#include <functional>
#include <string>
#include <vector>

namespace codesign {

GradientCase::GradientCase(std::string called, RobotDescription machine, Study asked)
    : name(std::move(called)), robot(std::move(machine)), study(std::move(asked)) {}
GradientCase::~GradientCase() = default;
GradientCase::GradientCase(const GradientCase&) = default;
GradientCase::GradientCase(GradientCase&&) noexcept = default;

std::shared_ptr<const CompiledSystem> GradientCase::compile(const std::string& method,
                                                            const std::string& gradient) const {
  Study changed = study;
  changed.solver.method = method_named(method);
  changed.solver.gradient = gradient_named(gradient);
  return make_system(robot, changed);
}

GradientCase from_texts(const std::string& name, const std::string& urdf,
                        const std::string& study) {
  const RobotDescription robot = read_urdf({name + ".urdf", urdf});
  return {name, robot, read_study({name + ".yaml", study}, robot)};
}

GradientCase shipped_case(const std::string& name, double duration) {
  const Shipped shipped(name);
  GradientCase result{name, shipped.robot, shipped.study};
  result.study.duration = duration;
  result.study.solver.relative_tolerance = 1e-6;
  result.study.solver.absolute_tolerance = 1e-7;
  // The adjoint requires steps that are not controlled by a sensitivity tolerance.
  result.study.solver.sensitivity_tolerance = 0.0;
  return result;
}

GradientCase four_bar_case() {
  std::string urdf = four_bar(pin_friction());
  const std::string plain = "<mass value='1'/>";
  urdf.replace(urdf.find(plain), plain.size(), "<mass value='1' codesign:value='${mass}'/>");
  urdf.insert(urdf.find("<link name='ground'/>"),
              "<codesign:parameter name='mass' value='1' lower='0.5' upper='2'/>");
  return from_texts("four_bar", urdf,
                    "duration: 0.4\ninitial_state: {left_hinge: {position: 0.4}, right_hinge: "
                    "{guess: 0.4}}\nparameters: {mass: {}, torque: {initial: "
                    "2.0}}\n"
                    "controllers: {motor: {type: pid, input: left_hinge/velocity, setpoint: "
                    "\"${torque}\", output: left_hinge, gains: {p: 0.7}}}\n"
                    "objective: {integral: [{signal: left_hinge/velocity}, {signal: "
                    "left_hinge/friction, weight: 0.1}],\n"
                    "  terminal: [{signal: coupler/position/z, weight: \"${mass}\"}]}\n");
}

std::vector<GradientCase> gradient_cases() {
  const GeneratedCase chain = parametric_chain(6, 24);
  GradientCase chain_case = from_texts("chain", chain.urdf.text, chain.study.text);
  chain_case.study.duration = 0.1;
  return {shipped_case("slider_crank_haug", 0.3),
          shipped_case("inverted_pendulum", 0.2),
          shipped_case("governor", 0.05),
          shipped_case("two_link_arm", 0.3),
          shipped_case("gantry", 0.5),
          from_texts("servo", double_pendulum(pin_friction()), servo_study("{}")),
          four_bar_case(),
          chain_case};
}

GradientRun run_gradient(GradientEngine* engine, const CompiledSystem& system,
                         const std::vector<double>& parameters, bool with_gradient) {
  GradientRun run;
  run.status = engine->start(parameters, gradient_if(with_gradient));
  while (run.status.ok() && engine->time() < system.study().duration)
    run.status = engine->advance(system.study().duration);
  if (!run.status.ok()) return run;
  run.objective = engine->objective();
  if (with_gradient) engine->gradient(&run.gradient);
  run.steps = engine->statistics().steps;
  return run;
}

}  // namespace codesign
