// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace codesign {

/// The attributes and children of one kind of URDF element, without our annotations (annotation_rules.h).
struct Vocabulary {
  using Names = std::vector<std::string>;
  std::string path;              ///< tags from `robot` down, separated by slashes
  Names attributes;              ///< that urdfdom reads
  Names children;                ///< that urdfdom reads
  Names other_attributes;        ///< that other tools read: Gazebo, Bullet, Drake, later releases of urdfdom
  Names other_children;          ///< likewise
  bool repeats_children = true;  ///< false: readers use only the first child with a tag
};

/// The vocabulary of a path such as `robot/joint/limit`; null for elements that are not URDF's, which may contain anything.
const Vocabulary* find_vocabulary(const std::string& path);

/// The URDF elements that may have a child with this tag, for example "<visual>", "<collision>"; empty if URDF does not have the tag.
std::vector<std::string> elements_with(const std::string& child);

}  // namespace codesign
