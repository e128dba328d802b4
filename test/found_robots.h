// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace codesign {

/// The files of robots as vendors describe them, doc/corpus.md, by name. They lie beside the source
/// tree and are no part of it.
std::vector<std::filesystem::path> found_robots();

/// Why a test is skipped where there are none.
constexpr const char* kNoFoundRobots = "the robots of doc/corpus.md are not beside the source tree";

}  // namespace codesign
