// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "reading/urdf/annotation_rules.h"
#include "reading/urdf/joint_reader.h"
#include "reading/urdf/quantity_reader.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

ShapeKind read_shape(const XmlElement& end, const Laws& laws) {
  const std::string name = end.text("shape");
  for (const ShapeKind& shape : laws.shapes)
    if (name == shape->name) return shape;
  if (name == "mesh")
    end.fail_at("shape", "meshes do not touch; describe the place that touches by simple shapes",
                list_names(names_of(laws.shapes)));
  throw unknown_name(end.where("shape"), end.label(), "shape", name, names_of(laws.shapes));
}

/// A number that the shape needs; one that it does not have is an error, since it would have no
/// effect.
bool is_asked(const XmlElement& end, const ShapeKind& shape, const char* attribute, bool has) {
  if (!has && end.has(attribute))
    end.fail_at(attribute, std::string("a ") + shape->name + " has no " + attribute,
                "no such attribute");
  return has;
}

ContactEnd read_end(const XmlElement& end, int link, const ReadContext& context) {
  ContactEnd result;
  result.link = link;
  result.origin = read_origin(end, context.table);
  result.shape = read_shape(end, *context.laws);
  const auto positive = [&](const char* attribute) {
    return read_quantity(end, attribute, Range::kPositive, context.table);
  };
  const ContactShape& shape = *result.shape;
  if (is_asked(end, result.shape, "radius", shape.has_radius)) result.radius = positive("radius");
  if (is_asked(end, result.shape, "length", shape.has_length)) result.length = positive("length");
  if (is_asked(end, result.shape, "size", shape.has_size)) {
    result.size = read_vector(end, "size", context.table);
    for (const Quantity& edge : result.size)
      if (!(edge.nominal() > 0.0)) end.fail_at("size", "an edge is not positive", "> 0");
  }
  read_material(end, context, &result);
  return result;
}

/// At the default parameters.
double curvature_of(const ContactEnd& end) {
  return end.shape->curvature.of<double>(
      ShapeNumbers<double>{end.radius.nominal() + end.clearance.nominal(), end.length.nominal()});
}

/// What may touch what, for messages.
std::string shapes_that_touch(const Laws& laws) {
  std::string text;
  for (const ShapeKind& points : laws.shapes) {
    std::vector<std::string> surfaces;
    for (const ShapeKind& surface : laws.shapes)
      if (surface->takes(*points)) surfaces.emplace_back(surface->name);
    if (surfaces.empty()) continue;
    text += (text.empty() ? "" : "; ") + std::string(points->name) + " on " + list_names(surfaces);
  }
  return text;
}

void read_ends(const XmlElement& element, const ReadContext& context, ContactDescription* contact) {
  const auto [predecessor, successor] = context.ends(element);
  const XmlElement first = element.only("predecessor"), second = element.only("successor");
  contact->surface = read_end(first, predecessor, context);
  contact->points = read_end(second, successor, context);
  if (contact->surface.shape->takes(*contact->points.shape)) return;
  std::swap(contact->surface, contact->points);
  if (contact->surface.shape->takes(*contact->points.shape)) return;
  second.fail_at(
      "shape", std::string("a ") + second.text("shape") + " cannot touch a " + first.text("shape"),
      shapes_that_touch(*context.laws));
}

ContactModel read_law(const XmlElement& element, const Laws& laws) {
  const auto name = element.find("model");
  if (!name) return ContactModel::kHuntCrossley;
  for (const ContactModel& law : laws.contacts)
    if (*name == law->name) return law;
  throw unknown_name(element.where("model"), element.label(), "contact model", *name,
                     names_of(laws.contacts));
}

void read_stiffness(const XmlElement& element, const ReadContext& context,
                    ContactDescription* contact) {
  const ContactLaw& law = *contact->model;
  if (element.has("exponent") && !law.has_exponent)
    element.fail_at("exponent", std::string("the ") + law.title + " law has no exponent",
                    "no exponent");
  contact->exponent =
      read_quantity_or(law.exponent, element, "exponent", Range::kAny, context.table);
  if (!(contact->exponent.nominal() >= 1.0))
    element.fail_at("exponent", "the exponent is below 1", "1 or more; 1.5 of round bodies");
  const bool of_material = contact->surface.youngs_modulus || contact->points.youngs_modulus;
  if (element.has("stiffness") || !of_material) {
    contact->stiffness = read_quantity(element, "stiffness", Range::kPositive, context.table);
    if (of_material)
      element.fail_at("stiffness",
                      "the stiffness is given beside youngs_modulus, from which it "
                      "follows",
                      "one of them");
    return;
  }
  if (!law.has_exponent || element.has("exponent"))
    element.fail_at(law.has_exponent ? "exponent" : "model",
                    "Hertz's stiffness, by youngs_modulus, has the exponent 1.5",
                    "no exponent, and a law that has one; or stiffness");
  if (!contact->surface.shape->curvature || !contact->points.shape->curvature)
    element.fail("Hertz's stiffness, by youngs_modulus, needs round shapes", "",
                 "stiffness in place of youngs_modulus; or sphere, socket and plane");
  if (!(curvature_of(contact->surface) + curvature_of(contact->points) > 0.0))
    element.fail("the shapes conform, so that Hertz's stiffness does not exist", "",
                 "a socket that is larger than its sphere; or stiffness");
}

