// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "description/ensemble.h"
#include "description/study.h"
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

// All throw InputError for unknown keys and values out of range.

/// Reads the map `limits:`.
LimitOptions read_limit_options(const YamlValue& limits);

/// Reads the map `solver:`.
SolverOptions read_solver_options(const YamlValue& solver);

/// Reads the map `optimizer:`.
OptimizerOptions read_optimizer_options(const YamlValue& optimizer);

/// Reads the map `robust:`.
/// @param ensemble with the runs and the uncertain quantities of the study. @throws InputError
RobustOptions read_robust(const YamlValue& robust, const EnsembleDescription& ensemble);

/// The default without `robust:`: the mean, over 32 samples if something is uncertain, else over the runs. @param where for messages.
RobustOptions default_robust(const EnsembleDescription& ensemble, const SourceLocation& where);

/// Reads `multistart:` of a study whose parameters have been read. Every tuned parameter needs finite bounds. @throws InputError
MultistartOptions read_multistart(const YamlValue& study_value, const Study& study);

}  // namespace codesign
