// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_checks.h"

#include <algorithm>
#include <map>
#include <optional>

#include "math/arrays.h"
#include "reading/urdf/quantity_reader.h"
#include "reading/urdf/vocabulary.h"
#include "reading/xml/xml_element.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Names = std::vector<std::string>;

bool has_prefix(const std::string& name) { return name.find(':') != std::string::npos; }
bool is_ours(const std::string& name) { return name.rfind(kPrefix, 0) == 0; }

/// The annotation that is allowed here and whose name is `tag` with the prefix; empty if there is
/// none.
std::string forgotten_prefix(const std::string& tag, const ElementRule* rule) {
  const std::string prefixed = kPrefix + tag;
  return rule != nullptr && contains(rule->children, prefixed) ? prefixed : "";
}

/// What stands beside a name in a list; null if it is not there.
const std::string* found(const std::vector<std::pair<std::string, std::string>>& list,
                         const std::string& name) {
  const auto place = std::find_if(list.begin(), list.end(),
                                  [&name](const auto& each) { return each.first == name; });
  return place == list.end() ? nullptr : &place->second;
}

bool same_number(const XmlElement& element, const std::string& a, const std::string& b) {
  const auto number = [&element](const std::string& attribute) {
    const std::optional<std::string> text = element.find(attribute);
    return text ? parse_number(*text) : std::nullopt;
  };
  return number(a).has_value() && number(a) == number(b);
}

class Check {
 public:
  void visit(const XmlElement& element, const std::string& path) {
    const ElementRule* rule = find_rule(path);
    const Vocabulary* words = find_vocabulary(path);
    check_repeats(element, rule, words);
    if (words != nullptr) {
      for (const std::string& attribute : element.attributes())
        check_attribute(element, attribute, *words);
      for (const XmlElement& child : element.children()) check_child(child, rule, *words);
    }
    for (const XmlElement& child : element.children()) visit(child, path + "/" + child.tag());
  }

  const Warnings& warnings() const { return warnings_; }

 private:
  void check_attribute(const XmlElement& element, const std::string& attribute,
                       const Vocabulary& words) {
    if (contains(words.attributes, attribute) || has_prefix(attribute)) return;
    if (element.in_overlay(attribute))
      throw unknown_name(element.where(attribute), element.label(), "attribute " + attribute,
                         attribute, words.attributes);
    if (contains(words.other_attributes, attribute)) return;
    if (const std::string* twin = found(words.repeats, attribute)) {
      if (!same_number(element, attribute, *twin))
        warnings_.push_back(element.warning_at("unknown_attribute", attribute,
                                               "the attribute " + attribute +
                                                   " is ignored, since " + *twin +
                                                   " counts, which is another number",
                                               "correct " + *twin + ", or remove " + attribute));
      return;
    }
    const std::string near = nearest_name(attribute, words.attributes);
    const std::string advice = near.empty() ? "" : "write " + near + ", or ";
    warnings_.push_back(element.warning_at("unknown_attribute", attribute,
                                           "the attribute " + attribute +
                                               " is ignored, since no reader of URDF knows it" +
                                               did_you_mean(near),
                                           advice + "remove it"));
  }

  void check_child(const XmlElement& child, const ElementRule* rule, const Vocabulary& words) {
    const std::string tag = child.tag();
    if (contains(words.children, tag) || is_ours(tag)) return;
    Names known = words.children;
    if (rule != nullptr) known.insert(known.end(), rule->children.begin(), rule->children.end());
    std::string near = forgotten_prefix(tag, rule);
    if (near.empty()) near = nearest_name(tag, known);
    if (child.in_overlay())
      throw InputError({child.where(), child.label(),
                        "unknown element <" + tag + ">" + did_you_mean(near), tag,
                        list_names(known)});
    if (has_prefix(tag) || contains(words.other_children, tag)) return;
    if (const Names places = elements_with(tag); !places.empty()) {
      warnings_.push_back(
          child.warning("unknown_element", "the element does not belong here and is ignored",
                        "<" + tag + ">", "move it into " + list_names(places) + ", or remove it"));
      return;
    }
    if (near.empty()) return;
    warnings_.push_back(child.warning(
        "unknown_element",
        "the element is ignored, since no reader of URDF knows it, did you mean \"" + near + "\"?",
        "<" + tag + ">", "write <" + near + ">, or remove it"));
  }

  void check_repeats(const XmlElement& element, const ElementRule* rule, const Vocabulary* words) {
    std::map<std::string, int> count;
    for (const XmlElement& child : element.children()) {
      const std::string tag = child.tag();
      if (++count[tag] != 2) continue;
      const bool strict =
          (rule != nullptr && rule->strict) || (is_ours(tag) && element.tag() != "robot");
      const bool single =
          words != nullptr && !words->repeats_children && contains(words->children, tag);
      const bool inertial = tag == "inertial" && element.tag() == "link";
      if (strict || ((single || inertial) && child.in_overlay()))
        child.fail("a second <" + tag + ">", "", "one at most");
      if (single || inertial)
        warnings_.push_back(
            child.warning("repeated_element",
                          "a second <" + tag + ">; the first one is used, as other readers do", "",
                          "remove one"));
    }
  }

