// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/overlay.h"

#include <set>
#include <string>
#include <vector>

#include "reading/urdf/set_values.h"
#include "reading/urdf/twin.h"
#include "reading/xml/xml_element.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

using tinyxml2::XMLElement;

/// The first child of `parent` with the tag of `like` and, if `like` has a name, with that name; null if there is none.
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

bool is_annotation(const std::string& tag) { return tag.rfind(kPrefix, 0) == 0 || tag == "loop" || tag == "coupling"; }

/// Whether an unknown link or joint is to be added: a link if a joint of the model or the overlay names it, a joint if it has a type.
bool is_new(const XmlElement& patch, const XmlDocument& overlay, const XmlDocument& base) {
  if (patch.tag() == "joint") return patch.has("type");
  const std::string name = patch.text("name");
  for (const XmlDocument* document : {&overlay, &base}) {
    const XmlElement robot(document->robot(), document);
    for (const XmlElement& joint : robot.children("joint"))
      for (const char* end : {"parent", "child"})
        if (const std::optional<XmlElement> side = joint.child(end); side && side->find("link") == name) return true;
  }
  return false;
}

/// Merges the elements of one overlay and remembers their tags and names, so that an element that occurs twice is an error.
class Merger {
 public:
  Merger(const XmlDocument& overlay, XmlDocument* base) : overlay_(overlay), base_(base) {}

  void merge(const XmlElement& patch) {
    const std::string tag = patch.tag();
    const bool known = is_annotation(tag) || tag == "link" || tag == "joint";
    if (!known)
      patch.fail("an overlay cannot contain this element", "<" + tag + ">",
                 "link, joint, loop, coupling, codesign:parameter, codesign:set, codesign:spring_damper");
    const std::string name = patch.text("name");
    XMLElement* like = find_like(base_->robot(), patch.node());
    const bool merged_already = !seen_.insert(tag + " " + name).second;
    if (merged_already && (is_annotation(tag) || added_.count(like) != 0))
      patch.fail("a second <" + tag + "> of this name in one overlay", name, "one of each name");
    if (tag == kParameterTag || tag == kSetTag) give_value_once(patch, name);
    if (like != nullptr) {
      note_parts(patch, tag + " " + name);
      merge_element(patch.node(), overlay_, like, base_);
    } else if (!is_annotation(tag) && !is_new(patch, overlay_, *base_)) {
      throw unknown_name(patch.where("name"), patch.label(), tag + " of " + base_->file(), name, names_of(base_->robot(), tag.c_str()));
    } else {
      added_.insert(base_->append_copy(base_->robot(), patch.node(), overlay_));
    }
  }

 private:
  /// The value of a parameter comes from its declaration or from a setting in an overlay; of several overlays the last one counts.
  void give_value_once(const XmlElement& patch, const std::string& name) {
    const bool declares = patch.tag() == kParameterTag;
    if (seen_.count(std::string(declares ? kSetTag : kParameterTag) + " " + name) != 0)
      patch.fail("the overlay declares this parameter and sets it, too", name, "one of the two");
    XMLElement* set = declares && patch.has("value") ? find_named(base_->robot(), kSetTag, name) : nullptr;
    if (set != nullptr) base_->robot()->DeleteChild(set);
  }

  // A second attribute or annotation of the same name would replace the first one.
  void note_parts(const XmlElement& element, const std::string& path) {
    for (const std::string& attribute : element.attributes()) {
      if (attribute == "name" || seen_.insert(path + "@" + attribute).second) continue;
      element.fail_at(attribute, "the overlay sets " + attribute + " a second time", "once");
    }
    for (const XmlElement& child : element.children()) {
      const std::string below = path + "/" + child.tag() + " " + child.find("name").value_or("");
      if (child.tag().rfind(kPrefix, 0) == 0 && !seen_.insert(below).second)
        child.fail("a second <" + child.tag() + "> in one overlay", "", "one at most");
      note_parts(child, below);
    }
  }

  const XmlDocument& overlay_;
  XmlDocument* base_;
  std::set<std::string> seen_;
  std::set<const XMLElement*> added_;
};

}  // namespace

void merge_overlay(const XmlDocument& overlay, XmlDocument* base) {
  const XmlElement robot(overlay.robot(), &overlay);
  const std::string declaration = "xmlns:codesign";
  if (robot.has(declaration) && base->robot()->Attribute(declaration.c_str()) == nullptr)
    base->robot()->SetAttribute(declaration.c_str(), robot.text(declaration).c_str());
  Merger merger(overlay, base);
  for (const XmlElement& patch : robot.children()) merger.merge(patch);
}

}  // namespace codesign
