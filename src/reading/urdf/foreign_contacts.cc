// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/foreign_contacts.h"

#include <algorithm>
#include <set>
#include <string>

#include "math/arrays.h"
#include "reading/urdf/urdf_reader.h"
#include "reading/xml/xml_element.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A key of another tool and the attribute that says the same here; null: none does.
struct ContactKey {
  const char* name;
  const char* attribute;
};

constexpr ContactKey kElements[] = {
    // Gazebo, in <gazebo reference> and in SDF's <surface>
    {"kp", "stiffness"},
    {"kd", "dissipation"},
    {"mu1", "mu_static"},
    {"mu2", nullptr},
    {"mu", "mu_static"},
    {"minDepth", nullptr},
    {"min_depth", nullptr},
    {"maxVel", nullptr},
    {"max_vel", nullptr},
    {"maxContacts", nullptr},
    {"restitution_coefficient", "restitution"},
    {"soft_cfm", nullptr},
    {"soft_erp", nullptr},
    // Bullet, in <contact>
    {"stiffness", "stiffness"},
    {"damping", "damping"},
    {"lateral_friction", "mu_static"},
    {"rolling_friction", nullptr},
    {"spinning_friction", nullptr},
    {"contact_cfm", nullptr},
    {"contact_erp", nullptr},
    {"restitution", "restitution"},
    // Drake
    {"drake:mu_static", "mu_static"},
    {"drake:mu_dynamic", "mu_dynamic"},
    {"drake:point_contact_stiffness", "stiffness"},
    {"drake:hunt_crossley_dissipation", "dissipation"},
    {"drake:hydroelastic_modulus", nullptr},
    {"drake:rigid_hydroelastic", nullptr},
    {"drake:compliant_hydroelastic", nullptr},
};
/// Of <contact_coefficients>, and of MuJoCo's <geom> and <pair>.
constexpr ContactKey kAttributes[] = {
    {"mu", "mu_static"}, {"kp", "stiffness"}, {"kd", "dissipation"},     {"solref", nullptr},
    {"solimp", nullptr}, {"condim", nullptr}, {"friction", "mu_static"}, {"solmix", nullptr},
};

constexpr const char* kMessage =
    "contact keys of other tools have no effect here, where links touch only by "
    "<codesign:contact>";

/// Whether a number of another tool can be the attribute's.
bool fits(const std::string& attribute, double number) {
  if (attribute == "restitution") return number > 0.0 && number <= 1.0;
  return attribute == "stiffness" ? number > 0.0 : number >= 0.0;
}

/// What MuJoCo's constraints other than contacts have solref and solimp for.
bool is_no_contact(const std::string& tag) {
  return tag == "plugin" || tag == "sensor" || tag == "equality" || tag == "tendon";
}

template <std::size_t N>
const ContactKey* find_key(const ContactKey (&keys)[N], const std::string& name) {
  for (const ContactKey& key : keys)
    if (name == key.name) return &key;
  return nullptr;
}

/// Gathers the keys of one link, or of a file's defaults.
class KeyFinder {
 public:
  void visit(const XmlElement& element) {
    for (const ContactKey& key : kAttributes)
      if (element.has(key.name)) take(key, element.find(key.name).value_or(""));
    for (const XmlElement& child : element.children()) {
      if (const ContactKey* const key = find_key(kElements, child.tag())) {
        const char* const text = child.node()->GetText();
        take(*key, child.find("value").value_or(text != nullptr ? text : ""));
      } else if (!is_no_contact(child.tag())) {
        visit(child);
      }
    }
  }

  bool is_empty() const { return names_.empty(); }
  std::string names() const { return list_names({names_.begin(), names_.end()}); }
  std::string of_contact() const { return of_contact_; }
  std::string of_friction() const { return of_friction_; }
  bool has_stiffness() const { return has_stiffness_; }  ///< a number [N/m]

 private:
  void take(const ContactKey& key, const std::string& text) {
    names_.insert(key.name);
    const std::vector<std::string> words = split_words(text);
    if (key.attribute == nullptr || words.empty()) return;
    const std::string attribute = key.attribute;
    // Their damping counts per rate, lambda of Hunt and Crossley per force: there is no number.
    if (attribute == "dissipation") return;
    const bool is_friction = attribute.rfind("mu_", 0) == 0;
    std::string& to = is_friction ? of_friction_ : of_contact_;
    if (to.find(" " + attribute + "=") != std::string::npos) return;
    const auto number = parse_number(words.front());
    const bool is_same = number && fits(attribute, *number);
    to += " " + attribute + "=\"" + (is_same ? to_decimal(*number) : "...") + "\"";
    if (is_same && attribute == "stiffness") has_stiffness_ = true;
  }

  std::set<std::string> names_;
  std::string of_contact_, of_friction_;
  bool has_stiffness_ = false;
};

std::string suggestion(const std::string& link, const KeyFinder& keys) {
  std::string contact = keys.of_contact(), friction = keys.of_friction();
  if (contact.find(" stiffness=") == std::string::npos) contact = " stiffness=\"...\"" + contact;
  contact += contact.find(" restitution=") == std::string::npos ? " dissipation=\"...\""
                                                                : " impact_velocity=\"...\"";
  if (keys.has_stiffness()) contact += " exponent=\"1\"";  // theirs are N/m
  if (!friction.empty() && friction.find("mu_dynamic") == std::string::npos)
    friction += " mu_dynamic=\"...\"";
  return "<codesign:contact name=\"...\"" + contact +
         "><predecessor link=\"...\" shape=\"plane\"/><successor link=\"" + link +
         "\" shape=\"...\"/>" + (friction.empty() ? "" : "<codesign:friction" + friction + "/>") +
         "</codesign:contact>";
}

bool touches(const RobotDescription& robot, const std::string& link) {
  const auto is_it = [&](const ContactEnd& end) {
    return robot.links[to_index(end.link)].name == link;
  };
  return std::any_of(robot.contacts.begin(), robot.contacts.end(),
                     [&](const ContactDescription& contact) {
                       return is_it(contact.surface) || is_it(contact.points);
                     });
}

}  // namespace

Warnings find_foreign_contacts(const SourceText& urdf, const std::vector<SourceText>& overlays,
                               const RobotDescription& description) {
  const XmlDocument document = load_annotated_urdf(urdf, overlays, description.laws);
  const XmlElement robot(document.robot(), &document);
  Warnings warnings;
  int links = 0;
  const auto look = [&](const XmlElement& element, const std::string& link) {
    KeyFinder keys;
    keys.visit(element);
    if (keys.is_empty() || touches(description, link)) return;
    if (++links > 1) return;
    warnings.push_back(element.warning("contact_not_read", kMessage, keys.names(),
                                       "write, in an overlay, " + suggestion(link, keys)));
  };
  for (const XmlElement& link : robot.children("link")) {
    const std::string name = link.find("name").value_or("...");
    for (const XmlElement& contact : link.children("contact")) look(contact, name);
    for (const XmlElement& collision : link.children("collision")) look(collision, name);
  }
  const auto is_link = [&](const std::string& name) {
    return std::any_of(description.links.begin(), description.links.end(),
                       [&name](const LinkDescription& link) { return link.name == name; });
  };
  for (const XmlElement& gazebo : robot.children("gazebo"))
    if (const std::string name = gazebo.find("reference").value_or(""); is_link(name))
      look(gazebo, name);
  for (const XmlElement& mujoco : robot.children("mujoco")) look(mujoco, "...");
  if (links > 1)
    warnings.front().message += "; " + std::to_string(links) + " places have such keys";
  return warnings;
}

}  // namespace codesign
