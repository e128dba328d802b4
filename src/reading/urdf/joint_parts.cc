// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/joint_reader.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "math/scalar.h"
#include "reading/urdf/quantity_reader.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

FrictionModel read_model(const XmlElement& element, bool direct, const Laws& laws) {
  const std::string name = element.find("model").value_or(direct ? "stribeck" : "brown_mcphee");
  if (const auto law = find_friction(laws, name)) return *law;
  throw unknown_name(element.where("model"), element.label(), "friction model", name,
                     names_of(laws.friction));
}

/// The number that counts where an attribute is missing.
const Quantity& value_if_missing(const XmlElement& element, const FrictionNumberRule& rule,
                                 const FrictionDescription& friction, const Quantity& standard) {
  switch (rule.missing) {
    case FrictionNumberRule::Missing::kPinRadius:
      return friction.pin_radius;
    case FrictionNumberRule::Missing::kMuStatic:
      return friction.mu_static;
    case FrictionNumberRule::Missing::kMuDynamic:
    case FrictionNumberRule::Missing::kCoulomb:
      return friction.mu_dynamic;
    case FrictionNumberRule::Missing::kStatic:
      return element.has("static") ? friction.mu_static : friction.mu_dynamic_backward;
    case FrictionNumberRule::Missing::kViscous:
      return friction.viscous;
    case FrictionNumberRule::Missing::kRefused:
    case FrictionNumberRule::Missing::kStandard:
    case FrictionNumberRule::Missing::kLengthOfOne:
    case FrictionNumberRule::Missing::kOfMachine:
    case FrictionNumberRule::Missing::kTenTransitions:
      break;
  }
  return standard;
}

/// The models that use a number, for messages.
std::string models_of(const FrictionNumberRule& rule, const Laws& laws) {
  std::string models;
  for (const FrictionModel& law : laws.friction)
    if (law->uses(rule))
      models += (models.empty() ? "with model=\"" : " or model=\"") + std::string(law->name) + "\"";
  return models;
}

void require_ordered(const XmlElement& element, const std::string& dynamic_name,
                     const Quantity& dynamic, const std::string& static_name,
                     const Quantity& at_rest) {
  if (dynamic.nominal() > at_rest.nominal())
    element.fail_at(element.has(dynamic_name) ? dynamic_name : static_name,
                    dynamic_name + " is above " + static_name,
                    "at most " + static_name + "=" + to_decimal(at_rest.nominal()));
}

/// A number of the element. An attribute that the model does not use is an error, since it would
/// have no effect.
void read_number(const XmlElement& element, const FrictionNumberRule& rule,
                 const ReadContext& context, FrictionDescription* friction, Quantity* number) {
  if (!rule.is_in(friction->is_direct)) {
    if (element.has(rule.attribute))
      element.fail_at(rule.attribute,
                      std::string(rule.attribute) +
                          (friction->is_direct ? " has no meaning for friction in N m or N"
                                               : " has no meaning for friction by coefficients"),
                      friction->is_direct ? "mu_static and mu_dynamic in place of coulomb"
                                          : "coulomb in place of mu_static and mu_dynamic");
    return;
  }
  if (!friction->model->uses(rule)) {
    if (element.has(rule.attribute))
      element.fail_at(rule.attribute,
                      std::string(rule.attribute) + " has no meaning for this friction model",
                      models_of(rule, *context.laws));
    return;
  }
  const Range range = rule.zero_allowed ? Range::kNonNegative : Range::kPositive;
  if (rule.missing == FrictionNumberRule::Missing::kRefused)
    *number = read_quantity(element, rule.attribute, range, context.table);
  else
    *number = read_quantity_or(value_if_missing(element, rule, *friction, *number), element,
                               rule.attribute, range, context.table);
  if (rule.is_backward && element.has(rule.attribute)) friction->is_directional = true;
}

/// A transition velocity that shapes only the friction above sliding friction is an error where
/// there is none.
void refuse_transition(const XmlElement& element, const FrictionModel& model,
                       const std::string& reason, const std::string& allowed) {
  if (model->only_above_mu_dynamic && element.has("transition_velocity"))
    element.fail_at("transition_velocity",
                    std::string("transition_velocity has no effect: in the ") + model->title +
                        " model it shapes the friction at rest above that of sliding, " + reason,
                    allowed);
}

}  // namespace

