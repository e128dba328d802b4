// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/friction_reader.h"

#include <Eigen/Geometry>

#include "math/scalar.h"
#include "reading/urdf/quantity_reader.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

FrictionModel read_model(const XmlElement& element, const Laws& laws) {
  const std::string name = element.find("model").value_or("brown_mcphee");
  if (const auto law = find_friction(laws, name)) return *law;
  throw unknown_name(element.where("model"), element.label(), "friction model", name, names_of(laws.friction));
}

/// The number that counts where an attribute is missing.
const Quantity& value_if_missing(const FrictionNumberRule& rule, const FrictionDescription& friction, const Quantity& standard) {
  switch (rule.missing) {
    case FrictionNumberRule::Missing::kPinRadius:
      return friction.pin_radius;
    case FrictionNumberRule::Missing::kMuStatic:
      return friction.mu_static;
    case FrictionNumberRule::Missing::kMuDynamic:
      return friction.mu_dynamic;
    case FrictionNumberRule::Missing::kViscous:
      return friction.viscous;
    case FrictionNumberRule::Missing::kRefused:
    case FrictionNumberRule::Missing::kStandard:
    case FrictionNumberRule::Missing::kLengthOfOne:
      break;
  }
  return standard;
}

/// The models that use a number, for messages.
std::string models_of(const FrictionNumberRule& rule, const Laws& laws) {
  std::string models;
  for (const FrictionModel& law : laws.friction)
    if (law->uses(rule)) models += (models.empty() ? "with model=\"" : " or model=\"") + std::string(law->name) + "\"";
  return models;
}

void require_ordered(const XmlElement& element, const std::string& dynamic_name, const Quantity& dynamic, const std::string& static_name,
                     const Quantity& at_rest) {
  if (dynamic.nominal() > at_rest.nominal())
    element.fail_at(element.has(dynamic_name) ? dynamic_name : static_name, dynamic_name + " is above " + static_name,
                    "at most " + static_name + "=" + to_decimal(at_rest.nominal()));
}

/// A number of the element. An attribute that the model does not use is an error, since it would have no effect.
void read_number(const XmlElement& element, const FrictionNumberRule& rule, const ReadContext& context, FrictionDescription* friction,
                 Quantity* number) {
  if (!friction->model->uses(rule)) {
    if (element.has(rule.attribute))
      element.fail_at(rule.attribute, std::string(rule.attribute) + " has no meaning for this friction model",
                      models_of(rule, *context.laws));
    return;
  }
  const Range range = rule.zero_allowed ? Range::kNonNegative : Range::kPositive;
  if (rule.missing == FrictionNumberRule::Missing::kRefused)
    *number = read_quantity(element, rule.attribute, range, context.table);
  else
    *number = read_quantity_or(value_if_missing(rule, *friction, *number), element, rule.attribute, range, context.table);
  if (rule.is_backward() && element.has(rule.attribute)) friction->is_directional = true;
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

FrictionDescription read_friction(const XmlElement& element, const QuantityVector& axis, const ReadContext& context) {
  FrictionDescription friction;
  friction.where = element.where();
  friction.model = read_model(element, *context.laws);
  const auto read = [&](const FrictionNumberRule& rule, Quantity& number) { read_number(element, rule, context, &friction, &number); };
  visit_friction_numbers(read, &friction);
  require_ordered(element, "mu_dynamic", friction.mu_dynamic, "mu_static", friction.mu_static);
  require_ordered(element, "mu_dynamic_backward", friction.mu_dynamic_backward, "mu_static_backward", friction.mu_static_backward);
  if (friction.model->divides_by_mu_dynamic && friction.mu_dynamic.nominal() == 0.0)
    element.fail_at("mu_dynamic", std::string("mu_dynamic is zero: the ") + friction.model->title + " model divides by it", "> 0");
  if (element.has("transverse_axis")) friction.transverse_axis = read_transverse_axis(element, axis);
  return friction;
}

}  // namespace codesign
