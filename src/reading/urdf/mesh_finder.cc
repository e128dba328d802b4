// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/pictures.h"

#include <cstdlib>
#include <sstream>
#include <system_error>

namespace codesign {
namespace {

namespace fs = std::filesystem;

constexpr int kLevels = 3;

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

bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

}  // namespace

const fs::path& MeshFinder::folder_of(const std::string& package) {
  const auto found = folders_.find(package);
  return found != folders_.end() ? found->second
                                 : folders_.emplace(package, find_package(package)).first->second;
}

namespace {

/// A package in whose folders a model lies, or beside one of them.
fs::path package_around(const fs::path& model, const std::string& name) {
  for (fs::path folder = model.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    if (folder.filename() == name) return folder;
    if (is_folder(folder / name)) return folder / name;
    if (folder == folder.root_path()) break;
  }
  return {};
}

}  // namespace

fs::path MeshFinder::find(const std::string& uri, const std::string& model) {
  std::error_code ignored;
  const auto if_there = [&ignored](const fs::path& path) {
    return fs::is_regular_file(path, ignored) ? path : fs::path();
  };
  const std::size_t scheme = uri.find("://");
  const fs::path of_model = fs::absolute(model, ignored);
  if (scheme == std::string::npos) return if_there(of_model.parent_path() / uri);
  const std::string rest = uri.substr(scheme + 3);
  if (begins_with(uri, "file://")) return if_there(rest);
  const std::size_t slash = rest.find('/');
  if ((!begins_with(uri, "package://") && !begins_with(uri, "model://")) ||
      slash == std::string::npos)
    return {};
  const std::string package = rest.substr(0, slash), inside = rest.substr(slash + 1);
  const fs::path around = package_around(of_model, package);
  if (!around.empty())
    if (fs::path found = if_there(around / inside); !found.empty()) return found;
  const fs::path& folder = folder_of(package);
  return folder.empty() ? fs::path() : if_there(folder / inside);
}

bool MeshFinder::is_there(const std::string& uri) {
  static const std::string kPackage = "package://", kFile = "file://";
  std::error_code ignored;
  if (begins_with(uri, kFile)) return fs::is_regular_file(uri.substr(kFile.size()), ignored);
  if (!begins_with(uri, kPackage)) return uri.find("://") != std::string::npos;
  const std::string rest = uri.substr(kPackage.size());
  const std::size_t slash = rest.find('/');
  if (slash == std::string::npos) return false;
  const fs::path& folder = folder_of(rest.substr(0, slash));
  return !folder.empty() && fs::is_regular_file(folder / rest.substr(slash + 1), ignored);
}

}  // namespace codesign