std::array<double, 3> read_transverse_axis(const XmlElement& element, const QuantityVector& axis) {
  const std::vector<Quantity> given =
      parse_quantities(element, "transverse_axis", 3, ParameterTable());
  const std::array<double, 3> result = {given[0].nominal(), given[1].nominal(), given[2].nominal()};
  const Vector3<double> x(result[0], result[1], result[2]),
      z(axis[0].nominal(), axis[1].nominal(), axis[2].nominal());
  if (x.cross(z).norm() <= 1e-6 * x.norm() * z.norm())
    element.fail_at("transverse_axis", "the transverse axis is zero or parallel to the joint axis",
                    "a vector that is not parallel to the joint axis");
  return result;
}

FrictionDescription read_friction(const XmlElement& element, const QuantityVector& axis,
                                  const ReadContext& context) {
  FrictionDescription friction;
  friction.where = element.where();
  friction.is_direct = element.has("coulomb");
  friction.has_exponent = element.has("viscous_exponent");
  friction.model = read_model(element, friction.is_direct, *context.laws);
  const auto read = [&](const FrictionNumberRule& rule, Quantity& number) {
    read_number(element, rule, context, &friction, &number);
  };
  visit_friction_numbers(read, &friction);
  if (friction.is_direct && !element.has("static") && !friction.has_exponent)
    refuse_transition(element, friction.model, "and the friction has no `static`",
                      "beside static or viscous_exponent");
  const std::string dynamic = friction.is_direct ? "coulomb" : "mu_dynamic",
                    at_rest = friction.is_direct ? "static" : "mu_static";
  require_ordered(element, dynamic, friction.mu_dynamic, at_rest, friction.mu_static);
  require_ordered(element, dynamic + "_backward", friction.mu_dynamic_backward,
                  at_rest + "_backward", friction.mu_static_backward);
  if (friction.model->divides_by_mu_dynamic && friction.mu_dynamic.nominal() == 0.0)
    element.fail_at(dynamic,
                    dynamic + " is zero: the " + friction.model->title + " model divides by it",
                    "> 0");
  if (friction.is_direct && element.has("transverse_axis"))
    element.fail_at("transverse_axis", "transverse_axis has no meaning for friction in N m or N",
                    "mu_static and mu_dynamic in place of coulomb");
  if (element.has("transverse_axis"))
    friction.transverse_axis = read_transverse_axis(element, axis);
  return friction;
}

