// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "description/quantity.h"
#include "mechanism_codesign/error.h"

namespace codesign {

/// The friction laws: theory (10), (13e) and (13f). The laws of Gonthier and LuGre have states.
enum class FrictionModel { kBrownMcPhee, kGonthier, kLuGre };
/// The spelling of each in files, in the order of the enumerators.
constexpr std::array<const char*, 3> kFrictionModelNames{"brown_mcphee", "gonthier", "lugre"};
/// The law of a name; std::nullopt if there is none.
inline std::optional<FrictionModel> friction_model(const std::string& name) {
  for (std::size_t k = 0; k < kFrictionModelNames.size(); ++k)
    if (name == kFrictionModelNames[k]) return static_cast<FrictionModel>(k);
  return std::nullopt;
}

/// The numbers of `<codesign:friction>` in SI units; doc/annotations.md describes them. Value is Quantity in a description, which may
/// depend on parameters, and a scalar in a design. To add a number, add a member here and a row in visit_friction_numbers(); the reader,
/// the checks and the evaluation of designs go through these rows.
template <class Value>
struct FrictionNumbers {
  Value mu_static{0.0};            ///< mu_s [-]
  Value mu_dynamic{0.0};           ///< mu_d [-]
  Value transition_velocity{1.0};  ///< v_t [m/s]
  Value joint_length{1.0};         ///< a [m]
  Value joint_width{1.0};          ///< b [m]
  Value pin_radius{0.0};           ///< r_e [m], arm of the friction of forces across the axis; radius of a ball
  Value friction_arm{0.0};         ///< r_z [m], arm of the friction of the axial force
  Value preload{0.0};              ///< N_0 [N], constant part of the normal force
  Value smoothing{1.0};            ///< epsilon of the smooth absolute value [N]
  Value viscous{0.0};              ///< c [N s/m] or [N m s/rad], viscous coefficient of (13)
  Value bristle_stiffness{1.0};    ///< sigma_0 [1/m], per normal force
  Value bristle_damping{1.0};      ///< sigma_1 [s/m], per normal force
  Value dwell_time{1.0};           ///< tau_dw [s]
  // Against the joint's axis, theory (48).
  Value mu_static_backward{0.0};   ///< mu_s [-]
  Value mu_dynamic_backward{0.0};  ///< mu_d [-]
  Value viscous_backward{0.0};     ///< c [N s/m] or [N m s/rad]
};

/// The rule for one attribute of `<codesign:friction>`.
struct FrictionNumberRule {
  /// The value of a missing attribute: none (it is required), `standard`, 1, or the value of another attribute. A joint whose length or
  /// width is missing has a law without them; the value 1 only keeps quotients finite.
  enum class Missing { kRefused, kStandard, kLengthOfOne, kPinRadius, kMuStatic, kMuDynamic, kViscous };
  /// The friction laws that use the number.
  enum class Models { kAll, kWithStates, kGonthierOnly, kBrownMcPheeOnly };

  const char* attribute;
  bool zero_allowed;  ///< whether zero is allowed; negative values never are
  Missing missing = Missing::kStandard;
  double standard = 0.0;
  Models models = Models::kAll;

  bool is_used_by(FrictionModel model) const {
    if (models == Models::kAll) return true;
    if (models == Models::kBrownMcPheeOnly) return model == FrictionModel::kBrownMcPhee;
    return model == FrictionModel::kGonthier || (models == Models::kWithStates && model == FrictionModel::kLuGre);
  }
  /// Whether the number counts for motion against the joint's axis only.
  bool is_backward() const { return missing == Missing::kMuStatic || missing == Missing::kMuDynamic || missing == Missing::kViscous; }
};

/// Calls visit(rule, member of each structure...) for each number, in the order in which they are read. @param of structures whose members
/// of the same name are visited together.
template <class Visit, class... Values>
void visit_friction_numbers(const Visit& visit, Values*... of) {
  using M = FrictionNumberRule::Missing;
  using U = FrictionNumberRule::Models;
  visit(FrictionNumberRule{"mu_static", true, M::kRefused}, of->mu_static...);
  visit(FrictionNumberRule{"mu_dynamic", true, M::kRefused}, of->mu_dynamic...);
  visit(FrictionNumberRule{"transition_velocity", false, M::kStandard, 1e-2}, of->transition_velocity...);
  visit(FrictionNumberRule{"joint_length", false, M::kLengthOfOne}, of->joint_length...);
  visit(FrictionNumberRule{"joint_width", false, M::kLengthOfOne}, of->joint_width...);
  visit(FrictionNumberRule{"pin_radius", false}, of->pin_radius...);
  visit(FrictionNumberRule{"friction_arm", false, M::kPinRadius}, of->friction_arm...);
  visit(FrictionNumberRule{"preload", true}, of->preload...);
  visit(FrictionNumberRule{"smoothing", false, M::kStandard, 1e-3}, of->smoothing...);
  visit(FrictionNumberRule{"viscous", true}, of->viscous...);
  visit(FrictionNumberRule{"bristle_stiffness", false, M::kStandard, 1e4, U::kWithStates}, of->bristle_stiffness...);
  visit(FrictionNumberRule{"bristle_damping", false, M::kStandard, 10.0, U::kWithStates}, of->bristle_damping...);
  visit(FrictionNumberRule{"dwell_time", false, M::kStandard, 2.0, U::kGonthierOnly}, of->dwell_time...);
  visit(FrictionNumberRule{"mu_static_backward", true, M::kMuStatic, 0.0, U::kBrownMcPheeOnly}, of->mu_static_backward...);
  visit(FrictionNumberRule{"mu_dynamic_backward", true, M::kMuDynamic, 0.0, U::kBrownMcPheeOnly}, of->mu_dynamic_backward...);
  visit(FrictionNumberRule{"viscous_backward", true, M::kViscous}, of->viscous_backward...);
}

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
