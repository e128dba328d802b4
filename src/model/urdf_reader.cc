// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/model/urdf_reader.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "annotated_urdf.h"

namespace codesign {

SourceText read_source(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError({{path, 0}, "", "this is a folder", "", "a file"});
  if (!std::filesystem::exists(path, error)) throw InputError({{path, 0}, "", "there is no such file", "", ""});
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && file.peek() == std::ifstream::traits_type::eof()) throw InputError({{path, 1}, "", "the file is empty", "", ""});
  text << file.rdbuf();
  if (!file || text.fail()) throw InputError({{path, 0}, "", "the file cannot be read", "", ""});
  return {path, text.str()};
}

RobotDescription read_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays) {
  return read_robot(load_annotated_urdf(urdf, overlays));
}

}  // namespace codesign
