// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/named_file.h"

#include <filesystem>

namespace codesign {

std::string path_of(const FileAddress& address, const std::string& folder) {
  const std::filesystem::path path(address.file);
  if (path.is_absolute()) return address.file;
  if (folder.empty())
    throw InputError(
        {address.where, address.element,
         "a relative path is allowed only in a study file, not in a study on the parameter server",
         address.file, "an absolute path"});
  return (std::filesystem::path(folder) / path).lexically_normal().string();
}

FileLoader files_in(const std::string& folder) {
  return [folder](const FileAddress& address) {
    const std::string path = path_of(address, folder);
    try {
      return read_source(path);
    } catch (const InputError& error) {
      throw InputError(
          {address.where, address.element, error.fault().message, path, error.fault().allowed});
    }
  };
}

FileLoader files_beside(const std::string& study) {
  return files_in(std::filesystem::absolute(study).parent_path().string());
}

}  // namespace codesign
