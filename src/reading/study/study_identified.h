// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "description/named_file.h"
#include "description/study.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads `uncertain.from`: the normal distribution of several parameters that an identification has found, with its correlations,
/// doc/theory.md (24h). Numbers of sensors and recordings, which are not parameters of the model, are left out: the result is the marginal
/// distribution of the other numbers.
/// @param from the file's path, or {file, except}. @param study with its parameters. @param own names with a distribution of their own in
/// `uncertain:`. @param files reads the file; empty: refused. @param first how many uncertain quantities come before these
/// @throws InputError, located in the study or in the file
std::vector<UncertainQuantity> read_identified(const YamlValue& from, const Study& study, const std::set<std::string>& own,
                                               const FileLoader& files, std::size_t first);

}  // namespace codesign
