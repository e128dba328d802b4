// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/pictures.h"

#include <cstdlib>
#include <sstream>
#include <string_view>
#include <system_error>

namespace codesign {
namespace {

namespace fs = std::filesystem;

constexpr int kLevels = 3;
constexpr std::string_view kPackage = "package://", kFile = "file://";

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

/// A folder of this name at most so many levels below `root`; the nearest one. Empty: there is
/// none.
fs::path below(const fs::path& root, const std::string& name, int levels) {
  if (levels == 0) return {};
  if (is_folder(root / name)) return root / name;
  std::error_code ignored;
  for (fs::directory_iterator entry(root, fs::directory_options::skip_permission_denied, ignored),
       end;
       !ignored && entry != end; entry.increment(ignored)) {
    if (!is_folder(entry->path())) continue;
    const fs::path found = below(entry->path(), name, levels - 1);
    if (!found.empty()) return found;
  }
  return {};
}

fs::path find_package(const std::string& name) {
  const char* const path = std::getenv("ROS_PACKAGE_PATH");
  if (path == nullptr || name.empty()) return {};
  for (int levels = 1; levels <= kLevels; ++levels) {
    std::istringstream entries(path);
    for (std::string entry; std::getline(entries, entry, ':');) {
      if (entry.empty()) continue;
      if (fs::path(entry).filename() == name && is_folder(entry)) return entry;
      const fs::path found = below(entry, name, levels);
      if (!found.empty()) return found;
    }
  }
  return {};
}

bool begins_with(const std::string& text, std::string_view start) {
  return text.compare(0, start.size(), start) == 0;
}

}  // namespace

const fs::path& MeshFinder::folder_of(const std::string& package) {
  const auto found = folders_.find(package);
  return found != folders_.end() ? found->second
                                 : folders_.emplace(package, find_package(package)).first->second;
}

bool MeshFinder::is_there(const std::string& uri) {
  const bool is_elsewhere = uri.find("://") != std::string::npos && !begins_with(uri, kFile) &&
                            !begins_with(uri, kPackage);
  return is_elsewhere || !path_of(uri).empty();
}

fs::path MeshFinder::path_of(const std::string& uri) {
  std::error_code ignored;
  fs::path path;
  if (begins_with(uri, kFile)) path = uri.substr(kFile.size());
  if (begins_with(uri, kPackage)) {
    const std::string rest = uri.substr(kPackage.size());
    const std::size_t slash = rest.find('/');
    if (slash == std::string::npos) return {};
    const fs::path& folder = folder_of(rest.substr(0, slash));
    if (!folder.empty()) path = folder / rest.substr(slash + 1);
  }
  return fs::is_regular_file(path, ignored) ? path : fs::path();
}

}  // namespace codesign
