// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/contact_constants.h"

#include <algorithm>
#include <cmath>

#include "codegen/number_types.h"
#include "math/arrays.h"
#include "mechanism/pose.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// w of (13l) over the smaller extent of both shapes.
constexpr double kOnset = 1e-10;

template <class T>
ShapeNumbers<T> shape_numbers(const ContactEnd& end, const std::vector<T>& parameters) {
  const T clearance = end.clearance.at(parameters);
  return {end.radius.at(parameters) + clearance, end.length.at(parameters) + 2.0 * clearance,
          vector_at(end.size, parameters)};
}

template <class T>
Matrix3<T> axes_at(const ShapeAxes& axes, const std::vector<T>& parameters) {
  const Vector3<T> z = axis_at(axes.axis, parameters), x = transverse_axis<T>(z, axes.transverse),
                   y = cross<T>(z, x);
  Matrix3<T> R;
  R.col(0) = axes.across ? y : x;
  R.col(1) = axes.across ? z : y;
  R.col(2) = axes.across ? x : z;
  return R;
}

double nominal_extent(const ContactEnd& end) {
  const ShapeNumbers<double> numbers{
      end.radius.nominal(), end.length.nominal(),
      Vector3<double>(end.size[0].nominal(), end.size[1].nominal(), end.size[2].nominal())};
  return extent_of(*end.shape, numbers);
}

template <class T>
ContactSide<T> contact_side(const RobotDescription& robot, const Topology& topology,
                            const ContactDescription& contact, const ContactEnd& end,
                            const LinkFrames<T>& links, const std::vector<T>& parameters) {
  const auto link = to_index(end.link);
  ContactSide<T> side;
  side.body = topology.link_body[link];
  if (side.body == Topology::kMassless)
    throw InputError({contact.where, contact.element(),
                      "a link without <inertial> cannot touch another one", robot.links[link].name,
                      "a link with an <inertial>"});
  const Pose<T> origin = pose_at(end.origin, parameters);
  side.frame.s = links[link].R * origin.t + links[link].s;
  side.frame.R = links[link].R * origin.R;
  if (end.axes) side.frame.R = side.frame.R * axes_at(*end.axes, parameters);
  side.clearance = end.clearance.at(parameters);
  side.shape = shape_numbers(end, parameters);
  return side;
}

/// Hertz's stiffness (4/3) E / sqrt(curvature), with 1/E the sum of (1 - nu^2)/E_k.
template <class T>
T hertz_stiffness(const ContactDescription& contact, const ContactConstants<T>& c,
                  const std::vector<T>& parameters) {
  using std::sqrt;
  T compliance(0.0);
  for (const ContactEnd* end : {&contact.surface, &contact.points}) {
    if (!end->youngs_modulus) continue;
    const T nu = end->poisson_ratio.at(parameters);
    compliance += (1.0 - nu * nu) / end->youngs_modulus->at(parameters);
  }
  const T curvature = contact.surface.shape->curvature.template of<T>(c.surface.shape) +
                      contact.points.shape->curvature.template of<T>(c.points.shape);
  return 4.0 / (3.0 * compliance * sqrt(curvature));
}

/// Whether it is that of the collars of a joint with clearance.
bool is_axial(const ContactDescription& contact) {
  return contact.surface.shape == ShapeKind::kSlot && !contact.surface.axes->across;
}

}  // namespace

template <class T>
ContactConstants<T> link_element_constants(const RobotDescription& robot, const Topology& topology,
                                           const ContactDescription& contact,
                                           const LinkFrames<T>& links,
                                           const std::vector<T>& parameters) {
  ContactConstants<T> c;
  c.surface = contact_side(robot, topology, contact, contact.surface, links, parameters);
  c.points = contact_side(robot, topology, contact, contact.points, links, parameters);
  if (c.surface.body == c.points.body)
    throw InputError({contact.where, contact.element(),
                      "both links belong to one body, so that they cannot move towards each other",
                      robot.links[to_index(contact.surface.link)].name + " and " +
                          robot.links[to_index(contact.points.link)].name,
                      "links with a movable joint between them"});
  c.force.exponent = contact.exponent.at(parameters);
  c.force.onset =
      kOnset * std::min(nominal_extent(contact.surface), nominal_extent(contact.points));
  c.force.stiffness = contact.stiffness ? contact.stiffness->at(parameters)
                                        : hertz_stiffness(contact, c, parameters);
  if (contact.loss) c.force.loss = contact.loss->at(parameters);
  if (contact.restitution)
    c.force.loss = contact.model->restitution.template of<T>(contact.restitution->at(parameters)) /
                   contact.impact_velocity.at(parameters);
  if (contact.friction) {
    const auto set = [&](const FrictionNumberRule&, const Quantity& number, T& value) {
      value = number.at(parameters);
    };
    visit_friction_numbers(set, &*contact.friction, &c.friction);
  }
  return c;
}

#define CODESIGN_INSTANTIATE(T)                                                                  \
  template ContactConstants<T> link_element_constants<T>(                                        \
      const RobotDescription&, const Topology&, const ContactDescription&, const LinkFrames<T>&, \
      const std::vector<T>&);
CODESIGN_FOR_EACH_FORMULA_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

std::string link_element_fault(const ContactDescription& contact,
                               const ContactConstants<double>& c) {
  const std::string of = " of contact '" + contact.name + "' is ";
  if (!contact.clearance.empty() && !(c.surface.clearance > 0.0))
    return std::string(is_axial(contact) ? "axial" : "radial") + " of " + contact.clearance +
           " is " + to_decimal(c.surface.clearance) + " (allowed: > 0)";
  const auto side_fault = [&](const ContactEnd& end, const ShapeNumbers<double>& n) -> std::string {
    if (end.shape->has_radius && !(n.radius > 0.0)) return "radius" + of + to_decimal(n.radius);
    if (end.shape->has_length && !(n.length > 0.0)) return "length" + of + to_decimal(n.length);
    if (end.shape->has_size && !(n.size.minCoeff() > 0.0))
      return "size" + of + to_decimal(n.size.minCoeff());
    return "";
  };
  if (std::string fault = side_fault(contact.surface, c.surface.shape); !fault.empty())
    return fault;
  if (std::string fault = side_fault(contact.points, c.points.shape); !fault.empty()) return fault;
  if (!(c.force.stiffness > 0.0) || !std::isfinite(c.force.stiffness))
    return "stiffness" + of + to_decimal(c.force.stiffness);
  if (!(c.force.loss >= 0.0) || !std::isfinite(c.force.loss))
    return std::string(contact.model->loss_attribute) + of + to_decimal(c.force.loss);
  if (!(c.force.exponent >= 1.0)) return "exponent" + of + to_decimal(c.force.exponent);
  if (!contact.friction) return "";
  const FrictionConstants<double>& f = c.friction;
  if (f.mu_static >= f.mu_dynamic && f.mu_dynamic >= 0.0 && f.transition_velocity > 0.0) return "";
  return "friction coefficients of contact '" + contact.name +
         "' are out of range (allowed: mu_static >= mu_dynamic >= 0, transition_velocity > 0)";
}

}  // namespace codesign
