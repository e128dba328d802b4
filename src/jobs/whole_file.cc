// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>

#include "jobs/output_error.h"

namespace codesign {

void write_whole_file(const std::string& path, const std::string& text) {
  const std::string part = path + kPartSuffix;
  errno = 0;
  std::ofstream file(part, std::ios::binary);
  file << text;
  file.close();
  if (!file || std::rename(part.c_str(), path.c_str()) != 0) {
    const int cause = errno;
    unlink(part.c_str());
    throw OutputError::of_system(path, cause);
  }
}

void give_final_name(const std::string& active, const std::string& path) {
  // link() never replaces an existing file. rename() is used on file systems without link().
  if (link(active.c_str(), path.c_str()) == 0) {
    unlink(active.c_str());
    return;
  }
  const int cause = errno;
  if (cause == EEXIST) throw OutputError::of_system(path, cause);
  if (std::rename(active.c_str(), path.c_str()) != 0) throw OutputError::of_system(path, errno);
}

}  // namespace codesign
