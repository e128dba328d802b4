// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/parameters.h"

#include <ros/param.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>

#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {

using XmlRpc::XmlRpcValue;

namespace {

// The value is passed by copy, since XmlRpcValue gives access to its content only when it is not
// const.
template <class T>
T content(XmlRpcValue value) {
  return static_cast<T&>(value);
}

void emit(XmlRpcValue value, YAML::Emitter* out) {
  const XmlRpcValue::Type type = value.getType();
  if (type == XmlRpcValue::TypeBoolean) {
    *out << content<bool>(value);
  } else if (type == XmlRpcValue::TypeInt) {
    *out << content<int>(value);
  } else if (type == XmlRpcValue::TypeDouble) {
    *out << to_decimal(content<double>(value));
  } else if (type == XmlRpcValue::TypeString) {
    *out << YAML::DoubleQuoted << content<std::string>(value);
  } else if (type == XmlRpcValue::TypeArray) {
    *out << YAML::BeginSeq;
    for (int i = 0; i < value.size(); ++i) emit(value[i], out);
    *out << YAML::EndSeq;
  } else if (type == XmlRpcValue::TypeStruct) {
    *out << YAML::BeginMap;
    for (auto& [key, child] : value) emit(child, &(*out << YAML::Key << key << YAML::Value));
    *out << YAML::EndMap;
  } else {
    *out << YAML::Null;
  }
}

/// A value as shown in messages: on one line and shortened.
std::string shown(const XmlRpcValue& value) {
  constexpr std::size_t kMost = 80;
  YAML::Emitter out;
  out.SetSeqFormat(YAML::Flow);
  out.SetMapFormat(YAML::Flow);
  emit(value, &out);
  const std::string text = out.c_str();
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

}  // namespace

void refuse_parameter(const ros::NodeHandle& node, const std::string& key,
                      const std::string& message, const XmlRpcValue& value,
                      const std::string& allowed) {
  throw InputError({{node.resolveName(key), 0}, key, message, shown(value), allowed});
}

bool find_parameter(const ros::NodeHandle& node, const std::string& key, XmlRpcValue* value) {
  return node.getParam(key, *value) &&
         !(value->getType() == XmlRpcValue::TypeString && text_of(*value).empty());
}

bool is_number(const XmlRpcValue& value, double* number) {
  if (value.getType() == XmlRpcValue::TypeInt)
    *number = content<int>(value);
  else if (value.getType() == XmlRpcValue::TypeDouble)
    *number = content<double>(value);
  else if (const auto spelled = value.getType() == XmlRpcValue::TypeString
                                    ? parse_number(text_of(value))
                                    : std::nullopt)
    *number = *spelled;
  else
    return false;
  return true;
}

std::string text_of(const XmlRpcValue& value) { return content<std::string>(value); }

double read_positive(const ros::NodeHandle& private_node, const std::string& key, double fallback,
                     double largest) {
  XmlRpcValue value;
  if (!find_parameter(private_node, key, &value)) return fallback;
  double number = 0.0;
  if (!is_number(value, &number) || !std::isfinite(number) || number <= 0.0)
    refuse_parameter(private_node, key, "not a number above zero", value,
                     "a finite number above zero");
  if (number > largest)
    refuse_parameter(private_node, key, "too large", value, "at most " + to_decimal(largest));
  return number;
}

bool read_flag(const ros::NodeHandle& private_node, const std::string& key, bool fallback) {
  XmlRpcValue value;
  if (!find_parameter(private_node, key, &value)) return fallback;
  if (value.getType() == XmlRpcValue::TypeString &&
      (text_of(value) == "true" || text_of(value) == "false"))
    return text_of(value) == "true";
  if (value.getType() != XmlRpcValue::TypeBoolean)
    refuse_parameter(private_node, key, "neither true nor false", value, "true, false");
  return content<bool>(value);
}

std::string read_text(const ros::NodeHandle& private_node, const std::string& key,
                      const std::string& fallback) {
  XmlRpcValue value;
  if (!find_parameter(private_node, key, &value)) return fallback;
  if (value.getType() != XmlRpcValue::TypeString)
    refuse_parameter(private_node, key, "not a text", value, "a text");
  return text_of(value);
}

std::string read_path(const ros::NodeHandle& private_node, const std::string& key,
                      const std::string& fallback) {
  const std::string path = expand_home(read_text(private_node, key, fallback));
  return path.empty() ? path : std::filesystem::absolute(path).lexically_normal().string();
}

std::vector<std::string> read_texts(const ros::NodeHandle& private_node, const std::string& key) {
  XmlRpcValue value;
  if (!find_parameter(private_node, key, &value)) return {};
  if (value.getType() == XmlRpcValue::TypeString) return {text_of(value)};
  if (value.getType() != XmlRpcValue::TypeArray)
    refuse_parameter(private_node, key, "neither a text nor a list", value,
                     "a text or a list of texts");
  std::vector<std::string> texts;
  for (int i = 0; i < value.size(); ++i) {
    if (value[i].getType() != XmlRpcValue::TypeString)
      refuse_parameter(private_node, key, "an entry is not a text", value[i], "a list of texts");
    texts.push_back(text_of(value[i]));
  }
  return texts;
}

std::vector<std::string> names_in(const std::string& text) {
  static const char* const kAround = " \t[]'\"";
  std::vector<std::string> names;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t begin = part.find_first_not_of(kAround);
    if (begin != std::string::npos)
      names.push_back(part.substr(begin, part.find_last_not_of(kAround) + 1 - begin));
  }
  return names;
}

XmlRpcValue dictionary_in(const std::string& text) {
  XmlRpcValue dictionary;
  try {
    const YAML::Node node = YAML::Load(text);
    if (!node.IsMap()) return {};
    for (const auto& entry : node)
      dictionary[entry.first.as<std::string>()] = entry.second.as<double>();
  } catch (const YAML::Exception&) {
    return {};
  }
  return dictionary;
}

std::vector<std::string> read_names(const ros::NodeHandle& private_node, const std::string& key) {
  XmlRpcValue value;
  if (find_parameter(private_node, key, &value) && value.getType() == XmlRpcValue::TypeString)
    return names_in(text_of(value));
  return read_texts(private_node, key);
}

Warnings unknown_parameters(const ros::NodeHandle& private_node,
                            const std::vector<std::string>& known) {
  std::vector<std::string> all;
  ros::param::getParamNames(all);
  const std::string space = private_node.getNamespace() + "/";
  std::set<std::string> unknown;
  for (const std::string& name : all)
    if (name.compare(0, space.size(), space) == 0)
      unknown.insert(name.substr(space.size(), name.find('/', space.size()) - space.size()));
  for (const std::string& name : known) unknown.erase(name);
  Warnings warnings;
  for (const std::string& name : unknown) {
    const std::string hint = did_you_mean(nearest_name(name, known));
    warnings.push_back(warn("unknown_parameter", {{space + name, 0},
                                                  name,
                                                  "unknown private parameter, ignored" + hint,
                                                  "",
                                                  list_names(known)}));
  }
  return warnings;
}

std::string expand_home(const std::string& path) {
  const char* home = std::getenv("HOME");
  const bool is_below_home = path == "~" || path.compare(0, 2, "~/") == 0;
  return is_below_home && home != nullptr ? home + path.substr(1) : path;
}

std::string to_yaml(const XmlRpcValue& tree) {
  YAML::Emitter out;
  emit(tree, &out);
  return std::string(out.c_str()) + "\n";
}

}  // namespace codesign
