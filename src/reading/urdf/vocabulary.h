// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace codesign {

/// The attributes and children of one kind of URDF element, without our annotations (ElementRule).
struct Vocabulary {
  using Names = std::vector<std::string>;
  std::string path;  ///< tags from `robot` down, separated by slashes
  Names attributes;  ///< that urdfdom reads
  Names children;    ///< that urdfdom reads
  /// that other tools read: Gazebo, Bullet, Drake, Isaac, later releases of urdfdom
  Names other_attributes;
  Names other_children;          ///< likewise
  bool repeats_children = true;  ///< false: readers use only the first child with a tag
  /// Attributes of other tools that repeat another one, and that one.
  std::vector<std::pair<std::string, std::string>> repeats = {};
};

/// Each row of a table of one of these by its path; every element of a file is looked up.
template <class Row>
std::unordered_map<std::string, const Row*> by_path(const std::vector<Row>& rows) {
  std::unordered_map<std::string, const Row*> result;
  for (const Row& row : rows) result.emplace(row.path, &row);
  return result;
}

/// The vocabulary of a path such as `robot/joint/limit`; null for elements that are not URDF's,
/// which may contain anything.
const Vocabulary* find_vocabulary(const std::string& path);

/// The URDF elements that may have a child with this tag, for example "<visual>", "<collision>";
/// empty if URDF does not have the tag.
std::vector<std::string> elements_with(const std::string& child);

/// The attributes and children that one kind of element may have; doc/annotations.md describes them
/// for users.
struct ElementRule {
  std::string path;  ///< tags from `robot` down, separated by slashes
  /// only the listed names are allowed; else only names with the prefix `codesign:` are checked
  bool strict = false;
  std::vector<std::string> plain;  ///< attributes that cannot depend on parameters
  /// attributes that may have a twin `codesign:...` with an expression
  std::vector<std::string> twins;
  /// attributes with the prefix that are not twins; listed without the prefix
  std::vector<std::string> own;
  /// all allowed children if strict, else the allowed children with the prefix
  std::vector<std::string> children;
};

/// The number of words of an attribute that may have a twin.
std::size_t words_of(const std::string& attribute);

/// The rule for a path such as `robot/joint/origin`; null if elements of this path have no
/// annotations.
const ElementRule* find_rule(const std::string& path);

/// The names of all elements with the prefix `codesign:`.
std::vector<std::string> annotation_elements();

/// The elements that an annotation may be a child of, for example `<joint>`, `<loop>`.
std::vector<std::string> places_of(const std::string& annotation);

}  // namespace codesign
