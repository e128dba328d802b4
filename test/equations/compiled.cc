// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/compiled.h"

#include <string>

namespace codesign {

Compiled::Compiled(const std::string& urdf, const std::string& study,
                   const ReactionSharing& sharing)
    : Compiled(read_urdf({"test.urdf", urdf}), study, sharing) {}

Compiled::Compiled(const RobotDescription& robot, const std::string& study,
                   const ReactionSharing& sharing)
    : system(robot, read_study({"test.yaml", study}, robot), sharing),
      equations(system),
      assembly(system) {}

Compiled::~Compiled() = default;

Status Compiled::start(const std::vector<double>& parameters) {
  equations.set_design(parameters);
  return assembly.solve(parameters, &equations, &state);
}

Status Compiled::start() { return start(system.parameters()); }

std::string let_go(const std::string& initial, const std::string& signal, const std::string& more) {
  return "duration: 1.0\ninitial_state: " + initial +
         "\nobjective: {integral: [{signal: " + signal + "}]}\n" + more;
}

}  // namespace codesign
