// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/arrays.h"
#include "mechanism/mass_properties.h"
#include "reading/urdf/quantity_reader.h"
#include "reading/urdf/vocabulary.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using tinyxml2::XMLElement;

/// The design to write. `values` are the values of the parameters in `table`.
struct WrittenDesign {
  const XmlDocument& document;
  ParameterTable table;
  std::vector<double> values;
};

std::vector<double> twin_values(const XmlElement& element, const std::string& name,
                                const WrittenDesign& design) {
  const std::string twin = kPrefix + name;
  std::vector<double> values;
  for (const Quantity& quantity : parse_quantities(element, twin, words_of(name), design.table)) {
    values.push_back(quantity.at(design.values));
    if (!std::isfinite(values.back()))
      element.fail_at(twin, twin + " is not finite at the values to write");
  }
  return values;
}

void write_twins(XMLElement* node, const std::string& path, const WrittenDesign& design) {
  const ElementRule* rule = find_rule(path);
  const XmlElement element(node, &design.document);
  if (rule != nullptr) {
    for (const std::string& name : rule->twins)
      if (element.has(kPrefix + name))
        node->SetAttribute(name.c_str(),
                           format_numbers(twin_values(element, name, design)).c_str());
  }
  for (XMLElement* child = node->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement())
    write_twins(child, path + "/" + child->Name(), design);
}

/// Writes the new defaults. A bound that a value exceeds, since a study has wider ones, is moved to
/// the value, so that the file stays valid.
void write_parameters(XMLElement* robot, const std::vector<Parameter>& parameters,
                      const std::vector<double>& values) {
  const char* tag = "codesign:parameter";
  std::size_t k = 0;
  for (XMLElement* node = robot->FirstChildElement(tag); node != nullptr;
       node = node->NextSiblingElement(tag), ++k) {
    const std::string value = to_decimal(values[k]);
    node->SetAttribute("value", value.c_str());
    if (values[k] < parameters[k].lower) node->SetAttribute("lower", value.c_str());
    if (values[k] > parameters[k].upper) node->SetAttribute("upper", value.c_str());
  }
}

void write_inertial(XMLElement* inertial, const MassProperties<double>& properties) {
  XMLElement* origin = inertial->FirstChildElement("origin");
  if (origin == nullptr) origin = inertial->InsertNewChildElement("origin");
  const Vector3<double>& centre = properties.centre;
  origin->SetAttribute("xyz", format_numbers({centre[0], centre[1], centre[2]}).c_str());
  origin->SetAttribute("rpy", "0 0 0");
  inertial->FirstChildElement("mass")->SetAttribute("value", to_decimal(properties.mass).c_str());
  const std::array<std::array<const char*, 3>, 3> names = {
      {{"ixx", "ixy", "ixz"}, {"ixy", "iyy", "iyz"}, {"ixz", "iyz", "izz"}}};
  XMLElement* inertia = inertial->FirstChildElement("inertia");
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      inertia->SetAttribute(
          names[i][j],
          to_decimal(properties.inertia(static_cast<int>(i), static_cast<int>(j))).c_str());
}

/// Whether a link has meshes, and no parameter changes its mass.
bool has_constant_meshes(const InertialDescription& inertial) {
  const auto is_constant = [](const Quantity& quantity) { return quantity.is_constant(); };
  const auto all_constant = [&](const QuantityVector& vector) {
    return std::all_of(vector.begin(), vector.end(), is_constant);
  };
  return is_constant(*inertial.density) &&
         std::any_of(inertial.shapes.begin(), inertial.shapes.end(),
                     [](const ShapeDescription& shape) { return shape.mesh != nullptr; }) &&
         std::all_of(inertial.shapes.begin(), inertial.shapes.end(),
                     [&](const ShapeDescription& shape) {
                       return all_constant(shape.size) && all_constant(shape.origin.xyz) &&
                              all_constant(shape.origin.rpy);
                     });
}

void write_inertials(XMLElement* robot, const std::vector<LinkDescription>& links,
                     const std::vector<double>& values) {
  std::size_t k = 0;
  for (XMLElement* link = robot->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link"), ++k) {
    const std::optional<InertialDescription>& inertial = links[k].inertial;
    if (!inertial || !inertial->density) continue;
    XMLElement* node = link->FirstChildElement("inertial");
    write_inertial(node, mass_properties(*inertial, values));
    // The file may be moved away from its meshes, whose numbers it has.
    if (has_constant_meshes(*inertial))
      for (const char* attribute : {"codesign:density", "codesign:from"})
        node->DeleteAttribute(attribute);
  }
}

}  // namespace

