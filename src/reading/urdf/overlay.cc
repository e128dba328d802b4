// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/overlay.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "reading/urdf/quantity_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "reading/urdf/vocabulary.h"
#include "reading/xml/xml_element.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using tinyxml2::XMLElement;

/// The first child of `parent` with the tag of `like` and, if `like` has a name, with that name;
/// null if there is none.
XMLElement* find_like(XMLElement* parent, const XMLElement* like) {
  const char* name = like->Attribute("name");
  for (XMLElement* child = parent->FirstChildElement(like->Name()); child != nullptr;
       child = child->NextSiblingElement(like->Name())) {
    if (name == nullptr || child->Attribute("name", name) != nullptr) return child;
  }
  return nullptr;
}

void merge_element(const XMLElement* patch, const XmlDocument& overlay, XMLElement* target,
                   XmlDocument* base) {
  base->copy_attributes(target, patch, overlay);
  for (const XMLElement* child = patch->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
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
  for (const XMLElement* child = robot->FirstChildElement(tag); child != nullptr;
       child = child->NextSiblingElement(tag)) {
    const char* name = child->Attribute("name");
    if (name != nullptr) names.emplace_back(name);
  }
  return names;
}

bool is_annotation(const std::string& tag) {
  return tag.rfind(kPrefix, 0) == 0 || tag == "loop" || tag == "coupling";
}

/// Whether an unknown link or joint is to be added: a link if a joint of the model or the overlay
/// names it, a joint if it has a type.
bool is_new(const XmlElement& patch, const XmlDocument& overlay, const XmlDocument& base) {
  if (patch.tag() == "joint") return patch.has("type");
  const std::string name = patch.text("name");
  for (const XmlDocument* document : {&overlay, &base}) {
    const XmlElement robot(document->robot(), document);
    for (const XmlElement& joint : robot.children("joint"))
      for (const char* end : {"parent", "child"})
        if (const std::optional<XmlElement> side = joint.child(end);
            side && side->find("link") == name)
          return true;
  }
  return false;
}

/// Merges the elements of one overlay and remembers their tags and names, so that an element that
/// occurs twice is an error.
class Merger {
 public:
  Merger(const XmlDocument& overlay, XmlDocument* base) : overlay_(overlay), base_(base) {}

  void merge(const XmlElement& patch) {
    const std::string tag = patch.tag();
    const bool known = is_annotation(tag) || tag == "link" || tag == "joint";
    if (!known)
      patch.fail("an overlay cannot contain this element", "<" + tag + ">",
                 "link, joint, loop, coupling, " + list_names(find_rule("robot")->children));
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
      throw unknown_name(patch.where("name"), patch.label(), tag + " of " + base_->file(), name,
                         names_of(base_->robot(), tag.c_str()));
    } else {
      added_.insert(base_->append_copy(base_->robot(), patch.node(), overlay_));
    }
  }

 private:
  /// The value of a parameter comes from its declaration or from a setting in an overlay; of
  /// several overlays the last one counts.
  void give_value_once(const XmlElement& patch, const std::string& name) {
    const bool declares = patch.tag() == kParameterTag;
    if (seen_.count(std::string(declares ? kSetTag : kParameterTag) + " " + name) != 0)
      patch.fail("the overlay declares this parameter and sets it, too", name, "one of the two");
    XMLElement* set =
        declares && patch.has("value") ? find_named(base_->robot(), kSetTag, name) : nullptr;
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

namespace {

using tinyxml2::XMLElement;

/// The index of the parameter that an element sets.
std::size_t index_of(const XmlElement& set, const std::vector<Parameter>& parameters) {
  const std::string name = set.text("name");
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&name](const Parameter& known) { return known.name == name; });
  if (found != parameters.end()) return to_index(found - parameters.begin());
  std::vector<std::string> known;
  for (const Parameter& parameter : parameters) known.push_back(parameter.name);
  throw unknown_name(set.where("name"), set.label(), "parameter of the model", name, known);
}

/// Reads value and bounds into `parameter`, and writes the bounds into its declaration.
void read_set(const XmlElement& set, XMLElement* declaration, Parameter* parameter) {
  parameter->value = read_number(set, "value", Range::kAny);
  for (const auto& [name, bound] : {std::pair<const char*, double*>{"lower", &parameter->lower},
                                    {"upper", &parameter->upper}}) {
    if (!set.has(name)) continue;
    *bound = read_number(set, name, Range::kAny);
    declaration->SetAttribute(name, to_decimal(*bound).c_str());
  }
  if (parameter->lower > parameter->upper)
    set.fail("the lower bound is above the upper bound", range_of(*parameter), "lower <= upper");
  if (parameter->value < parameter->lower || parameter->value > parameter->upper)
    set.fail_at("value", "the value is outside the bounds of the parameter", range_of(*parameter));
}

/// Two hyphens end a comment in XML.
std::string comment_of(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at))
    text.insert(at + 1, " ");
  return " " + text + " ";
}

void add_comment(const std::string& text, XMLElement* robot) {
  if (!text.empty())
    robot->InsertEndChild(robot->GetDocument()->NewComment(comment_of(text).c_str()));
}

}  // namespace

void refuse_set_values(const XmlDocument& model) {
  const XmlElement robot(model.robot(), &model);
  for (const XmlElement& set : robot.children(kSetTag))
    set.fail("only an overlay sets values of parameters", set.find("name").value_or(""),
             "the value in <codesign:parameter>");
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

std::string write_set_overlay(const std::string& robot, const std::string& heading,
                              const std::vector<SetValue>& values, const std::string& ending) {
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
