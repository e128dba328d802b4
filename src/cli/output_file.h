// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace codesign::cli {

/// Opens a file for writing; called before the computation, so that a bad path is reported at once. @param option the option with the path.
/// @throws InputError that names the option, if the file cannot be opened.
void open_output(const std::string& path, const std::string& option, std::ofstream* file);

/// Checks that an output does not replace a file that is read, by its own path, a link or another path to the same file.
/// @param option the option with the path. @param what the output, for the message. @throws InputError
void require_no_input(const std::string& path, const std::string& option, const std::string& what, const std::vector<std::string>& inputs);

/// Creates a folder and the folders above it. @throws InputError that names the option, if that fails.
void make_folder(const std::string& path, const std::string& option);

}  // namespace codesign::cli
