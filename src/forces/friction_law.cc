// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/friction_law.h"

#include <iterator>
#include <string_view>

#include "codegen/traced.h"
#include "forces/bristles.h"
#include "forces/friction_curves.h"

namespace codesign {

namespace {

template <class T>
T brown_mcphee_curve(const T& v, const T& mu_static, const T& mu_dynamic,
                     const FrictionNumbers<T>& c) {
  return brown_mcphee(v, mu_static, mu_dynamic, c.transition_velocity);
}

// name, title, curve, per_speed, bristle, dwells, directional, divides_by_mu_dynamic,
// has_stribeck_velocity, only_above_mu_dynamic, steady
constexpr FrictionLaw kFrictionTable[] = {
    {"brown_mcphee",
     "Brown and McPhee",
     {brown_mcphee_curve, brown_mcphee_curve},
     {friction_per_speed, friction_per_speed},
     {},
     false,
     true,
     false},
    {"gonthier",
     "Gonthier",
     {},
     {},
     {gonthier, gonthier},
     true,
     false,
     false,
     false,
     false,
     {steady_gonthier, steady_gonthier}},
    {"lugre",
     "LuGre",
     {},
     {},
     {lugre, lugre},
     false,
     false,
     true,
     false,
     true,
     {steady_lugre, steady_lugre}},
    {"stribeck", "Stribeck", {stribeck, stribeck}, {}, {}, false, true, false, true},
};

}  // namespace

static_assert(std::string_view(kFrictionTable[0].name) == "brown_mcphee" &&
                  std::string_view(kFrictionTable[3].name) == "stribeck",
              "the constants below count rows: append new ones");
const FrictionModel FrictionModel::kBrownMcPhee{kFrictionTable[0]},
    FrictionModel::kGonthier{kFrictionTable[1]}, FrictionModel::kLuGre{kFrictionTable[2]},
    FrictionModel::kStribeck{kFrictionTable[3]};

std::vector<FrictionModel> friction_laws() {
  return std::vector<FrictionModel>(std::begin(kFrictionTable), std::end(kFrictionTable));
}

}  // namespace codesign
