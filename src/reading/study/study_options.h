// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "description/study.h"
#include "reading/study/option_tables.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// One of the names of an option's choices: the option itself, or an enumeration in this order.
/// @param kind the word for it in messages. @throws InputError
template <class Option, std::size_t N>
Option read_choice(const YamlValue& value, const std::string& kind,
                   const std::array<const char*, N>& names, const Option& /*type*/) {
  const std::string name = value.choice(kind, {names.begin(), names.end()});
  if constexpr (std::is_enum_v<Option>)
    return static_cast<Option>(std::find(names.begin(), names.end(), name) - names.begin());
  else
    return name;
}

/// Reads one option, if the block has its key; else the option keeps its value. All throw
/// InputError.
struct OptionReader {
  const YamlValue& block;

  void operator()(const std::string& key, bool& option) const;
  void operator()(const std::string& key, const OptionRange& range, double& option) const;
  void operator()(const std::string& key, const OptionRange& range,
                  std::optional<double>& option) const;
  void operator()(const std::string& key, const OptionRange& range, int& option) const;
  void operator()(const std::string& key, const OptionRange& range, std::uint32_t& option) const;
  void operator()(const std::string& key, LossKind& option) const;
  /// @param names of the choices: the option itself, or an enumeration in this order.
  template <class Option, std::size_t N>
  void operator()(const std::string& key, const std::array<const char*, N>& names,
                  Option& option) const {
    if (const auto value = block.find(key)) option = read_choice(*value, key, names, option);
  }
};

/// Checks that a block has all `required` keys, and else only `others` and those of its options.
/// @throws InputError
template <class Options>
void require_option_keys(const YamlValue& block, Options options,
                         const std::vector<std::string>& required = {},
                         std::vector<std::string> others = {}) {
  const auto add = [&](const char* key, const auto&...) {
    if (std::find(required.begin(), required.end(), key) == required.end())
      others.emplace_back(key);
  };
  visit_options(add, &options);
  block.require_keys(required, others);
}

/// Reads a block that consists of options. @throws InputError
template <class Options>
void read_options(const YamlValue& block, Options* options,
                  const std::vector<std::string>& required = {}) {
  require_option_keys(block, *options, required);
  visit_options(OptionReader{block}, options);
}

// All throw InputError for unknown keys, values out of range, and keys without effect.

/// Reads the map `solver:`.
SolverOptions read_solver_options(const YamlValue& solver);

/// Reads the map `limits:`.
LimitOptions read_limit_options(const YamlValue& limits);

/// Reads the map `optimizer:`.
OptimizerOptions read_optimizer_options(const YamlValue& optimizer);

}  // namespace codesign
