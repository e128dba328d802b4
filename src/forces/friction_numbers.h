// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// The numbers of `<codesign:friction>` in SI units; doc/annotations.md describes them. Value is
/// Quantity in a description, which may depend on parameters, and a scalar in a design. To add a
/// number, add a member here and a row in visit_friction_numbers(); the reader, the checks and the
/// evaluation of designs go through these rows.
template <class Value>
struct FrictionNumbers {
  Value mu_static{0.0};            ///< mu_s [-]; direct: `static`, T_s [N or N m]
  Value mu_dynamic{0.0};           ///< mu_d [-]; direct: `coulomb`, T_c [N or N m]
  Value transition_velocity{1.0};  ///< v_t [m/s]; direct: [m/s or rad/s], as v_s
  Value stribeck_velocity{1.0};    ///< v_s [m/s]
  Value joint_length{1.0};         ///< a [m]
  Value joint_width{1.0};          ///< b [m]
  /// r_e [m], arm of the friction of forces across the axis; radius of a ball
  Value pin_radius{0.0};
  Value friction_arm{0.0};       ///< r_z [m], arm of the friction of the axial force
  Value preload{0.0};            ///< N_0 [N], constant part of the normal force
  Value smoothing{1.0};          ///< epsilon of the smooth absolute value [N]
  Value viscous{0.0};            ///< c [N s/m] or [N m s/rad], viscous coefficient of (13)
  Value viscous_exponent{1.0};   ///< a [-], (10a)
  Value bristle_stiffness{1.0};  ///< sigma_0 [1/m], per normal force
  Value bristle_damping{1.0};    ///< sigma_1 [s/m], per normal force
  Value dwell_time{1.0};         ///< tau_dw [s]
  // Against the joint's axis, theory (48).
  Value mu_static_backward{0.0};   ///< mu_s [-]; direct: T_s
  Value mu_dynamic_backward{0.0};  ///< mu_d [-]; direct: T_c
  Value viscous_backward{0.0};     ///< c [N s/m] or [N m s/rad]
};

/// The rule for one attribute of `<codesign:friction>`. Friction is given by coefficients, over the
/// normal force of the joint's bearing, or directly in N m or N, theory (10a); mu_static and
/// mu_dynamic have another name in each form.
struct FrictionNumberRule {
  /// The value of a missing attribute: none (it is required), `standard`, 1, or the value of
  /// another attribute. A joint whose length or width is missing has a law without them; the value
  /// 1 only keeps quotients finite.
  enum class Missing {
    kRefused,
    kStandard,
    kLengthOfOne,
    kOfMachine,  ///< follows the machine, theory (13i); 1 until set_machine_numbers()
    kPinRadius,
    kTenTransitions,
    kMuStatic,
    kMuDynamic,
    kViscous,
    kCoulomb,
    kStatic  ///< `static_backward`: `static` if it is given, else `coulomb_backward`
  };
  /// The friction laws that use the number: all, those with bristles, with a dwell state, with
  /// numbers for motion against the axis, with a Stribeck velocity.
  enum class Laws { kAll, kBristles, kDwelling, kDirectional, kStribeck };
  enum class Form { kAny, kCoefficients, kDirect };

  const char* attribute;
  bool zero_allowed = false;  ///< whether zero is allowed; negative values never are
  Missing missing = Missing::kStandard;
  double standard = 0.0;
  Laws laws = Laws::kAll;
  Form form = Form::kAny;
  bool is_backward = false;  ///< whether it counts for motion against the joint's axis only
  bool of_gears = false;     ///< whether `<codesign:actuator>` has it, too; theory (9b)

  bool is_in(bool direct) const { return form == Form::kAny || (form == Form::kDirect) == direct; }