namespace {

Quantity read_at_most_one(const XmlElement& element, const char* attribute, Range range,
                          const ReadContext& context) {
  Quantity number = read_quantity(element, attribute, range, context.table);
  if (number.nominal() > 1.0)
    element.fail_at(attribute, std::string(attribute) + " is above 1: the gear would give power",
                    range == Range::kPositive ? "> 0 and at most 1" : "at most 1");
  return number;
}

/// The law of a gear's flanks: friction per pressure, direct, of 1 in both directions.
FrictionDescription read_slip(const XmlElement& element, const ReadContext& context) {
  FrictionDescription slip;
  slip.where = element.where();
  slip.model = read_model(element, false, *context.laws);
  slip.mu_static = slip.mu_dynamic = 1.0;
  refuse_transition(element, slip.model, "which are the same in gears", "with another model");
  const auto read = [&](const FrictionNumberRule& rule, Quantity& number) {
    if (rule.of_gears) read_number(element, rule, context, &slip, &number);
  };
  visit_friction_numbers(read, &slip);
  slip.is_direct = true;
  return slip;
}

/// The losses of gear and motor; none if no attribute gives them.
std::optional<GearDescription> read_gear(const XmlElement& element, const ReadContext& context) {
  const char* const kLosses = "beside efficiency, coulomb or viscous";
  const auto refuse = [&](const std::string& attribute, const char* allowed) {
    if (element.has(attribute)) element.fail_at(attribute, attribute + " has no effect", allowed);
  };
  if (!element.has("efficiency")) refuse("backdrive_efficiency", "beside efficiency");
  if (!element.has("efficiency") && !element.has("coulomb") && !element.has("viscous")) {
    refuse("model", kLosses);
    visit_friction_numbers([&](const FrictionNumberRule& rule) {
      if (rule.of_gears) refuse(rule.attribute, kLosses);
    });
    return std::nullopt;
  }
  GearDescription gear;
  if (element.has("efficiency"))
    gear.efficiency = read_at_most_one(element, "efficiency", Range::kPositive, context);
  if (element.has("backdrive_efficiency"))
    gear.backdrive_efficiency =
        read_at_most_one(element, "backdrive_efficiency", Range::kAny, context);
  gear.coulomb = read_quantity_or(0.0, element, "coulomb", Range::kNonNegative, context.table);
  gear.viscous = read_quantity_or(0.0, element, "viscous", Range::kNonNegative, context.table);
  gear.slip = read_slip(element, context);
  return gear;
}

/// The compliance of the gear; none if no attribute gives it.
std::optional<ElasticGearDescription> read_elastic_gear(const XmlElement& element,
                                                        const ReadContext& context) {
  if (!element.has("stiffness")) {
    for (const char* attribute : {"damping", "backlash"})
      if (element.has(attribute))
        element.fail_at(attribute,
                        std::string(attribute) +
                            " has no effect in a rigid gear: motor and joint move together",
                        "beside stiffness");
    return std::nullopt;
  }
  ElasticGearDescription elastic;
  elastic.stiffness = read_quantity(element, "stiffness", Range::kPositive, context.table);
  elastic.damping = read_quantity_or(0.0, element, "damping", Range::kNonNegative, context.table);
  if (element.has("backlash"))
    elastic.backlash = read_quantity(element, "backlash", Range::kPositive, context.table);
  return elastic;
}

/// The circuit of the motor; none if no attribute gives it. Only a plain 0 leaves out the state of
/// the current: a parameter must not change the number of states.
std::optional<WindingDescription> read_winding(const XmlElement& element,
                                               const ReadContext& context) {
  if (!element.has("resistance")) {
    for (const char* attribute : {"inductance", "torque_constant", "bus_voltage"})
      if (element.has(attribute))
        element.fail_at(attribute,
                        std::string(attribute) + " has no effect: the motor has no winding",
                        "beside resistance");
    return std::nullopt;
  }
  WindingDescription winding;
  winding.resistance = read_quantity(element, "resistance", Range::kPositive, context.table);
  winding.torque_constant =
      read_quantity(element, "torque_constant", Range::kPositive, context.table);
  winding.inductance =
      read_quantity_or(0.0, element, "inductance", Range::kNonNegative, context.table);
  if (winding.has_state() && winding.inductance.nominal() == 0.0)
    element.fail_at("inductance", "an inductance that depends on a parameter is zero", "> 0, or 0");
  if (element.has("bus_voltage"))
    winding.bus_voltage = read_quantity(element, "bus_voltage", Range::kPositive, context.table);
  return winding;
}

/// Whether no torque of the joint turns the motor, theory (9b).
bool locks_itself(const GearDescription& gear) {
  if (!gear.efficiency) return false;
  if (gear.backdrive_efficiency) return gear.backdrive_efficiency->nominal() <= 0.0;
  return 2.0 - 1.0 / gear.efficiency->nominal() <= 0.0;
}

}  // namespace

ActuatorDescription read_actuator(const XmlElement& element, const JointLaw& law,
                                  const ReadContext& context) {
  if (!law.has_one_coordinate())
    element.fail("a joint of this type has no single coordinate for a rotor", "",
                 "revolute, continuous or prismatic");
  ActuatorDescription actuator;
  actuator.where = element.where();
  actuator.gear_ratio = read_quantity_or(1.0, element, "gear_ratio", Range::kAny, context.table);
  if (actuator.gear_ratio.nominal() == 0.0)
    element.fail_at("gear_ratio", "the gear ratio is zero", "any other number");
  // The armature is the joint's; beside it there need be no rotor.
  if (element.has("armature"))
    actuator.rotor_inertia =
        read_quantity_or(0.0, element, "rotor_inertia", Range::kNonNegative, context.table);
  else
    actuator.rotor_inertia =
        read_quantity(element, "rotor_inertia", Range::kNonNegative, context.table);
  const bool no_inertia = actuator.rotor_inertia.is_zero() && !element.has("armature");
  actuator.gear = read_gear(element, context);
  actuator.elastic = read_elastic_gear(element, context);
  actuator.winding = read_winding(element, context);
  if (actuator.elastic && no_inertia)
    element.fail_at("rotor_inertia",
                    "behind an elastic gear the motor moves by itself, which needs an inertia",
                    "> 0, or an armature, or no stiffness");
  if (no_inertia && actuator.gear && locks_itself(*actuator.gear))
    element.fail_at("rotor_inertia",
                    "a self-locking gear needs the inertia of its motor: without it the joint's "
                    "velocity would jump to zero as soon as a load drives the gear",
                    "> 0, or an armature, or a backdrive_efficiency above 0");
  return actuator;
}

