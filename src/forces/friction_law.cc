// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/friction_law.h"

#include <iterator>

#include "codegen/traced.h"
#include "forces/bristles.h"
#include "forces/friction_curves.h"

namespace codesign {

namespace {

// name, title, curve, per_speed, bristle, dwells, directional, divides_by_mu_dynamic
constexpr FrictionLaw kFrictionTable[] = {
    {"brown_mcphee",
     "Brown and McPhee",
     {brown_mcphee, brown_mcphee},
     {friction_per_speed, friction_per_speed},
     {},
     false,
     true,
     false},
    {"gonthier", "Gonthier", {}, {}, {gonthier, gonthier}, true, false, false},
    {"lugre", "LuGre", {}, {}, {lugre, lugre}, false, false, true},
};

}  // namespace

const FrictionModel FrictionModel::kBrownMcPhee{kFrictionTable[0]},
    FrictionModel::kGonthier{kFrictionTable[1]}, FrictionModel::kLuGre{kFrictionTable[2]};

std::vector<FrictionModel> friction_laws() {
  return std::vector<FrictionModel>(std::begin(kFrictionTable), std::end(kFrictionTable));
}

}  // namespace codesign
