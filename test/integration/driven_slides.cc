// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/driven_slides.h"

#include <string>
#include <vector>

namespace codesign {

std::vector<SignalDescription> parsed_signals(const std::vector<std::string>& texts) {
  std::vector<SignalDescription> signals;
  signals.reserve(texts.size());
  for (const std::string& text : texts) signals.push_back(parse_signal(text, {}, "signal"));
  return signals;
}

std::vector<double> end_of(const std::string& urdf, const std::string& study, double time,
                           const std::vector<std::string>& texts) {
  const std::shared_ptr<const CompiledSystem> system = compile(urdf, study);
  Simulation run = simulation_of(system, system->parameters(), parsed_signals(texts));
  EXPECT_TRUE(run.start().ok());
  const Status status = time > 0.0 ? run.advance_to(time) : Status();
  EXPECT_TRUE(status.ok()) << status.cause;
  Frame frame;
  run.sample(time, &frame);
  return frame.signals;
}

std::string mass(const std::string& name, double kilograms) {
  return "<link name='" + name + "'><inertial><mass value='" + std::to_string(kilograms) +
         "'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>";
}

std::string lift(const std::string& name, const std::string& child, double height,
                 const std::string& more) {
  return "<joint name='" + name + "' type='prismatic'><parent link='ground'/><child link='" +
         child + "'/><origin xyz='0 0 " + std::to_string(height) +
         "'/><axis xyz='0 0 1'/><limit lower='-5' upper='5' effort='1e9' velocity='99'/>" + more +
         "</joint>";
}

}  // namespace codesign
