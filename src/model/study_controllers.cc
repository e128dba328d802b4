// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "study_controllers.h"

#include <algorithm>

#include "mechanism_codesign/model/signal_catalog.h"
#include "study_values.h"

namespace codesign {
namespace {

void read_gains(const YamlValue& gains, const std::vector<Parameter>& parameters, ControllerDescription* controller) {
  gains.require_keys({}, {"p", "i", "d"});
  if (gains.entries().empty()) gains.fail("a controller needs at least one gain", "p, i, d");
  if (const auto p = gains.find("p")) controller->p = read_quantity(*p, parameters);
  if (const auto i = gains.find("i")) controller->i = read_quantity(*i, parameters);
  if (const auto d = gains.find("d")) controller->d = read_quantity(*d, parameters);
}

/// A signal could not tell a controller from a joint or link of the same name.
void refuse_taken_name(const std::string& name, const YamlValue& value, const RobotDescription& robot) {
  const auto taken = [&name](const auto& item) { return item.name == name; };
  const bool joint = std::any_of(robot.joints.begin(), robot.joints.end(), taken);
  const bool link = std::any_of(robot.links.begin(), robot.links.end(), taken);
  if (joint || link) throw InputError({value.where(), value.path(), "a joint or link has this name", name, "a name of its own"});
}

ControllerDescription read_controller(const std::string& name, const YamlValue& value, const RobotDescription& robot, const Study& study) {
  value.require_keys({"type", "input", "setpoint", "output", "gains"}, {});
  refuse_taken_name(name, value, robot);
  ControllerDescription controller;
  controller.name = name;
  controller.where = value.where();
  controller.type = value.at("type").choice("controller type", {"pid"});
  const YamlValue input = value.at("input");
  controller.input = parse_signal(input.text(), input.where(), input.path());
  // Controllers written earlier may be read, so a cascade works and a circle cannot arise.
  check_signal(controller.input, robot, study.controllers, input.path());
  controller.setpoint = read_quantity(value.at("setpoint"), study.parameters);
  controller.output = scalar_joint(value.at("output").text(), robot, value.at("output")).name;
  read_gains(value.at("gains"), study.parameters, &controller);
  return controller;
}

}  // namespace

void read_controllers(const YamlValue& study_value, const RobotDescription& robot, Study* study) {
  const auto controllers = study_value.find("controllers");
  if (!controllers) return;
  for (const auto& [name, value] : controllers->entries()) study->controllers.push_back(read_controller(name, value, robot, *study));
}

}  // namespace codesign
