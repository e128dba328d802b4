// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/inputs.h"

#include <yaml-cpp/yaml.h>

#include <filesystem>

#include "jobs/saved_result.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"
#include "ros/common/parameters.h"

namespace codesign {
namespace {

using XmlRpc::XmlRpcValue;

[[noreturn]] void fail(const ros::NodeHandle& node, const std::string& key,
                       const std::string& message, const std::string& allowed) {
  throw InputError({{node.resolveName(key), 0}, key, message, "", allowed});
}

SourceText read_model(const ros::NodeHandle& node, const ros::NodeHandle& private_node) {
  const std::string path = read_path(private_node, "model", "");
  if (!path.empty()) return read_source(path);
  XmlRpcValue value;
  if (!find_parameter(node, "robot_description", &value))
    fail(private_node, "model", "no model given",
         "~model with the path of a URDF file, or robot_description with its text");
  if (value.getType() != XmlRpcValue::TypeString)
    refuse_parameter(node, "robot_description", "not a text", value, "the text of a URDF");
  return {node.resolveName("robot_description"), text_of(value)};
}

std::vector<SourceText> read_overlays(const ros::NodeHandle& private_node) {
  std::vector<SourceText> overlays;
  for (const std::string& path : read_texts(private_node, "overlays"))
    overlays.push_back(read_source(expand_home(path)));
  return overlays;
}

void read_study_source(const ros::NodeHandle& private_node, Inputs* inputs) {
  XmlRpcValue value;
  if (!find_parameter(private_node, "study", &value))
    fail(private_node, "study", "no study given",
         "the path of a study, or the study as a tree of parameters");
  inputs->study_is_tree = value.getType() == XmlRpcValue::TypeStruct;
  if (inputs->study_is_tree)
    inputs->study = {private_node.resolveName("study"), to_yaml(value)};
  else if (value.getType() == XmlRpcValue::TypeString)
    inputs->study = read_source(expand_home(text_of(value)));
  else
    refuse_parameter(private_node, "study", "neither a path nor a tree", value,
                     "a path, or the study as a tree of parameters");
}

/// The values of `~set`.
ParameterSettings read_settings(const ros::NodeHandle& private_node) {
  ParameterSettings settings;
  XmlRpcValue value;
  if (!find_parameter(private_node, "set", &value)) return settings;
  XmlRpcValue numbers = value.getType() == XmlRpcValue::TypeString ? dictionary_in(value) : value;
  if (numbers.getType() != XmlRpcValue::TypeStruct)
    refuse_parameter(private_node, "set", "not a dictionary", value, "{parameter: number, ...}");
  for (auto& [name, number] : numbers) {
    settings.emplace_back(name, 0.0);
    if (!is_number(number, &settings.back().second))
      refuse_parameter(private_node, "set/" + name, "not a number", number, "a finite number");
  }
  return settings;
}

std::string trimmed(const std::string& text) {
  const char* const kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

bool has_the_values_of_its_model(const Problem& problem) {
  const std::vector<double> values = problem.parameters();
  for (std::size_t k = 0; k < robot_of(problem).parameters.size(); ++k)
    if (values[k] != robot_of(problem).parameters[k].value) return false;
  return true;
}

}  // namespace

const std::vector<std::string>& input_parameters() {
  static const std::vector<std::string> kNames = {"model", "overlays", "study", "result", "set"};
  return kNames;
}

Inputs read_inputs(const ros::NodeHandle& node, const ros::NodeHandle& private_node) {
  Inputs inputs;
  inputs.urdf = read_model(node, private_node);
  inputs.overlays = read_overlays(private_node);
  read_study_source(private_node, &inputs);
  const std::string result = read_path(private_node, "result", "");
  if (!result.empty()) inputs.design = read_design(read_source(result));
  inputs.settings = read_settings(private_node);
  return inputs;
}

std::string study_folder(const Inputs& inputs) {
  if (inputs.study_is_tree) return "";
  return std::filesystem::absolute(inputs.study.name).parent_path().string();
}

void require_every_parameter(const Inputs& inputs, const RobotDescription& robot) {
  if (!inputs.study_is_tree) return;
  const YAML::Node named = YAML::Load(inputs.study.text)["parameters"];
  for (const Parameter& parameter : robot.parameters) {
    if (named && named[parameter.name]) continue;
    throw InputError({{inputs.study.name, 0},
                      "parameters." + parameter.name,
                      "a study on the parameter server must name each parameter of the model, "
                      "since an empty mapping {} is lost there",
                      "",
                      "{tune: true}, {tune: false}, or the path of the study as ~study"});
  }
}

bool describes(const std::string& text, const Problem& problem, const std::string& effective,
               const std::string& drawn) {
  if (trimmed(text) == trimmed(effective) || trimmed(text) == trimmed(drawn)) return true;
  return problem.overlays().empty() && has_the_values_of_its_model(problem) &&
         trimmed(text) == trimmed(problem.urdf().text);
}

Warnings check_description(const ros::NodeHandle& node, const Problem& problem,
                           const std::string& effective, const std::string& drawn) {
  std::string text;
  if (!node.getParam("robot_description", text) || describes(text, problem, effective, drawn))
    return {};
  const std::string name = node.resolveName("robot_description");
  return {warn("description_differs",
               {{name, 0},
                "robot_description",
                "the parameter describes another mechanism than the simulated one, so "
                "robot_state_publisher and "
                "rviz show the wrong one; the topic " +
                    name + " has the URDF of the simulated one, and `codesign urdf` prints it",
                "",
                ""})};
}

}  // namespace codesign
