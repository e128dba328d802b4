// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_YAML_YAML_READER_H_
#define MECHANISM_CODESIGN_READING_YAML_YAML_READER_H_

#include <yaml-cpp/yaml.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism_codesign/error.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// A value of a YAML text that knows its place and its path, read strictly.
///
/// Every reading function throws InputError, with file, line, path and value, if the value is not of the kind asked for.
class YamlValue {
 public:
  /// The root of a text that holds one document.
  static YamlValue parse(const SourceText& source);

  /// `objective.integral[0].signal`; empty for the root.
  const std::string& path() const { return path_; }
  SourceLocation where() const;

  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_scalar() const { return node_.IsScalar(); }

  /// Checks that this is a map whose keys are all known, that none is repeated and that none required is missing.
  void require_keys(const std::vector<std::string>& required, const std::vector<std::string>& optional) const;
  /// The value of a key of a map, if it is there.
  std::optional<YamlValue> find(const std::string& key) const;
  /// The value of a key that require_keys() has seen.
  YamlValue at(const std::string& key) const;
  /// Where a key stands, which for a nested value is a line above it.
  SourceLocation key_place(const std::string& key) const;
  /// Keys and values of a map in the order written; a repeated key is an error.
  std::vector<std::pair<std::string, YamlValue>> entries() const;

  std::vector<YamlValue> items() const;
  /// A scalar as written, not empty.
  std::string text() const;
  /// A finite number. Quotes do not matter: rosparam reads `1e-6` as a string.
  double number() const;
  int integer() const;
  /// `true` or `false`, as YAML spells them.
  bool boolean() const;
  /// A scalar that is one of `allowed`.
  std::string choice(const std::string& kind, const std::vector<std::string>& allowed) const;

  [[noreturn]] void fail(const std::string& message, const std::string& allowed = "") const;

 private:
  YamlValue(const YAML::Node& node, std::shared_ptr<const std::string> file, std::string path)
      : node_(node), file_(std::move(file)), path_(std::move(path)) {}
  YamlValue child(const YAML::Node& node, const std::string& key) const;
  void require_map() const;
  std::string shown_value() const;

  YAML::Node node_;
  std::shared_ptr<const std::string> file_;
  std::string path_;
};

/// The whole text as a number, as YAML writes them; nothing if it is none. May be infinite or NaN.
std::optional<double> number_in(const std::string& text);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_YAML_YAML_READER_H_
