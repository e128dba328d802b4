// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/source_text.h"

#include <array>
#include <filesystem>
#include <fstream>

#include "mechanism_codesign/error.h"

namespace codesign {

SourceText read_source(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError({{path, 0}, "", "this is a folder", "", "a file"});
  if (!std::filesystem::exists(path, error)) throw InputError({{path, 0}, "", "there is no such file", "", ""});
  std::ifstream file(path, std::ios::binary);
  if (file && file.peek() == std::ifstream::traits_type::eof()) throw InputError({{path, 1}, "", "the file is empty", "", ""});
  if (!file) throw InputError({{path, 0}, "", "the file cannot be read", "", ""});
  // Devices and pipes may never end.
  constexpr std::size_t kMost = 32000000;
  std::string text;
  std::array<char, 65536> block;
  while (file.read(block.data(), block.size()), file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > kMost) throw InputError({{path, 1}, "", "the file is too large", "", "at most 32 MB"});
  }
  if (file.bad()) throw InputError({{path, 0}, "", "the file cannot be read", "", ""});
  return {path, text};
}

}  // namespace codesign
