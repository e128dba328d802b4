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

void require_no_input(const std::string& path, const std::string& option, const std::string& what, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code error;
    if (std::filesystem::is_regular_file(input, error) && std::filesystem::equivalent(path, input, error))
      throw InputError({{input, 0}, option, what + " would replace this file, which is read", path, "the path of another file"});
  }
}

void make_folder(const std::string& path, const std::string& option) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path))
    throw InputError({{path, 0}, option, "the folder cannot be created", path, "a folder that exists or can be created"});
}

}  // namespace codesign::cli
