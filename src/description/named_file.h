// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "mechanism_codesign/error.h"
#include "mechanism_codesign/source_text.h"

namespace codesign {

/// A file that a study names.
struct FileAddress {
  std::string file;  ///< as written: an absolute path, or one relative to the folder of the study
  SourceLocation where;  ///< the place in the study that names it, for messages
  std::string element;   ///< likewise
};

/// Where the file is. @param folder of the study; empty: only absolute paths are accepted. @throws
/// InputError
std::string path_of(const FileAddress& address, const std::string& folder);

/// Callback that reads a text that a study names. @throws InputError if it cannot be read.
using FileLoader = std::function<SourceText(const FileAddress&)>;

/// Reads files by path_of().
FileLoader files_in(const std::string& folder);

/// Reads files relative to the folder of a study file. @param study path of the study
FileLoader files_beside(const std::string& study);

}  // namespace codesign
