// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_VOCABULARY_H_
#define MECHANISM_CODESIGN_READING_URDF_VOCABULARY_H_

#include <string>
#include <vector>

namespace codesign {

/// The names that URDF knows in one kind of element, without those of doc/annotations.md.
struct Vocabulary {
  using Names = std::vector<std::string>;
  std::string path;              ///< tags from `robot` down
  Names attributes;              ///< urdfdom reads them
  Names children;                ///< likewise
  Names other_attributes;        ///< other tools read them: Gazebo, Bullet, Drake, later releases of urdfdom
  Names other_children;          ///< likewise
  bool repeats_children = true;  ///< else readers take the first child of a tag alone
};

/// The vocabulary of a path such as `robot/joint/limit`; null for elements of others, which may hold anything.
const Vocabulary* find_vocabulary(const std::string& path);

/// The elements in which URDF knows this tag: "<link>", "<visual>, <collision>"; empty if it is no tag of URDF.
std::vector<std::string> elements_with(const std::string& child);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_VOCABULARY_H_
