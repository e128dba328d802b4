// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_OUTPUT_FILE_H_
#define MECHANISM_CODESIGN_CLI_OUTPUT_FILE_H_

#include <fstream>
#include <string>

namespace codesign::cli {

/// Opens a file for writing; called before the computation, so that a bad path is reported at once. @param option the option with the path.
/// @throws InputError that names the option, if the file cannot be opened.
void open_output(const std::string& path, const std::string& option, std::ofstream* file);

/// Creates a folder and the folders above it. @throws InputError that names the option, if that fails.
void make_folder(const std::string& path, const std::string& option);

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_OUTPUT_FILE_H_
