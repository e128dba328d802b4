// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "description/quantity.h"
#include "forces/friction_law.h"
#include "mechanism_codesign/error.h"

namespace codesign {

/// `<codesign:friction>`. Numbers that the model does not give keep the `standard` of their rule; lengths and arms are then zero.
struct FrictionDescription : FrictionNumbers<Quantity> {
  FrictionDescription() {
    visit_friction_numbers([](const FrictionNumberRule& rule, Quantity& number) { number = Quantity(rule.standard); }, this);
  }

  FrictionModel model = FrictionModel::kBrownMcPhee;
  bool is_directional = false;                           ///< a number for motion against the axis is given; else they are unused
  std::optional<std::array<double, 3>> transverse_axis;  ///< x'' in the joint frame
  SourceLocation where;
};

}  // namespace codesign
