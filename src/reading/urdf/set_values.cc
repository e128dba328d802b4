// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/set_values.h"

#include <algorithm>

#include "description/tuned_parameters.h"
#include "reading/urdf/annotated_urdf.h"
#include "reading/urdf/design_writer.h"
#include "reading/urdf/quantity_reader.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using tinyxml2::XMLElement;

/// The index of the parameter that an element sets.
std::size_t index_of(const XmlElement& set, const std::vector<Parameter>& parameters) {
  const std::string name = set.text("name");
  const auto found = std::find_if(parameters.begin(), parameters.end(), [&name](const Parameter& known) { return known.name == name; });
  if (found != parameters.end()) return static_cast<std::size_t>(found - parameters.begin());
  std::vector<std::string> known;
  for (const Parameter& parameter : parameters) known.push_back(parameter.name);
  throw unknown_name(set.where("name"), set.label(), "parameter of the model", name, known);
}

/// Reads value and bounds into `parameter`, and writes the bounds into its declaration.
void read_set(const XmlElement& set, XMLElement* declaration, Parameter* parameter) {
  parameter->value = read_number(set, "value", Range::kAny);
  for (const auto& [name, bound] : {std::pair<const char*, double*>{"lower", &parameter->lower}, {"upper", &parameter->upper}}) {
    if (!set.has(name)) continue;
    *bound = read_number(set, name, Range::kAny);
    declaration->SetAttribute(name, to_decimal(*bound).c_str());
  }
  if (parameter->lower > parameter->upper) set.fail("the lower bound is above the upper bound", range_of(*parameter), "lower <= upper");
  if (parameter->value < parameter->lower || parameter->value > parameter->upper)
    set.fail_at("value", "the value is outside the bounds of the parameter", range_of(*parameter));
}

/// Two hyphens end a comment in XML.
std::string comment_of(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) text.insert(at + 1, " ");
  return " " + text + " ";
}

void add_comment(const std::string& text, XMLElement* robot) {
  if (!text.empty()) robot->InsertEndChild(robot->GetDocument()->NewComment(comment_of(text).c_str()));
}

}  // namespace

void refuse_set_values(const XmlDocument& model) {
  const XmlElement robot(model.robot(), &model);
  for (const XmlElement& set : robot.children(kSetTag))
    set.fail("only an overlay sets values of parameters", set.find("name").value_or(""), "the value in <codesign:parameter>");
}

void apply_set_values(XmlDocument* document, const Laws& laws) {
  XMLElement* const node = document->robot();
  const std::vector<XmlElement> sets = XmlElement(node, document).children(kSetTag);
  if (sets.empty()) return;
  RobotDescription robot = read_robot(*document, laws);
  for (const XmlElement& set : sets) {
    const std::size_t k = index_of(set, robot.parameters);
    read_set(set, find_named(node, kParameterTag, robot.parameters[k].name), &robot.parameters[k]);
  }
  while (XMLElement* const set = node->FirstChildElement(kSetTag)) node->DeleteChild(set);
  std::vector<double> values;
  for (const Parameter& parameter : robot.parameters) values.push_back(parameter.value);
  write_design(robot, values, document);
}

std::string write_set_overlay(const std::string& robot, const std::string& heading, const std::vector<SetValue>& values,
                              const std::string& ending) {
  tinyxml2::XMLDocument document;
  document.InsertEndChild(document.NewDeclaration());
  XMLElement* const root = document.NewElement("robot");
  document.InsertEndChild(root);
  root->SetAttribute("name", robot.c_str());
  root->SetAttribute("xmlns:codesign", "urn:mechanism_codesign");
  add_comment(heading, root);
  for (const SetValue& one : values) {
    add_comment(one.comment, root);
    XMLElement* const set = root->InsertNewChildElement(kSetTag);
    const std::string value = to_decimal(one.value);
    set->SetAttribute("name", one.parameter.name.c_str());
    set->SetAttribute("value", value.c_str());
    if (one.value < one.parameter.lower) set->SetAttribute("lower", value.c_str());
    if (one.value > one.parameter.upper) set->SetAttribute("upper", value.c_str());
  }
  add_comment(ending, root);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace codesign