  // The rule with one member changed, for the rows below.
  constexpr FrictionNumberRule with_zero() const {
    FrictionNumberRule rule = *this;
    rule.zero_allowed = true;
    return rule;
  }
  constexpr FrictionNumberRule if_missing(Missing kind, double value = 0.0) const {
    FrictionNumberRule rule = *this;
    rule.missing = kind;
    rule.standard = value;
    return rule;
  }
  constexpr FrictionNumberRule if_missing(double value) const {
    return if_missing(Missing::kStandard, value);
  }
  constexpr FrictionNumberRule used_by(Laws which) const {
    FrictionNumberRule rule = *this;
    rule.laws = which;
    return rule;
  }
  constexpr FrictionNumberRule in_form(Form which) const {
    FrictionNumberRule rule = *this;
    rule.form = which;
    return rule;
  }
  constexpr FrictionNumberRule against_the_axis() const {
    FrictionNumberRule rule = *this;
    rule.is_backward = true;
    return rule;
  }
  constexpr FrictionNumberRule also_of_gears() const {
    FrictionNumberRule rule = *this;
    rule.of_gears = true;
    return rule;
  }
};

/// Calls visit(rule, member of each structure...) for each number, in the order in which they are
/// read. @param of structures whose members of the same name are visited together.
template <class Visit, class... Values>
void visit_friction_numbers(const Visit& visit, Values*... of) {
  using M = FrictionNumberRule::Missing;
  using U = FrictionNumberRule::Laws;
  using F = FrictionNumberRule::Form;
  using R = FrictionNumberRule;
  visit(R{"mu_static"}.with_zero().if_missing(M::kRefused).in_form(F::kCoefficients),
        of->mu_static...);
  visit(R{"mu_dynamic"}.with_zero().if_missing(M::kRefused).in_form(F::kCoefficients),
        of->mu_dynamic...);
  visit(R{"coulomb"}.with_zero().if_missing(M::kRefused).in_form(F::kDirect), of->mu_dynamic...);
  visit(R{"static"}.with_zero().if_missing(M::kCoulomb).in_form(F::kDirect), of->mu_static...);
  visit(R{"transition_velocity"}.if_missing(1e-2).also_of_gears(), of->transition_velocity...);
  visit(R{"stribeck_velocity"}.if_missing(M::kTenTransitions).used_by(U::kStribeck),
        of->stribeck_velocity...);
  visit(R{"joint_length"}.if_missing(M::kLengthOfOne).in_form(F::kCoefficients),
        of->joint_length...);
  visit(R{"joint_width"}.if_missing(M::kLengthOfOne).in_form(F::kCoefficients), of->joint_width...);
  visit(R{"pin_radius"}.in_form(F::kCoefficients), of->pin_radius...);
  visit(R{"friction_arm"}.if_missing(M::kPinRadius).in_form(F::kCoefficients), of->friction_arm...);
  visit(R{"preload"}.with_zero().in_form(F::kCoefficients), of->preload...);
  visit(R{"smoothing"}.if_missing(M::kOfMachine).in_form(F::kCoefficients).also_of_gears(),
        of->smoothing...);
  visit(R{"viscous"}.with_zero(), of->viscous...);
  visit(R{"viscous_exponent"}.if_missing(1.0), of->viscous_exponent...);
  visit(R{"bristle_stiffness"}.if_missing(1e4).used_by(U::kBristles).also_of_gears(),
        of->bristle_stiffness...);
  visit(R{"bristle_damping"}.if_missing(10.0).used_by(U::kBristles).also_of_gears(),
        of->bristle_damping...);
  visit(R{"dwell_time"}.if_missing(2.0).used_by(U::kDwelling).also_of_gears(), of->dwell_time...);
  const auto backward = [](const char* attribute, M missing, F form) {
    return R{attribute}
        .with_zero()
        .if_missing(missing)
        .used_by(U::kDirectional)
        .in_form(form)
        .against_the_axis();
  };
  visit(backward("mu_static_backward", M::kMuStatic, F::kCoefficients), of->mu_static_backward...);
  visit(backward("mu_dynamic_backward", M::kMuDynamic, F::kCoefficients),
        of->mu_dynamic_backward...);
  visit(backward("coulomb_backward", M::kCoulomb, F::kDirect), of->mu_dynamic_backward...);
  visit(backward("static_backward", M::kStatic, F::kDirect), of->mu_static_backward...);
  visit(R{"viscous_backward"}.with_zero().if_missing(M::kViscous).against_the_axis(),
        of->viscous_backward...);
}

/// The numbers of a friction law at one design.
template <class T>
using FrictionConstants = FrictionNumbers<T>;

}  // namespace codesign
