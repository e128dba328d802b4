// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/friction_reader.h"

#include <Eigen/Geometry>

#include "math/scalar.h"
#include "reading/urdf/quantity_reader.h"
#include "text/decimal.h"
#include "text/unknown_name.h"

namespace codesign {
namespace {

FrictionModel read_model(const XmlElement& element) {
  const std::string name = element.find("model").value_or("brown_mcphee");
  if (name == "brown_mcphee") return FrictionModel::kBrownMcPhee;
  if (name == "gonthier") return FrictionModel::kGonthier;
  if (name == "lugre") return FrictionModel::kLuGre;
  throw unknown_name(element.where("model"), element.label(), "friction model", name, {"brown_mcphee", "gonthier", "lugre"});
}

/// Attributes that the model does not use are an error, since they would have no effect.
void check_model_attributes(const XmlElement& element, FrictionModel model) {
  const auto refuse = [&](const char* attribute, const char* models) {
    if (element.has(attribute)) element.fail_at(attribute, std::string(attribute) + " has no meaning for this friction model", models);
  };
  if (model == FrictionModel::kBrownMcPhee)
    for (const char* attribute : {"bristle_stiffness", "bristle_damping"}) refuse(attribute, "with model=\"gonthier\" or model=\"lugre\"");
  if (model != FrictionModel::kGonthier) refuse("dwell_time", "with model=\"gonthier\"");
}

std::array<double, 3> read_transverse_axis(const XmlElement& element, const QuantityVector& axis) {
  const std::vector<Quantity> given = parse_quantities(element, "transverse_axis", 3, ParameterTable());
  const std::array<double, 3> result = {given[0].nominal(), given[1].nominal(), given[2].nominal()};
  const Vector3<double> x(result[0], result[1], result[2]), z(axis[0].nominal(), axis[1].nominal(), axis[2].nominal());
  if (x.cross(z).norm() <= 1e-6 * x.norm() * z.norm())
    element.fail_at("transverse_axis", "the transverse axis is zero or parallel to the joint axis",
                    "a vector that is not parallel to the joint axis");
  return result;
}

}  // namespace

FrictionDescription read_friction(const XmlElement& element, const QuantityVector& axis, const ParameterTable& table) {
  FrictionDescription friction;
  friction.where = element.where();
  friction.model = read_model(element);
  check_model_attributes(element, friction.model);
  friction.mu_static = read_quantity(element, "mu_static", Range::kNonNegative, table);
  friction.mu_dynamic = read_quantity(element, "mu_dynamic", Range::kNonNegative, table);
  if (friction.mu_dynamic.nominal() > friction.mu_static.nominal())
    element.fail_at("mu_dynamic", "mu_dynamic is above mu_static", "at most mu_static=" + to_decimal(friction.mu_static.nominal()));
  if (friction.model == FrictionModel::kLuGre && friction.mu_dynamic.nominal() == 0.0)
    element.fail_at("mu_dynamic", "mu_dynamic is zero: the LuGre model divides by it", "> 0");
  const auto read = [&](const char* name, Range range, const Quantity& fallback) {
    return read_quantity_or(fallback, element, name, range, table);
  };
  friction.transition_velocity = read("transition_velocity", Range::kPositive, friction.transition_velocity);
  friction.joint_length = read("joint_length", Range::kPositive, friction.joint_length);
  friction.joint_width = read("joint_width", Range::kPositive, friction.joint_width);
  friction.pin_radius = read("pin_radius", Range::kPositive, friction.pin_radius);
  friction.friction_arm = read("friction_arm", Range::kPositive, friction.pin_radius);
  friction.preload = read("preload", Range::kNonNegative, friction.preload);
  friction.smoothing = read("smoothing", Range::kPositive, friction.smoothing);
  friction.viscous = read("viscous", Range::kNonNegative, friction.viscous);
  friction.bristle_stiffness = read("bristle_stiffness", Range::kPositive, friction.bristle_stiffness);
  friction.bristle_damping = read("bristle_damping", Range::kPositive, friction.bristle_damping);
  friction.dwell_time = read("dwell_time", Range::kPositive, friction.dwell_time);
  if (element.has("transverse_axis")) friction.transverse_axis = read_transverse_axis(element, axis);
  return friction;
}

}  // namespace codesign