  Warnings warnings_;
};

/// The prefix of a name: the part before the colon; of a declaration `xmlns:x` the part after it.
std::string prefix_of(const std::string& name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos) return "";
  return name.substr(0, colon) == "xmlns" ? name.substr(colon + 1) : name.substr(0, colon);
}

void check_prefix(const std::string& name, const SourceLocation& where, const XmlElement& element) {
  const std::string prefix = prefix_of(name), ours = "codesign";
  if (prefix.empty() || prefix == ours || nearest_name(prefix, {ours}).empty()) return;
  throw InputError(
      {where, element.label(), "unknown prefix, did you mean \"codesign\"?", name, "codesign:"});
}

/// Elements of xacro that are left would be lost, with what they stand for. Generated files keep
/// the declaration of the namespace alone.
/// @param xacro prefixes of xacro's namespace at the parent
void refuse_xacro(const XmlElement& element, Names* xacro) {
  const std::string declaration = "xmlns:";
  for (const std::string& attribute : element.attributes())
    if (attribute.rfind(declaration, 0) == 0 &&
        element.find(attribute).value_or("").find("ros.org/") != std::string::npos &&
        element.find(attribute).value_or("").find("xacro") != std::string::npos)
      xacro->push_back(attribute.substr(declaration.size()));
  if (contains(*xacro, prefix_of(element.tag())))
    element.fail("xacro has not been run on this file, whose elements of xacro would be lost",
                 "<" + element.tag() + ">", "plain URDF: xacro FILE.xacro > FILE.urdf");
}

/// @param xacro prefixes of xacro's namespace at the parent
void check_prefixes_in(const XmlElement& element, Names xacro) {
  check_prefix(element.tag(), element.where(), element);
  refuse_xacro(element, &xacro);
  for (const std::string& attribute : element.attributes()) {
    check_prefix(attribute, element.where(attribute), element);
    const bool declares = attribute.rfind("xmlns", 0) == 0 && attribute != "xmlns:codesign";
    if (declares && element.find(attribute) == "urn:mechanism_codesign")
      element.fail_at(attribute,
                      "the namespace urn:mechanism_codesign must have the prefix codesign",
                      "xmlns:codesign=\"urn:mechanism_codesign\"");
  }
  for (const XmlElement& child : element.children()) check_prefixes_in(child, xacro);
}

Warning after_robot(const SourceLocation& where, const std::string& what,
                    const std::string& value) {
  return warn(
      "after_robot",
      {where, "",
       what +
           " stands after </robot>; it is ignored, as other readers do; to silence this: remove it",
       value, ""});
}

void refuse_text_in(const tinyxml2::XMLElement& element, const XmlDocument& document) {
  for (const tinyxml2::XMLNode* node = element.FirstChild(); node != nullptr;
       node = node->NextSibling()) {
    if (node->ToText() != nullptr)
      throw InputError({{document.file(), node->GetLineNum()},
                        XmlElement(&element, &document).label(),
                        "text between elements is not read",
                        std::string(node->Value()).substr(0, 40),
                        "elements and comments"});
    if (node->ToElement() != nullptr) refuse_text_in(*node->ToElement(), document);
  }
}

}  // namespace

void refuse_text(const XmlDocument& overlay) { refuse_text_in(*overlay.robot(), overlay); }

void check_vocabulary(const XmlDocument& document, Warnings* warnings) {
  Check check;
  check.visit(XmlElement(document.robot(), &document), "robot");
  warnings->insert(warnings->end(), check.warnings().begin(), check.warnings().end());
}

void check_prefixes(const XmlDocument& document) {
  check_prefixes_in(XmlElement(document.robot(), &document), {"xacro"});
}

Warnings check_surroundings(const XmlDocument& document) {
  Warnings warnings;
  for (const tinyxml2::XMLNode* node = document.robot()->NextSibling(); node != nullptr;
       node = node->NextSibling()) {
    const std::string what = node->ToElement() != nullptr ? "a second root element" : "text";
    if (node->ToElement() == nullptr && node->ToText() == nullptr) continue;
    const std::string value = node->ToElement() != nullptr
                                  ? std::string("<") + node->Value() + ">"
                                  : std::string(node->Value()).substr(0, 40);
    warnings.push_back(after_robot({document.file(), node->GetLineNum()}, what, value));
  }
  return warnings;
}

Warnings cut_trailing_text(SourceText* source) {
  const std::string end = "</robot>";
  std::size_t at = source->text.rfind(end);
  if (at == std::string::npos) return {};
  at += end.size();
  const std::string rest = source->text.substr(at);
  const std::size_t first = rest.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || rest.find_first_of("<>") != std::string::npos) return {};
  const auto lines =
      std::count(source->text.begin(), source->text.begin() + to_signed(at + first), '\n');
  source->text.resize(at);
  return {after_robot({source->name, static_cast<int>(lines) + 1}, "text", rest.substr(first, 40))};
}

}  // namespace codesign
