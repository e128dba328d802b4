// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_OUTPUT_FILE_H_
#define MECHANISM_CODESIGN_CLI_OUTPUT_FILE_H_

#include <fstream>
#include <string>

namespace codesign::cli {

/// Opens a file to write to, before anything is computed. @throws InputError naming the option that asked for it, if that cannot be.
void open_output(const std::string& path, const std::string& option, std::ofstream* file);

/// Makes a folder and those above it. @throws InputError if that cannot be.
void make_folder(const std::string& path, const std::string& option);

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_OUTPUT_FILE_H_
