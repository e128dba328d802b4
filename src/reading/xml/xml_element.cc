// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/xml/xml_element.h"

namespace codesign {
namespace {

std::string describe(const tinyxml2::XMLElement& element) {
  const char* name = element.Attribute("name");
  return std::string("<") + element.Name() +
         (name != nullptr ? std::string(" name=\"") + name + "\">" : ">");
}

}  // namespace

std::string XmlElement::label() const {
  std::string path = describe(*node_);
  for (const tinyxml2::XMLNode* above = node_->Parent(); above != nullptr;
       above = above->Parent()) {
    const tinyxml2::XMLElement* element = above->ToElement();
    if (element == nullptr || element == document_->robot()) break;
    path = describe(*element) + " " + path;
  }
  return path;
}

std::optional<std::string> XmlElement::find(const std::string& attribute) const {
  const char* value = node_->Attribute(attribute.c_str());
  if (value == nullptr) return std::nullopt;
  return value;
}

std::string XmlElement::text(const std::string& attribute) const {
  const std::optional<std::string> value = find(attribute);
  if (!value) fail("the attribute " + attribute + " is missing", "", attribute + "=\"...\"");
  if (value->empty())
    fail_at(attribute, "the attribute " + attribute + " is empty", attribute + "=\"...\"");
  return *value;
}

std::vector<std::string> XmlElement::attributes() const {
  std::vector<std::string> names;
  for (const tinyxml2::XMLAttribute* attribute = node_->FirstAttribute(); attribute != nullptr;
       attribute = attribute->Next())
    names.emplace_back(attribute->Name());
  return names;
}

std::vector<XmlElement> XmlElement::children() const {
  std::vector<XmlElement> result;
  for (const tinyxml2::XMLElement* child = node_->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement())
    result.emplace_back(child, document_);
  return result;
}

std::vector<XmlElement> XmlElement::children(const std::string& tag) const {
  std::vector<XmlElement> result;
  for (const tinyxml2::XMLElement* child = node_->FirstChildElement(tag.c_str()); child != nullptr;
       child = child->NextSiblingElement(tag.c_str()))
    result.emplace_back(child, document_);
  return result;
}

std::optional<XmlElement> XmlElement::child(const std::string& tag) const {
  const tinyxml2::XMLElement* const found = node_->FirstChildElement(tag.c_str());
  if (found == nullptr) return std::nullopt;
  return XmlElement(found, document_);
}

XmlElement XmlElement::only(const std::string& tag) const {
  const std::optional<XmlElement> found = child(tag);
  if (!found) fail("the element <" + tag + "> is missing", "", "one <" + tag + "> in it");
  return *found;
}

Warning XmlElement::warning(const std::string& code, const std::string& message,
                            const std::string& value, const std::string& remedy) const {
  return warn(code, {where(), label(), message + "; to silence this: " + remedy, value, ""});
}

Warning XmlElement::warning_at(const std::string& code, const std::string& attribute,
                               const std::string& message, const std::string& remedy) const {
  return warn(code, {where(attribute), label(), message + "; to silence this: " + remedy,
                     find(attribute).value_or(""), ""});
}

void XmlElement::fail(const std::string& message, const std::string& value,
                      const std::string& allowed) const {
  throw InputError({where(), label(), message, value, allowed});
}

void XmlElement::fail_at(const std::string& attribute, const std::string& message,
                         const std::string& allowed) const {
  throw InputError({where(attribute), label(), message, find(attribute).value_or(""), allowed});
}

tinyxml2::XMLElement* find_named(tinyxml2::XMLElement* parent, const char* tag,
                                 const std::string& name) {
  tinyxml2::XMLElement* child = parent->FirstChildElement(tag);
  while (child != nullptr && child->Attribute("name", name.c_str()) == nullptr)
    child = child->NextSiblingElement(tag);
  return child;
}

}  // namespace codesign
