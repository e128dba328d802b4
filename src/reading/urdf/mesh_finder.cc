// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/pictures.h"

#include <cstdlib>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <string_view>
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

constexpr std::string_view kPackage = "package://", kModel = "model://", kFile = "file://";

bool begins_with(const std::string& text, std::string_view start) {
  return text.compare(0, start.size(), start) == 0;
}

fs::path if_there(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) ? path : fs::path();
}

/// The package and the path in it of a file with one of the schemes.
std::optional<PackageFile> file_of_package(const std::string& uri,
                                           std::initializer_list<std::string_view> schemes) {
  for (const std::string_view scheme : schemes) {
    const std::size_t slash = begins_with(uri, scheme) ? uri.find('/', scheme.size()) : uri.npos;
    if (slash != uri.npos)
      return PackageFile{uri.substr(scheme.size(), slash - scheme.size()), uri.substr(slash + 1)};
  }
  return {};
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

/// A file below the folder of a package that ROS knows; empty: it is not there.
fs::path MeshFinder::in_package(const PackageFile& file) {
  const fs::path& folder = folder_of(file.package);
  return folder.empty() ? fs::path() : if_there(folder / file.inside);
}

fs::path MeshFinder::find(const std::string& uri, const std::string& model) {
  std::error_code ignored;
  const fs::path of_model = fs::absolute(model, ignored);
  if (uri.find("://") == std::string::npos) return if_there(of_model.parent_path() / uri);
  if (begins_with(uri, kFile)) return if_there(uri.substr(kFile.size()));
  const std::optional<PackageFile> file = file_of_package(uri, {kPackage, kModel});
  if (!file) return {};
  const fs::path around = package_around(of_model, file->package);
  if (!around.empty())
    if (fs::path found = if_there(around / file->inside); !found.empty()) return found;
  return in_package(*file);
}

bool MeshFinder::is_there(const std::string& uri) {
  if (begins_with(uri, kFile)) return !if_there(uri.substr(kFile.size())).empty();
  if (!begins_with(uri, kPackage)) return uri.find("://") != std::string::npos;
  const std::optional<PackageFile> file = file_of_package(uri, {kPackage});
  return file && !in_package(*file).empty();
}

}  // namespace codesign
