// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/input.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>

namespace codesign::fuzz {
namespace {

std::string text_of(const YAML::Node& node) {
  if (node.IsSequence()) {
    std::string text;
    for (const YAML::Node& part : node) text += text_of(part);
    return text;
  }
  if (node.IsMap()) {
    const std::string part = text_of(node["repeat"]);
    std::string text;
    for (int k = node["times"].as<int>(); k > 0; --k) text += part;
    return text;
  }
  if (node.Tag() == "tag:yaml.org,2002:binary") {
    const YAML::Binary binary = node.as<YAML::Binary>();
    return {reinterpret_cast<const char*>(binary.data()), binary.size()};
  }
  return node.Scalar();
}

bool is_plain(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
}

void emit(const std::string& text, YAML::Emitter* out) {
  if (is_plain(text))
    *out << YAML::DoubleQuoted << text;
  else
    *out << YAML::Binary(reinterpret_cast<const unsigned char*>(text.data()), text.size());
}

}  // namespace

Input load_input(const std::string& path) {
  const YAML::Node root = YAML::LoadFile(path);
  Input input;
  for (const YAML::Node& argument : root["arguments"]) input.arguments.push_back(text_of(argument));
  for (const auto& file : root["files"]) input.files[file.first.Scalar()] = text_of(file.second);
  if (root["disk"]) input.disk = root["disk"].as<long>();
  if (root["exit"]) input.exit = root["exit"].as<int>();
  if (root["says"]) input.says = root["says"].Scalar();
  return input;
}

void save_input(const std::string& path, const Input& input) {
  YAML::Emitter out;
  out << YAML::BeginMap << YAML::Key << "arguments" << YAML::Value << YAML::BeginSeq;
  for (const std::string& argument : input.arguments) emit(argument, &out);
  out << YAML::EndSeq << YAML::Key << "files" << YAML::Value << YAML::BeginMap;
  for (const auto& [name, text] : input.files) {
    out << YAML::Key << name << YAML::Value;
    emit(text, &out);
  }
  out << YAML::EndMap;
  if (input.disk) out << YAML::Key << "disk" << YAML::Value << *input.disk;
  out << YAML::EndMap;
  std::ofstream(path) << out.c_str() << '\n';
}

}  // namespace codesign::fuzz
