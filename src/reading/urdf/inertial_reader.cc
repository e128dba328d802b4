// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/inertial_reader.h"

#include <algorithm>
#include <cmath>

#include "mechanism/mass_properties.h"
#include "reading/urdf/mesh_reader.h"
#include "reading/urdf/quantity_reader.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kShapes = "<box>, <cylinder>, <sphere> or <mesh>";

ShapeDescription read_solid(const XmlElement& visual, const ParameterTable& table) {
  ShapeDescription shape;
  shape.origin = read_origin(visual, table);
  const XmlElement geometry = visual.only("geometry");
  const std::vector<XmlElement> kinds = geometry.children();
  if (kinds.size() != 1) geometry.fail("the geometry does not hold exactly one shape", "", kShapes);
  const XmlElement& kind = kinds.front();
  if (kind.tag() == "box") {
    shape.kind = ShapeDescription::Kind::kBox;
    shape.size = read_vector(kind, "size", table);
    for (const Quantity& side : shape.size)
      if (side.nominal() <= 0.0) kind.fail_at("size", "the box has no volume", "sides > 0");
  } else if (kind.tag() == "cylinder") {
    shape.kind = ShapeDescription::Kind::kCylinder;
    shape.size[0] = read_quantity(kind, "radius", Range::kPositive, table);
    shape.size[1] = read_quantity(kind, "length", Range::kPositive, table);
  } else if (kind.tag() == "sphere") {
    shape.kind = ShapeDescription::Kind::kSphere;
    shape.size[0] = read_quantity(kind, "radius", Range::kPositive, table);
  } else if (kind.tag() == "mesh") {
    shape.kind = ShapeDescription::Kind::kMesh;
    shape.size = {1.0, 1.0, 1.0};
    if (kind.has("scale")) shape.size = read_vector(kind, "scale", table);
    for (const Quantity& scale : shape.size)
      if (scale.nominal() == 0.0) kind.fail_at("scale", "the mesh has no volume", "not 0");
    shape.mesh = std::make_shared<const MeshMoments>(read_mesh(kind));
  } else {
    kind.fail("mass cannot be computed from this shape", "<" + kind.tag() + ">", kShapes);
  }
  return shape;
}

/// The solids of a link's `<visual>` or `<collision>` elements.
/// @param tag "visual" or "collision". @throws InputError if there are none.
std::vector<ShapeDescription> read_solids(const XmlElement& link, const std::string& tag,
                                          const ParameterTable& table) {
  std::vector<ShapeDescription> shapes;
  for (const XmlElement& visual : link.children(tag)) shapes.push_back(read_solid(visual, table));
  if (shapes.empty())
    link.fail("the link has no <" + tag + "> to compute its mass from", "",
              "a <" + tag + "> with box, cylinder, sphere or mesh, or codesign:from=\"" +
                  (tag == "visual" ? "collision" : "visual") + "\"");
  return shapes;
}

/// @param rpy further attributes of the origin
std::string as_xml(const MassProperties<double>& m, const std::string& rpy = "") {
  const auto attribute = [&](const char* name, int i, int k) {
    return std::string(" ") + name + "=\"" + to_decimal(m.inertia(i, k)) + "\"";
  };
  return "<origin xyz=\"" + format_numbers({m.centre[0], m.centre[1], m.centre[2]}) + "\"" + rpy +
         "/> <mass value=\"" + to_decimal(m.mass) + "\"/> <inertia" + attribute("ixx", 0, 0) +
         attribute("ixy", 0, 1) + attribute("ixz", 0, 2) + attribute("iyy", 1, 1) +
         attribute("iyz", 1, 2) + attribute("izz", 2, 2) + "/>";
}

/// Checks that the written values agree with the values of the shapes to 1e-6 (relative). @throws
/// InputError
void check_agreement(const XmlElement& element, const InertialDescription& written,
                     const InertialDescription& from_shapes, const ParameterTable& table) {
  constexpr double kRelative = 1e-6;
  const MassProperties<double> a = mass_properties(written, table.values),
                               b = mass_properties(from_shapes, table.values);
  const double size = std::sqrt(b.inertia.trace() / b.mass);
  const bool agree = std::abs(a.mass - b.mass) <= kRelative * b.mass &&
                     (a.centre - b.centre).norm() <= kRelative * (size + b.centre.norm()) &&
                     (a.inertia - b.inertia).norm() <= kRelative * b.inertia.norm();
  if (!agree)
    element.fail("mass, centre or inertia differ from those of the shapes", as_xml(a), as_xml(b));
}

/// Throws InputError; its allowed value is the computed inertial as XML, ready to be pasted.
[[noreturn]] void fail_with_computed(const XmlElement& element,
                                     const InertialDescription& from_shapes,
                                     const ParameterTable& table, const std::string& message) {
  element.fail(message, "", as_xml(mass_properties(from_shapes, table.values)));
}

constexpr std::array<const char*, 6> kInertia = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};

