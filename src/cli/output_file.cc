// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/output_file.h"

#include <filesystem>
#include <system_error>

#include "mechanism_codesign/error.h"

namespace codesign::cli {

void open_output(const std::string& path, const std::string& option, std::ofstream* file) {
  file->open(path, std::ios::binary);
  if (!*file)
    throw InputError({{path, 0}, option, "the file cannot be written", path, "a path in a folder that exists and may be written to"});
}

void make_folder(const std::string& path, const std::string& option) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path))
    throw InputError({{path, 0}, option, "the folder cannot be created", path, "a folder that exists or can be created"});
}

}  // namespace codesign::cli
