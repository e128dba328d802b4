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
  if (const auto model = friction_model(name)) return *model;
  throw unknown_name(element.where("model"), element.label(), "friction model", name,
                     {kFrictionModelNames.begin(), kFrictionModelNames.end()});
}

/// A number of the element. An attribute that the model does not use is an error, since it would have no effect.
void read_number(const XmlElement& element, const FrictionNumberRule& rule, const ParameterTable& table, FrictionDescription* friction,
                 Quantity* number) {
  if (!rule.is_used_by(friction->model)) {
    const bool gonthier = rule.models == FrictionNumberRule::Models::kGonthierOnly;
    if (element.has(rule.attribute))
      element.fail_at(rule.attribute, std::string(rule.attribute) + " has no meaning for this friction model",
                      gonthier ? "with model=\"gonthier\"" : "with model=\"gonthier\" or model=\"lugre\"");
    return;
  }
  const Range range = rule.zero_allowed ? Range::kNonNegative : Range::kPositive;
  if (rule.missing == FrictionNumberRule::Missing::kRefused)
    *number = read_quantity(element, rule.attribute, range, table);
  else
    *number = read_quantity_or(rule.missing == FrictionNumberRule::Missing::kPinRadius ? friction->pin_radius : *number, element,
                               rule.attribute, range, table);
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
  const auto read = [&](const FrictionNumberRule& rule, Quantity& number) { read_number(element, rule, table, &friction, &number); };
  visit_friction_numbers(read, &friction);
  if (friction.mu_dynamic.nominal() > friction.mu_static.nominal())
    element.fail_at("mu_dynamic", "mu_dynamic is above mu_static", "at most mu_static=" + to_decimal(friction.mu_static.nominal()));
  if (friction.model == FrictionModel::kLuGre && friction.mu_dynamic.nominal() == 0.0)
    element.fail_at("mu_dynamic", "mu_dynamic is zero: the LuGre model divides by it", "> 0");
  if (element.has("transverse_axis")) friction.transverse_axis = read_transverse_axis(element, axis);
  return friction;
}

}  // namespace codesign