InertialDescription read_numbers(const XmlElement& inertial, const ParameterTable& table) {
  InertialDescription result;
  result.where = inertial.where();
  result.origin = read_origin(inertial, table);
  const XmlElement mass = inertial.only("mass");
  result.mass = read_quantity(mass, "value",
                              mass.in_overlay("value") ? Range::kNonNegative : Range::kAny, table);
  const XmlElement inertia = inertial.only("inertia");
  for (std::size_t k = 0; k < kInertia.size(); ++k)
    result.inertia[k] = read_quantity(inertia, kInertia[k], Range::kAny, table);
  return result;
}

bool is_massless(const InertialDescription& inertial) {
  const auto is_zero = [](const Quantity& quantity) { return quantity.is_zero(); };
  return inertial.mass.is_zero() &&
         std::all_of(inertial.inertia.begin(), inertial.inertia.end(), is_zero);
}

InertialDescription read_from_shapes(const XmlElement& link, const XmlElement& inertial,
                                     const ParameterTable& table) {
  InertialDescription result;
  result.where = inertial.where();
  const std::string from = inertial.find("codesign:from").value_or("visual");
  if (from != "visual" && from != "collision")
    inertial.fail_at("codesign:from", "unknown kind of shapes", "visual or collision");
  result.density = parse_quantities(inertial, "codesign:density", 1, table).front();
  if (result.density->nominal() <= 0.0)
    inertial.fail_at("codesign:density", "the density is not positive", "> 0");
  result.shapes = read_solids(link, from, table);
  return result;
}

tinyxml2::XMLElement* child_of(tinyxml2::XMLElement* inertial, const char* tag,
                               XmlDocument* document) {
  tinyxml2::XMLElement* child = inertial->FirstChildElement(tag);
  return child != nullptr ? child
                          : document->append_new(inertial, tag, document->location(inertial));
}

void write_properties(tinyxml2::XMLElement* inertial, const MassProperties<double>& m,
                      XmlDocument* document) {
  tinyxml2::XMLElement* origin = child_of(inertial, "origin", document);
  origin->SetAttribute("xyz", format_numbers({m.centre[0], m.centre[1], m.centre[2]}).c_str());
  origin->SetAttribute("rpy", "0 0 0");
  child_of(inertial, "mass", document)->SetAttribute("value", to_decimal(m.mass).c_str());
  tinyxml2::XMLElement* inertia = child_of(inertial, "inertia", document);
  constexpr int kRows[] = {0, 0, 0, 1, 1, 2}, kColumns[] = {0, 1, 2, 1, 2, 2};
  for (std::size_t k = 0; k < kInertia.size(); ++k)
    inertia->SetAttribute(kInertia[k], to_decimal(m.inertia(kRows[k], kColumns[k])).c_str());
}

}  // namespace

void write_out_densities(XmlDocument* document) {
  const XmlElement robot(document->robot(), document);
  const ParameterTable table(read_parameters(robot));
  for (tinyxml2::XMLElement* node = document->robot()->FirstChildElement("link"); node != nullptr;
       node = node->NextSiblingElement("link")) {
    const XmlElement link(node, document);
    const std::optional<XmlElement> inertial = link.child("inertial");
    if (!inertial || !inertial->has("codesign:density") ||
        !inertial->in_overlay("codesign:density"))
      continue;
    const std::optional<XmlElement> mass = inertial->child("mass");
    if (mass && mass->in_overlay("value") && inertial->child("inertia")) continue;
    const MassProperties<double> properties =
        mass_properties(read_from_shapes(link, *inertial, table), table.values);
    write_properties(node->FirstChildElement("inertial"), properties, document);
  }
}

std::optional<InertialDescription> read_inertial(const XmlElement& link,
                                                 const ParameterTable& table) {
  const std::optional<XmlElement> inertial = link.child("inertial");
  if (!inertial) return std::nullopt;
  if (!inertial->has("codesign:density")) {
    if (inertial->has("codesign:from"))
      inertial->fail_at("codesign:from",
                        "without codesign:density no mass can be computed from shapes; add it, or "
                        "remove codesign:from");
    InertialDescription result = read_numbers(*inertial, table);
    if (is_massless(result)) return std::nullopt;
    return result;
  }
  InertialDescription result = read_from_shapes(link, *inertial, table);
  if (!inertial->child("mass") || !inertial->child("inertia"))
    fail_with_computed(*inertial, result, table,
                       "mass or inertia is missing, which other readers of URDF need");
  check_agreement(*inertial, read_numbers(*inertial, table), result, table);
  return result;
}

// An overlay is merged into an <inertial> of zeros, whose rpy would stay.
std::string inertial_text(const MassProperties<double>& properties) {
  return as_xml(properties, " rpy=\"0 0 0\"");
}

std::string inertial_of_shapes(const XmlElement& link, const std::string& from, double density,
                               const ParameterTable& table) {
  InertialDescription inertial;
  inertial.density = Quantity(density);
  try {
    inertial.shapes = read_solids(link, from, table);
  } catch (const InputError&) {
    return "";
  }
  return "<inertial codesign:density=\"" + to_decimal(density) + "\" codesign:from=\"" + from +
         "\">" + inertial_text(mass_properties(inertial, table.values)) + "</inertial>";
}

}  // namespace codesign
