// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/annotated_urdf.h"
#include "reading/urdf/design_writer.h"
#include "reading/urdf/twin.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

using tinyxml2::XMLElement;

/// Gives each joint and loop with friction the law. Removes attributes that the law does not use, since a file with them could not be read.
void write_friction_law(XMLElement* robot, const FrictionLaw& law) {
  for (XMLElement* joint = robot->FirstChildElement(); joint != nullptr; joint = joint->NextSiblingElement()) {
    XMLElement* friction = joint->FirstChildElement("codesign:friction");
    if (friction == nullptr) continue;
    friction->SetAttribute("model", law.name);
    visit_friction_numbers([&](const FrictionNumberRule& rule) {
      if (law.uses(rule)) return;
      friction->DeleteAttribute(rule.attribute);
      friction->DeleteAttribute((std::string(kPrefix) + rule.attribute).c_str());
    });
  }
}

}  // namespace

std::string write_tuned_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays, const std::vector<double>& parameters,
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
  const std::vector<double> values(parameters.begin(), parameters.begin() + static_cast<std::ptrdiff_t>(count));
  write_design(robot, values, &document);
  if (law) write_friction_law(document.robot(), **law);
  return document.text();
}

}  // namespace codesign
