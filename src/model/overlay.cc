// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "overlay.h"

#include <string>
#include <vector>

#include "mechanism_codesign/model/unknown_name.h"
#include "twin.h"
#include "xml_element.h"

namespace codesign {
namespace {

using tinyxml2::XMLElement;

/// The first child of `parent` with the tag of `like`, and its name if it has one.
XMLElement* find_like(XMLElement* parent, const XMLElement* like) {
  const char* name = like->Attribute("name");
  for (XMLElement* child = parent->FirstChildElement(like->Name()); child != nullptr; child = child->NextSiblingElement(like->Name())) {
    if (name == nullptr || child->Attribute("name", name) != nullptr) return child;
  }
  return nullptr;
}

void merge_element(const XMLElement* patch, const XmlDocument& overlay, XMLElement* target, XmlDocument* base) {
  base->copy_attributes(target, patch, overlay);
  for (const XMLElement* child = patch->FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    XMLElement* like = find_like(target, child);
    const bool replaces = std::string(child->Name()).rfind(kPrefix, 0) == 0;
    if (like != nullptr && replaces) target->DeleteChild(like);
    if (like != nullptr && !replaces) {
      merge_element(child, overlay, like, base);
    } else {
      base->append_copy(target, child, overlay);
    }
  }
}

std::vector<std::string> names_of(const XMLElement* robot, const char* tag) {
  std::vector<std::string> names;
  for (const XMLElement* child = robot->FirstChildElement(tag); child != nullptr; child = child->NextSiblingElement(tag)) {
    const char* name = child->Attribute("name");
    if (name != nullptr) names.emplace_back(name);
  }
  return names;
}

void merge_top(const XmlElement& patch, const XmlDocument& overlay, XmlDocument* base) {
  const std::string tag = patch.tag();
  const bool exists_already = tag == "link" || tag == "joint";
  const bool prefixed = tag.rfind(kPrefix, 0) == 0;
  if (!exists_already && !prefixed && tag != "loop" && tag != "coupling")
    patch.fail("an overlay cannot hold this element", "<" + tag + ">",
               "link, joint, loop, coupling, codesign:parameter, codesign:spring_damper");
  const std::string name = patch.text("name");
  XMLElement* like = find_like(base->robot(), patch.node());
  if (like != nullptr) {
    merge_element(patch.node(), overlay, like, base);
  } else if (exists_already) {
    throw unknown_name(patch.where("name"), patch.label(), tag + " of " + base->file(), name, names_of(base->robot(), tag.c_str()));
  } else {
    base->append_copy(base->robot(), patch.node(), overlay);
  }
}

}  // namespace

void merge_overlay(const XmlDocument& overlay, XmlDocument* base) {
  const XmlElement robot(overlay.robot(), &overlay);
  const std::string declaration = "xmlns:codesign";
  if (robot.has(declaration) && base->robot()->Attribute(declaration.c_str()) == nullptr)
    base->robot()->SetAttribute(declaration.c_str(), robot.text(declaration).c_str());
  for (const XmlElement& patch : robot.children()) merge_top(patch, overlay, base);
}

}  // namespace codesign
