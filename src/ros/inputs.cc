// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/ros/inputs.h"

#include <yaml-cpp/yaml.h>

#include <cmath>

#include "mechanism_codesign/math/decimal.h"
#include "mechanism_codesign/model/error.h"

namespace codesign {
namespace {

using XmlRpc::XmlRpcValue;

// XmlRpcValue offers its contents only to those who may change it.
template <class T>
T content(XmlRpcValue value) {
  return static_cast<T&>(value);
}

void emit(XmlRpcValue value, YAML::Emitter* out) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      *out << content<bool>(value);
      break;
    case XmlRpcValue::TypeInt:
      *out << content<int>(value);
      break;
    case XmlRpcValue::TypeDouble:
      *out << to_decimal(content<double>(value));
      break;
    case XmlRpcValue::TypeString:
      *out << YAML::DoubleQuoted << content<std::string>(value);
      break;
    case XmlRpcValue::TypeArray:
      *out << YAML::BeginSeq;
      for (int i = 0; i < value.size(); ++i) emit(value[i], out);
      *out << YAML::EndSeq;
      break;
    case XmlRpcValue::TypeStruct:
      *out << YAML::BeginMap;
      for (auto& [key, child] : value) {
        *out << YAML::Key << key << YAML::Value;
        emit(child, out);
      }
      *out << YAML::EndMap;
      break;
    default:
      *out << YAML::Null;
  }
}

[[noreturn]] void fail(const ros::NodeHandle& node, const std::string& key, const std::string& message, const std::string& allowed) {
  throw InputError({{node.resolveName(key), 0}, key, message, "", allowed});
}

bool get(const ros::NodeHandle& node, const std::string& key, XmlRpcValue* value) {
  return node.getParam(key, *value) && !(value->getType() == XmlRpcValue::TypeString && content<std::string>(*value).empty());
}

SourceText read_model(const ros::NodeHandle& node, const ros::NodeHandle& private_node) {
  XmlRpcValue value;
  if (get(private_node, "model", &value)) {
    if (value.getType() != XmlRpcValue::TypeString) fail(private_node, "model", "not a text", "path of a URDF");
    return read_source(content<std::string>(value));
  }
  if (!get(node, "robot_description", &value) || value.getType() != XmlRpcValue::TypeString)
    fail(private_node, "model", "no model given", "~model, the path of a URDF, or robot_description, its text");
  return {node.resolveName("robot_description"), content<std::string>(value)};
}

std::vector<SourceText> read_overlays(const ros::NodeHandle& private_node) {
  XmlRpcValue value;
  if (!get(private_node, "overlays", &value)) return {};
  if (value.getType() == XmlRpcValue::TypeString) return {read_source(content<std::string>(value))};
  if (value.getType() != XmlRpcValue::TypeArray) fail(private_node, "overlays", "neither a path nor a list", "paths of overlay files");
  std::vector<SourceText> overlays;
  for (int i = 0; i < value.size(); ++i) {
    if (value[i].getType() != XmlRpcValue::TypeString) fail(private_node, "overlays", "not a path", "paths of overlay files");
    overlays.push_back(read_source(content<std::string>(value[i])));
  }
  return overlays;
}

void read_study_source(const ros::NodeHandle& private_node, Inputs* inputs) {
  XmlRpcValue value;
  if (!get(private_node, "study", &value)) fail(private_node, "study", "no study given", "a path, or the study as a tree of parameters");
  inputs->study_is_tree = value.getType() != XmlRpcValue::TypeString;
  if (inputs->study_is_tree)
    inputs->study = {private_node.resolveName("study"), to_yaml(value)};
  else
    inputs->study = read_source(content<std::string>(value));
}

bool is_number(const XmlRpcValue& value, double* number) {
  if (value.getType() == XmlRpcValue::TypeInt)
    *number = content<int>(value);
  else if (value.getType() == XmlRpcValue::TypeDouble)
    *number = content<double>(value);
  else
    return false;
  return true;
}

ParameterSettings read_settings(const ros::NodeHandle& private_node) {
  XmlRpcValue value;
  if (!get(private_node, "set", &value)) return {};
  if (value.getType() != XmlRpcValue::TypeStruct) fail(private_node, "set", "not a dictionary", "parameter names with numbers");
  ParameterSettings settings;
  for (auto& [name, number] : value) {
    settings.emplace_back(name, 0.0);
    if (!is_number(number, &settings.back().second)) fail(private_node, "set/" + name, "not a number", "a finite number");
  }
  return settings;
}

}  // namespace

double read_positive(const ros::NodeHandle& private_node, const std::string& key, double fallback) {
  XmlRpcValue value;
  if (!private_node.getParam(key, value)) return fallback;
  double number = 0.0;
  if (!is_number(value, &number) || !std::isfinite(number) || number <= 0.0)
    fail(private_node, key, "not a number above zero", "a finite number above zero");
  return number;
}

std::string to_yaml(const XmlRpcValue& tree) {
  YAML::Emitter out;
  emit(tree, &out);
  return std::string(out.c_str()) + "\n";
}

Inputs read_inputs(const ros::NodeHandle& node, const ros::NodeHandle& private_node) {
  Inputs inputs;
  inputs.urdf = read_model(node, private_node);
  inputs.overlays = read_overlays(private_node);
  read_study_source(private_node, &inputs);
  inputs.settings = read_settings(private_node);
  return inputs;
}

void require_every_parameter(const Inputs& inputs, const RobotDescription& robot) {
  if (!inputs.study_is_tree) return;
  const YAML::Node named = YAML::Load(inputs.study.text)["parameters"];
  for (const Parameter& parameter : robot.parameters) {
    if (named && named[parameter.name]) continue;
    throw InputError({{inputs.study.name, 0},
                      "parameters." + parameter.name,
                      "a study on the parameter server must name each parameter of the model, since an empty mapping {} is lost there",
                      "",
                      "{tune: true}, {tune: false}, or the path of the study as ~study"});
  }
}

}  // namespace codesign
