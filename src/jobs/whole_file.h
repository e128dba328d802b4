// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace codesign {

/// Suffix of a file that write_whole_file() has not finished.
inline constexpr const char* kPartSuffix = ".part";

/// Writes `path`.part and renames it to `path` when it is complete, so that `path` is never half-written, even if the process is killed. An
/// existing `path` is replaced. @throws OutputError if that fails; `path`.part is removed then.
void write_whole_file(const std::string& path, const std::string& text);

/// Renames the finished file `active` to `path`, which must not exist. @throws OutputError if it exists or renaming fails.
void give_final_name(const std::string& active, const std::string& path);

}  // namespace codesign
