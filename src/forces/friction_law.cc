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

constexpr FrictionLaw make_row(const char* name, const char* title) {
  FrictionLaw law;
  law.name = name;
  law.title = title;
  return law;
}

constexpr FrictionLaw brown_mcphee_law() {
  FrictionLaw law = make_row("brown_mcphee", "Brown and McPhee");
  law.curve = {brown_mcphee_curve, brown_mcphee_curve};
  law.per_speed = {friction_per_speed, friction_per_speed};
  law.directional = true;
  return law;
}

constexpr FrictionLaw gonthier_law() {
  FrictionLaw law = make_row("gonthier", "Gonthier");
  law.bristle = {gonthier, gonthier};
  law.dwells = true;
  law.steady = {steady_gonthier, steady_gonthier};
  return law;
}

constexpr FrictionLaw lugre_law() {
  FrictionLaw law = make_row("lugre", "LuGre");
  law.bristle = {lugre, lugre};
  law.divides_by_mu_dynamic = true;
  law.only_above_mu_dynamic = true;
  law.steady = {steady_lugre, steady_lugre};
  return law;
}

constexpr FrictionLaw stribeck_law() {
  FrictionLaw law = make_row("stribeck", "Stribeck");
  law.curve = {stribeck, stribeck};
  law.directional = true;
  law.has_stribeck_velocity = true;
  return law;
}

constexpr FrictionLaw kFrictionTable[] = {brown_mcphee_law(), gonthier_law(), lugre_law(),
                                          stribeck_law()};

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
