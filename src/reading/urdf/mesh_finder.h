// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace codesign {

/// Tells which meshes a viewer on this machine can load. A package of ROS is a folder of its name at most three levels below an entry of
/// ROS_PACKAGE_PATH, or the entry itself.
class MeshFinder {
 public:
  /// @param uri the filename of a `<mesh>`. Without a scheme (`package://`, `file://`) viewers do not find it. What is on a network counts
  ///     as there.
  bool is_there(const std::string& uri);

 private:
  const std::filesystem::path& folder_of(const std::string& package);

  std::map<std::string, std::filesystem::path> folders_;  ///< of packages; empty: not found
};

}  // namespace codesign
