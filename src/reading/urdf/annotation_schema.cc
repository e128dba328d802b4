// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_checks.h"

#include <algorithm>

#include "reading/urdf/quantity_reader.h"
#include "reading/urdf/vocabulary.h"
#include "reading/xml/xml_element.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

using Names = std::vector<std::string>;

bool is_prefixed(const std::string& name) { return name.rfind(kPrefix, 0) == 0; }

Names prefixed_attributes(const ElementRule* rule) {
  Names names;
  if (rule == nullptr) return names;
  for (const Names* list : {&rule->twins, &rule->own})
    for (const std::string& name : *list) names.push_back(kPrefix + name);
  return names;
}

void check_prefixed_attribute(const XmlElement& element, const std::string& attribute,
                              const ElementRule* rule) {
  const Names known = prefixed_attributes(rule);
  const std::string plain = attribute.substr(sizeof(kPrefix) - 1);
  if (!contains(known, attribute)) {
    if (element.has(plain) && known.empty())
      element.fail_at(attribute, plain + " cannot depend on parameters: it cannot have a twin");
    throw unknown_name(element.where(attribute), element.label(),
                       "or misplaced attribute " + attribute, attribute, known);
  }
  if (rule != nullptr && contains(rule->twins, plain) && !element.has(plain))
    element.fail_at(attribute, "the twin " + attribute + " lacks its plain attribute " + plain +
                                   ", which other readers of URDF need");
}

void check_attributes(const XmlElement& element, const ElementRule* rule) {
  for (const std::string& attribute : element.attributes()) {
    if (is_prefixed(attribute)) {
      check_prefixed_attribute(element, attribute, rule);
    } else if (rule != nullptr && rule->strict && !contains(rule->plain, attribute) &&
               !contains(rule->twins, attribute)) {
      Names known = rule->plain;
      known.insert(known.end(), rule->twins.begin(), rule->twins.end());
      throw unknown_name(element.where(attribute), element.label(), "attribute " + attribute,
                         attribute, known);
    }
  }
}

void check_child(const XmlElement& child, const ElementRule* parent) {
  const std::string tag = child.tag();
  const bool strict = parent != nullptr && parent->strict;
  if (!strict && !is_prefixed(tag)) return;
  const Names here = parent != nullptr ? parent->children : Names{};
  if (contains(here, tag)) return;
  const Names everywhere = annotation_elements();
  if (contains(everywhere, tag))
    child.fail("the element does not belong here", "<" + tag + ">",
               "in " + list_names(places_of(tag)));
  throw unknown_name(child.where(), child.label(), "element <" + tag + ">", tag,
                     strict ? here : everywhere);
}

void check_element(const XmlElement& element, const std::string& path) {
  const ElementRule* rule = find_rule(path);
  check_attributes(element, rule);
  for (const XmlElement& child : element.children()) {
    check_child(child, rule);
    check_element(child, path + "/" + child.tag());
  }
}

void check_unprefixed(const XmlElement& element) {
  const auto complain = [&](const std::string& name, const SourceLocation& where) {
    if (is_prefixed(name))
      throw InputError({where, "<robot>", "the prefix codesign is not declared", name,
                        "<robot xmlns:codesign=\"...\">"});
  };
  complain(element.tag(), element.where());
  for (const std::string& attribute : element.attributes())
    complain(attribute, element.where(attribute));
  for (const XmlElement& child : element.children()) check_unprefixed(child);
}

}  // namespace

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void check_namespace(const XmlDocument& document) {
  const XmlElement robot(document.robot(), &document);
  if (!robot.has("xmlns:codesign")) check_unprefixed(robot);
}

void check_annotations(const XmlDocument& document) {
  check_element(XmlElement(document.robot(), &document), "robot");
}

}  // namespace codesign