namespace {

constexpr const char* kGearRatio =
    "<codesign:actuator gear_ratio=\"...\">, which makes the transmission irrelevant";

/// The type of a transmission: `<type>NAME</type>`, or the attribute `type` as in PR2's files.
std::string type_of(const XmlElement& transmission) {
  const std::vector<XmlElement> types = transmission.children("type");
  const char* const text = types.empty() ? nullptr : types.front().node()->GetText();
  return text != nullptr ? text : transmission.find("type").value_or("");
}

bool is_simple(const XmlElement& transmission) {
  return ends_with(type_of(transmission), "SimpleTransmission") &&
         transmission.children("joint").size() == 1 &&
         transmission.children("actuator").size() <= 1;
}

/// The reductions of a transmission in order of preference: of `<actuator>`, where ros_control
/// reads it, of `<joint>`, then its own.
std::vector<XmlElement> reductions(const XmlElement& transmission) {
  std::vector<XmlElement> found;
  for (const char* tag : {"actuator", "joint"})
    for (const XmlElement& part : transmission.children(tag))
      for (const XmlElement& reduction : part.children("mechanicalReduction"))
        found.push_back(reduction);
  for (const XmlElement& reduction : transmission.children("mechanicalReduction"))
    found.push_back(reduction);
  return found;
}

class TransmissionReader {
 public:
  TransmissionReader(const XmlElement& element, RobotDescription* robot)
      : robot_(robot), transmissions_(element.children("transmission")) {}

  void read(JointDescription* joint) {
    std::optional<double> ratio;
    for (const XmlElement& transmission : transmissions_) {
      const std::vector<XmlElement> joints = transmission.children("joint");
      if (std::none_of(joints.begin(), joints.end(),
                       [&](const XmlElement& j) { return j.find("name") == joint->name; }))
        continue;
      const std::vector<XmlElement> found = reductions(transmission);
      if (!is_simple(transmission)) {
        if (!found.empty())
          doubt("transmission_not_simple", transmission, type_of(transmission),
                "its reduction is not taken as the gear ratio of joint \"" + joint->name + "\"");
        continue;
      }
      for (const XmlElement& reduction : found) take(reduction, *joint, &ratio);
    }
    if (ratio) joint->actuator->gear_ratio = *ratio;
  }

 private:
  void take(const XmlElement& reduction, const JointDescription& joint,
            std::optional<double>* ratio) {
    const char* const text = reduction.node()->GetText();
    const std::vector<std::string> words = split_words(text != nullptr ? text : "");
    const std::optional<double> number = words.size() == 1 ? parse_number(words[0]) : std::nullopt;
    if (!number || !std::isfinite(*number) || *number == 0.0) {
      doubt("transmission_not_read", reduction, text != nullptr ? text : "",
            "the reduction is not a finite number other than zero and is ignored");
    } else if (!*ratio) {
      *ratio = *number;
    } else if (**ratio != *number) {
      doubt("transmission_contradicts", reduction, text,
            "joint \"" + joint.name + "\" already has the reduction " + to_decimal(**ratio) +
                "; this one is ignored");
    }
  }

  void doubt(const char* code, const XmlElement& at, const std::string& value,
             const std::string& message) {
    robot_->warnings.push_back(warn(code, {at.where(), at.label(), message, value, kGearRatio}));
  }

  RobotDescription* robot_;
  std::vector<XmlElement> transmissions_;
};

}  // namespace

void read_transmissions(const XmlElement& element, RobotDescription* robot) {
  TransmissionReader reader(element, robot);
  for (const XmlElement& joint : element.children("joint")) {
    const std::optional<XmlElement> actuator = joint.child("codesign:actuator");
    if (!actuator || actuator->has("gear_ratio")) continue;
    for (JointDescription& description : robot->joints)
      if (!description.is_loop && description.name == joint.find("name") && description.actuator)
        reader.read(&description);
  }
}

}  // namespace codesign