void read_loss(const XmlElement& element, const ReadContext& context, ContactDescription* contact) {
  const ContactLaw& law = *contact->model;
  for (const char* attribute : {"dissipation", "damping"})
    if (element.has(attribute) && attribute != std::string(law.loss_attribute))
      element.fail_at(attribute, std::string("the ") + law.title + " law has no " + attribute,
                      law.loss_attribute);
  if (element.has(law.loss_attribute))
    contact->loss =
        read_quantity(element, law.loss_attribute,
                      law.is_factor ? Range::kNonNegative : Range::kPositive, context.table);
  if (!element.has("restitution")) {
    if (element.has("impact_velocity"))
      element.fail_at("impact_velocity", "impact_velocity has no meaning without restitution",
                      "beside restitution");
    return;
  }
  if (!law.restitution)
    element.fail_at("restitution",
                    std::string("the loss of the ") + law.title +
                        " law depends on the masses, too, so that a restitution does not give it",
                    law.loss_attribute);
  if (contact->loss)
    element.fail_at("restitution", std::string("restitution is given beside ") + law.loss_attribute,
                    "one of them");
  contact->restitution = read_quantity(element, "restitution", Range::kPositive, context.table);
  if (contact->restitution->nominal() > 1.0)
    element.fail_at("restitution", "the restitution is above 1: an impact would give energy",
                    "> 0 and at most 1");
  contact->impact_velocity =
      read_quantity(element, "impact_velocity", Range::kPositive, context.table);
}

}  // namespace

void read_contact_force(const XmlElement& element, const ReadContext& context,
                        ContactDescription* contact) {
  contact->model = read_law(element, *context.laws);
  read_stiffness(element, context, contact);
  read_loss(element, context, contact);
  const auto friction = element.child("codesign:friction");
  if (!friction) return;
  contact->friction = read_friction(*friction, {0.0, 0.0, 1.0}, context);
  if (contact->friction->model->bristle)
    friction->fail_at("model", "friction laws with states are not available where bodies touch",
                      "brown_mcphee or stribeck");
}

void read_material(const XmlElement& element, const ReadContext& context, ContactEnd* end) {
  if (element.has("youngs_modulus"))
    end->youngs_modulus = read_quantity(element, "youngs_modulus", Range::kPositive, context.table);
  end->poisson_ratio =
      read_quantity_or(0.3, element, "poisson_ratio", Range::kNonNegative, context.table);
  if (end->poisson_ratio.nominal() > 0.5)
    element.fail_at("poisson_ratio", "Poisson's ratio is above 0.5", "0 to 0.5");
  if (element.has("poisson_ratio") && !end->youngs_modulus)
    element.fail_at("poisson_ratio", "Poisson's ratio has no meaning without youngs_modulus",
                    "beside youngs_modulus");
}

std::vector<std::string> contact_numbers() {
  return {"stiffness", "exponent", "dissipation", "damping", "restitution", "impact_velocity"};
}

void read_link_element(const XmlElement& element, const ReadContext& context,
                       ContactDescription* contact) {
  contact->where = element.where();
  contact->name = element.text("name");
  read_ends(element, context, contact);
  read_contact_force(element, context, contact);
}

// Its ends have a shape, too.
void add_rules_of(const std::vector<ContactDescription>&, const std::string& path,
                  std::vector<ElementRule>* rules) {
  rules->push_back(AnnotationRule(path)
                       .strict()
                       .plain({"name", "model"})
                       .twins(contact_numbers())
                       .children({"predecessor", "successor", "codesign:friction"}));
  for (const char* end : {"/predecessor", "/successor"}) {
    rules->push_back(AnnotationRule(path + end)
                         .strict()
                         .plain({"link", "shape"})
                         .twins({"radius", "length", "size", "youngs_modulus", "poisson_ratio"})
                         .children({"origin"}));
    rules->push_back(AnnotationRule(path + end + "/origin").strict().twins({"xyz", "rpy"}));
  }
  add_contact_friction(path, rules);
}

}  // namespace codesign
