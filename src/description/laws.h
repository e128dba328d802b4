// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "forces/control_law.h"
#include "forces/friction_law.h"
#include "joints/joint_law.h"

namespace codesign {

/// The tables of laws whose names a model and its study may use. A program adds a row of its own to a copy of standard_laws() and reads its
/// models with it; the row must outlive everything that is read.
struct Laws {
  std::vector<FrictionModel> friction;
  std::vector<RowReference<JointLaw>> joints;
  std::vector<ControllerKind> controllers;
};

/// The laws of doc/annotations.md and doc/study.md.
const Laws& standard_laws();

/// The friction law of a name; std::nullopt if there is none.
std::optional<FrictionModel> find_friction(const Laws& laws, const std::string& name);
/// The names of a table's rows, in its order.
template <class Row>
std::vector<std::string> names_of(const std::vector<Row>& rows) {
  std::vector<std::string> names;
  for (const Row& row : rows) names.emplace_back(row->name);
  return names;
}

}  // namespace codesign
