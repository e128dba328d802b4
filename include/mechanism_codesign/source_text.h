// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/error.h"

namespace codesign {

/// A text to be read: a URDF model, an overlay or a study.
struct SourceText {
  std::string name;  ///< for messages: the path of its file, or any other name
  std::string text;  ///< the whole text
  /// Of a text that a program has made of files: where each of its lines came from, for messages;
  /// empty: from itself.
  std::vector<SourceLocation> origins{};
};

/// Reads a file of at most 32 MB. @throws InputError for a file that is missing, empty, too large
/// or unreadable.
SourceText read_source(const std::string& path);

}  // namespace codesign
