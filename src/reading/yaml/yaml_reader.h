// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism_codesign/error.h"
#include "mechanism_codesign/source_text.h"

namespace codesign {

/// A value of a YAML text with its line and path.
///
/// Every reading function throws InputError with file, line, path and value if the value does not
/// have the expected type.
class YamlValue {
 public:
  /// The root of a text that consists of one document. @throws InputError if it is not YAML, empty
  /// or too deeply nested.
  static YamlValue parse(const SourceText& source);

  YamlValue(const YamlValue&) = default;
  YamlValue(YamlValue&&) = default;
  // Assigning a YAML::Node changes the tree that both nodes belong to.
  YamlValue& operator=(const YamlValue&) = delete;
  YamlValue& operator=(YamlValue&&) = delete;
  ~YamlValue() = default;

  /// `objective.integral[0].signal`; empty for the root.
  const std::string& path() const { return path_; }
  SourceLocation where() const;

  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_scalar() const { return node_.IsScalar(); }

  /// Checks that this is a map with all required keys, no unknown ones and none repeated.
  void require_keys(const std::vector<std::string>& required,
                    const std::vector<std::string>& optional) const;
  /// The value of a key of a map; std::nullopt if there is none.
  std::optional<YamlValue> find(const std::string& key) const;
  /// Likewise. @throws InputError if there is none.
  YamlValue at(const std::string& key) const;
  /// The place of a key; a nested value begins in a later line.
  SourceLocation key_place(const std::string& key) const;
  /// Keys and values of a map in the order written; a repeated key is an error.
  std::vector<std::pair<std::string, YamlValue>> entries() const;

  /// This value with a change laid over it: maps are merged key by key, everything else is
  /// replaced, and so is a map whose `type` the change gives another value. Values from the change,
  /// and each merged map, have line and path of the change; all other values keep their own.
  YamlValue merged(const YamlValue& change) const;

  /// The items of a list.
  std::vector<YamlValue> items() const;
  /// A scalar as written. @throws InputError also if it is empty.
  std::string text() const;
  /// A finite number, quoted or not: rosparam writes `1e-6` as a string.
  double number() const;
  /// A whole number of magnitude up to 1e9.
  int integer() const;
  /// `true` or `false`, in any of YAML's spellings.
  bool boolean() const;
  /// A scalar that is one of `allowed`. @param kind the word for it in the message "unknown
  /// <kind>".
  std::string choice(const std::string& kind, const std::vector<std::string>& allowed) const;

  /// Throws InputError with the place, path and value. @param allowed the allowed values; may be
  /// empty.
  [[noreturn]] void fail(const std::string& message, const std::string& allowed = "") const;

 private:
  YamlValue(const YAML::Node& node, std::shared_ptr<const std::string> file, std::string path)
      : node_(node), file_(std::move(file)), path_(std::move(path)) {}
  YamlValue child(const YAML::Node& node, const std::string& key) const;
  void require_map() const;
  std::string shown_value() const;
  /// entries() of the value as written.
  std::vector<std::pair<std::string, YamlValue>> own_entries() const;

  YAML::Node node_;
  std::shared_ptr<const std::string> file_;
  std::string path_;
  /// the map over which this one is laid; null for a value as written
  std::shared_ptr<const YamlValue> base_;
};

/// The number that the whole text spells in YAML's notation (`.inf`, `.nan` included); std::nullopt
/// if it is not a number.
std::optional<double> number_in(const std::string& text);

}  // namespace codesign
