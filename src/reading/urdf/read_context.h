// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "description/robot.h"
#include "reading/urdf/twin.h"

namespace codesign {

/// The names that readers of joints, loops and springs refer to, and where they put warnings.
struct ReadContext {
  std::vector<std::string> links;  ///< names, in the order of RobotDescription::links
  ParameterTable table;
  Warnings* warnings = nullptr;         ///< never null while a robot is read
  const Laws* laws = &standard_laws();  ///< never null

  /// Index of the link that `attribute` names. @throws InputError naming the link with the nearest name.
  int link(const XmlElement& element, const std::string& attribute) const;
  /// The links of `<predecessor link>` and `<successor link>`. @throws InputError if they are the same.
  std::pair<int, int> ends(const XmlElement& element) const;
};

}  // namespace codesign
