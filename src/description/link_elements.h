// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/robot.h"
#include "description/signal_table.h"

namespace codesign {

/// A kind of elements between two links, which a model names and which have signals.
struct LinkElementKind {
  SignalOwner owner;
  const char* tag;   ///< of its elements in the model
  const char* word;  ///< for messages: "spring"
  /// Whether one may have the name of a link, joint or element of another kind: the quantity of a
  /// signal then tells them apart.
  bool shares_names;
};

/// Calls visit(kind, list of RobotDescription) for each kind. A new kind has a row here, and one of
/// its values in elements/link_elements.h; doc/architecture.md says what else it needs.
template <class Robot, class Visit>
void for_each_link_element_kind(Robot& robot, const Visit& visit) {
  visit(LinkElementKind{SignalOwner::kSpring, "codesign:spring_damper", "spring", true},
        robot.spring_dampers);
  visit(LinkElementKind{SignalOwner::kContact, "codesign:contact", "contact", false},
        robot.contacts);
}

/// The tags of all kinds.
inline std::vector<std::string> link_element_tags() {
  std::vector<std::string> tags;
  const RobotDescription robot;
  for_each_link_element_kind(
      robot, [&tags](const LinkElementKind& kind, const auto&) { tags.emplace_back(kind.tag); });
  return tags;
}

}  // namespace codesign
