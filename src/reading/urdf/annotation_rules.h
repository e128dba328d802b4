// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_ANNOTATION_RULES_H_
#define MECHANISM_CODESIGN_READING_URDF_ANNOTATION_RULES_H_

#include <string>
#include <vector>

namespace codesign {

/// What may stand in one kind of element, as doc/annotations.md tells users.
struct ElementRule {
  std::string path;                   ///< tags from `robot` down
  bool strict = false;                ///< nothing may stand here but what this rule lists; else only prefixed names are looked at
  std::vector<std::string> plain;     ///< attributes without a twin
  std::vector<std::string> twins;     ///< attributes that may have a twin
  std::vector<std::string> own;       ///< our attributes that are no twins, without the prefix
  std::vector<std::string> children;  ///< strict: all; else the prefixed ones
};

/// The rule of a path such as `robot/joint/origin`; null for elements of others.
const ElementRule* find_rule(const std::string& path);

/// Every prefixed element name there is.
std::vector<std::string> annotation_elements();

/// The elements that an annotation may stand in: `<joint>`, `<loop>`.
std::vector<std::string> places_of(const std::string& annotation);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_ANNOTATION_RULES_H_
