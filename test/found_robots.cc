// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "found_robots.h"

#include <algorithm>

#include "paths.h"

namespace codesign {

std::vector<std::filesystem::path> found_robots() {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(source_dir()).parent_path() / "shared" / "corpus" / "urdf";
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".urdf") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace codesign
