// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "description/ensemble.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

// Optional keys of the blocks of options; a missing key leaves the option at its default. All throw InputError.

/// Sets `*option` to the enumerator named at `key`, if the key exists. @param names in the order of the enumerators.
template <class Enumeration, std::size_t N>
void read_choice(const YamlValue& parent, const std::string& key, const std::array<const char*, N>& names, Enumeration* option) {
  const auto value = parent.find(key);
  if (!value) return;
  const std::string name = value->choice(key, {names.begin(), names.end()});
  *option = static_cast<Enumeration>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Sets `*count` to the whole number from `least` to `most` at `key`, if the key exists.
void read_whole(const YamlValue& parent, const std::string& key, int least, int most, int* count);

/// Reads the keys `sampler` and `seed`.
void read_sampler(const YamlValue& parent, SamplerKind* sampler, std::uint32_t* seed);

}  // namespace codesign
