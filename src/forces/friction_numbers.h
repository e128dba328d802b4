// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// The numbers of `<codesign:friction>` in SI units; doc/annotations.md describes them. Value is
/// Quantity in a description, which may depend on parameters, and a scalar in a design. To add a
/// number, add a member here and a row in visit_friction_numbers(); the reader, the checks and the
/// evaluation of designs go through these rows.
template <class Value>
struct FrictionNumbers {
  Value mu_static{0.0};            ///< mu_s [-]
  Value mu_dynamic{0.0};           ///< mu_d [-]
  Value transition_velocity{1.0};  ///< v_t [m/s]
  Value joint_length{1.0};         ///< a [m]
  Value joint_width{1.0};          ///< b [m]
  Value pin_radius{
      0.0};  ///< r_e [m], arm of the friction of forces across the axis; radius of a ball
  Value friction_arm{0.0};       ///< r_z [m], arm of the friction of the axial force
  Value preload{0.0};            ///< N_0 [N], constant part of the normal force
  Value smoothing{1.0};          ///< epsilon of the smooth absolute value [N]
  Value viscous{0.0};            ///< c [N s/m] or [N m s/rad], viscous coefficient of (13)
  Value bristle_stiffness{1.0};  ///< sigma_0 [1/m], per normal force
  Value bristle_damping{1.0};    ///< sigma_1 [s/m], per normal force
  Value dwell_time{1.0};         ///< tau_dw [s]
  // Against the joint's axis, theory (48).
  Value mu_static_backward{0.0};   ///< mu_s [-]
  Value mu_dynamic_backward{0.0};  ///< mu_d [-]
  Value viscous_backward{0.0};     ///< c [N s/m] or [N m s/rad]
};

/// The rule for one attribute of `<codesign:friction>`.
struct FrictionNumberRule {
  /// The value of a missing attribute: none (it is required), `standard`, 1, or the value of
  /// another attribute. A joint whose length or width is missing has a law without them; the value
  /// 1 only keeps quotients finite.
  enum class Missing {
    kRefused,
    kStandard,
    kLengthOfOne,
    kPinRadius,
    kMuStatic,
    kMuDynamic,
    kViscous
  };
  /// The friction laws that use the number: all, those with bristles, with a dwell state, with
  /// numbers for motion against the axis.
  enum class Laws { kAll, kBristles, kDwelling, kDirectional };

  const char* attribute;
  bool zero_allowed;  ///< whether zero is allowed; negative values never are
  Missing missing = Missing::kStandard;
  double standard = 0.0;
  Laws laws = Laws::kAll;

  /// Whether the number counts for motion against the joint's axis only.
  bool is_backward() const {
    return missing == Missing::kMuStatic || missing == Missing::kMuDynamic ||
           missing == Missing::kViscous;
  }
};

/// Calls visit(rule, member of each structure...) for each number, in the order in which they are
/// read. @param of structures whose members of the same name are visited together.
template <class Visit, class... Values>
void visit_friction_numbers(const Visit& visit, Values*... of) {
  using M = FrictionNumberRule::Missing;
  using U = FrictionNumberRule::Laws;
  visit(FrictionNumberRule{"mu_static", true, M::kRefused}, of->mu_static...);
  visit(FrictionNumberRule{"mu_dynamic", true, M::kRefused}, of->mu_dynamic...);
  visit(FrictionNumberRule{"transition_velocity", false, M::kStandard, 1e-2},
        of->transition_velocity...);
  visit(FrictionNumberRule{"joint_length", false, M::kLengthOfOne}, of->joint_length...);
  visit(FrictionNumberRule{"joint_width", false, M::kLengthOfOne}, of->joint_width...);
  visit(FrictionNumberRule{"pin_radius", false}, of->pin_radius...);
  visit(FrictionNumberRule{"friction_arm", false, M::kPinRadius}, of->friction_arm...);
  visit(FrictionNumberRule{"preload", true}, of->preload...);
  visit(FrictionNumberRule{"smoothing", false, M::kStandard, 1e-3}, of->smoothing...);
  visit(FrictionNumberRule{"viscous", true}, of->viscous...);
  visit(FrictionNumberRule{"bristle_stiffness", false, M::kStandard, 1e4, U::kBristles},
        of->bristle_stiffness...);
  visit(FrictionNumberRule{"bristle_damping", false, M::kStandard, 10.0, U::kBristles},
        of->bristle_damping...);
  visit(FrictionNumberRule{"dwell_time", false, M::kStandard, 2.0, U::kDwelling},
        of->dwell_time...);
  visit(FrictionNumberRule{"mu_static_backward", true, M::kMuStatic, 0.0, U::kDirectional},
        of->mu_static_backward...);
  visit(FrictionNumberRule{"mu_dynamic_backward", true, M::kMuDynamic, 0.0, U::kDirectional},
        of->mu_dynamic_backward...);
  visit(FrictionNumberRule{"viscous_backward", true, M::kViscous}, of->viscous_backward...);
}

/// The numbers of a friction law at one design.
template <class T>
using FrictionConstants = FrictionNumbers<T>;

}  // namespace codesign