void write_design(const RobotDescription& robot, const std::vector<double>& values,
                  XmlDocument* document) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isfinite(values[k]))
      throw InputError({robot.parameters[k].where, robot.parameters[k].name,
                        "the value to write is not finite", to_decimal(values[k]), ""});
  write_twins(document->robot(), "robot", {*document, ParameterTable(robot.parameters), values});
  write_inertials(document->robot(), robot.links, values);
  write_parameters(document->robot(), robot.parameters, values);
}

void fill_in_twins(XmlDocument* document) {
  const std::vector<Parameter> parameters =
      read_parameters(XmlElement(document->robot(), document));
  std::vector<double> values;
  for (const Parameter& parameter : parameters) values.push_back(parameter.value);
  write_twins(document->robot(), "robot", {*document, ParameterTable(parameters), values});
}

namespace {

/// Notes where the elements of a printed document came from. @param printed, original the same
/// element of both.
void note_origins(const XMLElement* printed, const XMLElement* original,
                  const XmlDocument& document, std::vector<SourceLocation>* origins) {
  const auto line = to_index(printed->GetLineNum());
  if (origins->size() < line) origins->resize(line);
  if ((*origins)[line - 1].line == 0) (*origins)[line - 1] = document.location(original);
  const XMLElement* from = original->FirstChildElement();
  for (const XMLElement* child = printed->FirstChildElement(); child != nullptr && from != nullptr;
       child = child->NextSiblingElement(), from = from->NextSiblingElement())
    note_origins(child, from, document, origins);
}

}  // namespace

SourceText write_filled_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays,
                             const Laws& laws) {
  XmlDocument document = load_annotated_urdf(urdf, overlays, laws, PlainNumbers::kFilledIn);
  read_robot(document, laws);
  SourceText filled{urdf.name, document.text()};
  const XmlDocument printed(filled);
  note_origins(printed.robot(), document.robot(), document, &filled.origins);
  return filled;
}

namespace {

using tinyxml2::XMLElement;

/// Gives each joint and loop with friction the law. Removes attributes that the law does not use,
/// since a file with them could not be read. Contacts keep theirs, as in the runs with the law.
void write_friction_law(XMLElement* parent, const FrictionLaw& law) {
  for (XMLElement* joint = parent->FirstChildElement(); joint != nullptr;
       joint = joint->NextSiblingElement()) {
    const std::string tag = joint->Name();
    if (tag != "joint" && tag != "loop") continue;
    XMLElement* friction = joint->FirstChildElement("codesign:friction");
    if (friction == nullptr) continue;
    const bool direct = friction->Attribute("coulomb") != nullptr;
    friction->SetAttribute("model", law.name);
    const auto remove = [friction](const char* attribute) {
      friction->DeleteAttribute(attribute);
      friction->DeleteAttribute((std::string(kPrefix) + attribute).c_str());
    };
    visit_friction_numbers([&](const FrictionNumberRule& rule) {
      if (!law.uses(rule) || !rule.is_in(direct)) remove(rule.attribute);
    });
    if (law.only_above_mu_dynamic && direct && friction->Attribute("static") == nullptr &&
        friction->Attribute("viscous_exponent") == nullptr)
      remove("transition_velocity");
  }
}

}  // namespace

std::string write_tuned_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays,
                             const std::vector<double>& parameters,
                             std::optional<FrictionModel> law, const Laws& laws) {
  XmlDocument document = load_annotated_urdf(urdf, overlays, laws);
  const RobotDescription robot = read_robot(document, laws);
  const std::size_t count = robot.parameters.size();
  if (parameters.size() < count)
    throw InputError({{urdf.name, 0},
                      "<robot>",
                      "too few parameter values for the model",
                      std::to_string(parameters.size()),
                      std::to_string(count) + " or more"});
  const std::vector<double> values(parameters.begin(), parameters.begin() + to_signed(count));
  write_design(robot, values, &document);
  if (law) write_friction_law(document.robot(), **law);
  return document.text();
}

}  // namespace codesign
