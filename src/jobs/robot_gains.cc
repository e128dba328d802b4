// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/robot_gains.h"

#include <algorithm>

#include "control/controller.h"
#include "description/study.h"
#include "jobs/json.h"
#include "math/arrays.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A name in a comment. A name of other than printable ASCII characters is written as a JSON text,
/// so that no line end, of which YAML knows five, ends the comment, and no control character makes
/// the file unreadable.
std::string in_comment(const std::string& name) {
  const auto is_plain = [](char c) { return c >= ' ' && c <= '~'; };
  return std::all_of(name.begin(), name.end(), is_plain)
             ? name
             : Json(name).dump(-1, ' ', true, Json::error_handler_t::replace);
}

/// With a decimal point: rosparam takes `1e-06` for a text.
std::string yaml_number(double value) {
  std::string text = to_decimal(value);
  if (text.find('.') != std::string::npos) return text;
  text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

/// The parameters that control_toolbox::Pid reads, in its order.
Json pid_parameters(const RobotGains& gains) {
  Json parameters{{"p", gains.p}, {"i", gains.i}, {"d", gains.d}};
  if (gains.i_clamp_min == -gains.i_clamp_max) {
    parameters["i_clamp"] = gains.i_clamp_max;
  } else {
    parameters["i_clamp_max"] = gains.i_clamp_max;
    parameters["i_clamp_min"] = gains.i_clamp_min;
  }
  parameters["antiwindup"] = gains.antiwindup;
  return parameters;
}

/// The object at a namespace; creates missing parts of the namespace.
Json& at_namespace(const std::string& name_space, Json* root) {
  Json* place = root;
  for (std::size_t first = 0; first <= name_space.size();) {
    const std::size_t slash = std::min(name_space.find('/', first), name_space.size());
    place = &(*place)[name_space.substr(first, slash - first)];
    first = slash + 1;
  }
  return *place;
}

void write_block(const Json& object, std::size_t depth, std::string* text) {
  for (const auto& [key, value] : object.items()) {
    text->append(2 * depth, ' ');
    *text += key + ":";
    if (value.is_object()) {
      *text += "\n";
      write_block(value, depth + 1, text);
    } else {
      *text += " " +
               (value.is_boolean() ? (value.get<bool>() ? "true" : "false")
                                   : yaml_number(value.get<double>())) +
               "\n";
    }
  }
}

/// What control_toolbox::Pid does not know, in the words of the study.
std::vector<std::string> missing_of(const ControllerDescription& controller) {
  const ControlRealization& realization = controller.realization;
  const struct {
    bool is_there;
    const char* name;
  } all[] = {
      {!controller.filters.empty(), "filter"},
      {realization.output_limit.has_value(), "output_limit"},
      {realization.rate_limit.has_value(), "rate_limit"},
      {realization.antiwindup == AntiWindup::kBackCalculation, "antiwindup: back_calculation"},
      {realization.antiwindup == AntiWindup::kConditional, "antiwindup: conditional"},
      {realization.derivative_filter.has_value(), "derivative_filter"},
      {realization.rates_input, "derivative: measurement"}};
  std::vector<std::string> missing;
  for (const auto& one : all)
    if (one.is_there) missing.emplace_back(one.name);
  return missing;
}

}  // namespace

std::vector<RobotGains> robot_gains(const Problem& problem, const std::vector<double>& parameters) {
  const Study& study = study_of(problem);
  std::vector<RobotGains> all;
  for (const HardwareGains& gains : study.hardware) {
    const auto is_it = [&gains](const ControllerDescription& controller) {
      return controller.name == gains.controller;
    };
    const ControllerDescription& controller =
        *std::find_if(study.controllers.begin(), study.controllers.end(), is_it);
    RobotGains found;
    found.name_space = gains.name_space;
    found.controller = controller.name;
    found.joint = controller.output;
    found.loses_weight = controller.kind->load == ControlLoad::kAtRest;
    const RobotDescription& robot = robot_of(problem);
    const int joint = joint_named(robot, controller.output);
    found.gives_voltage = joint >= 0 && robot.joints[to_index(joint)].has_winding();
    found.p = controller.p.at(parameters);
    found.i = controller.i.at(parameters);
    found.d = controller.d.at(parameters);
    if (gains.i_clamp) {
      const Bounds<double> bounds = bounds_at(*gains.i_clamp, parameters);
      found.i_clamp_min = bounds.lower;
      found.i_clamp_max = bounds.upper;
    }
    found.missing = missing_of(controller);
    for (const ControllerDescription& beside : study.controllers)
      if (beside.name != controller.name && !beside.output.empty() &&
          beside.output == controller.output)
        found.missing.push_back("the output of " + in_comment(beside.name) + " beside it");
    found.antiwindup = gains.antiwindup;
    all.push_back(std::move(found));
  }
  return all;
}

std::string gains_yaml(const Problem& problem, const std::vector<double>& parameters) {
  const std::vector<RobotGains> all = robot_gains(problem, parameters);
  if (all.empty()) return "";
  std::string text =
      "# Gains for the robot, as control_toolbox::Pid reads them: rosparam load gains.yaml\n"
      "# Effort = p e + i (integral of e, at most i_clamp as effort) + d de/dt, e = setpoint - "
      "measured, SI units.\n";
  Json root = Json::object();
  for (const RobotGains& gains : all) {
    text += "# " + gains.name_space + ": " + in_comment(gains.controller) +
            " of the study, which drives " + in_comment(gains.joint);
    if (gains.gives_voltage) text += "; its output is the voltage of the motor [V], no effort";
    if (gains.loses_weight)
      text += "; in the study it also carries the weight, which is not among these gains";
    for (std::size_t k = 0; k < gains.missing.size(); ++k)
      text += (k == 0 ? "; not in these gains, as the study has it: " : ", ") + gains.missing[k];
    text += "\n";
    at_namespace(gains.name_space, &root) = pid_parameters(gains);
  }
  write_block(root, 0, &text);
  return text;
}

}  // namespace codesign
