// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/robot_gains.h"

#include <algorithm>

namespace codesign {

std::vector<RobotGains> robot_gains(const Problem& problem, const std::vector<double>& parameters) {
  const Study& study = problem.study();
  std::vector<RobotGains> all;
  for (const HardwareGains& gains : study.hardware) {
    const auto is_it = [&gains](const ControllerDescription& controller) { return controller.name == gains.controller; };
    const ControllerDescription& controller = *std::find_if(study.controllers.begin(), study.controllers.end(), is_it);
    RobotGains found;
    found.name_space = gains.name_space;
    found.controller = controller.name;
    found.joint = controller.output;
    found.loses_weight = controller.kind->load == ControlLoad::kAtRest;
    found.p = controller.p.at(parameters);
    found.i = controller.i.at(parameters);
    found.d = controller.d.at(parameters);
    found.i_clamp = gains.i_clamp ? gains.i_clamp->at(parameters) : 0.0;
    found.antiwindup = gains.antiwindup;
    all.push_back(std::move(found));
  }
  return all;
}

}  // namespace codesign
