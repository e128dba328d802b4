// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/joint_reader.h"

#include <algorithm>
#include <map>

#include "math/arrays.h"
#include "mechanism/constants.h"
#include "mechanism/pose.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// One end of a loop, with the values that the file gives.
struct End {
  std::string link = "...";
  std::string xyz, rpy;
  bool placed = false;  ///< the file gives the position; empty xyz and rpy then mean zero
};

struct Suggestion {
  std::string name, type;
  End predecessor, successor;
  std::string axis;
};

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string end_text(const char* tag, const End& end) {
  std::string origin;
  if (!end.placed) origin = attribute("xyz", "...");
  if (!end.xyz.empty()) origin += attribute("xyz", end.xyz);
  if (!end.rpy.empty()) origin += attribute("rpy", end.rpy);
  const std::string head = std::string("<") + tag + attribute("link", end.link);
  return origin.empty() ? head + "/>" : head + "><origin" + origin + "/></" + tag + ">";
}

std::string loop_text(const Suggestion& s) {
  return "<loop" + attribute("name", s.name.empty() ? "..." : s.name) + attribute("type", s.type) +
         ">" + end_text("predecessor", s.predecessor) + end_text("successor", s.successor) +
         (s.axis.empty() ? "" : "<axis" + attribute("xyz", s.axis) + "/>") + "</loop>";
}

std::string mimic_text(const std::string& joint, const std::string& other,
                       const std::string& multiplier, const std::string& offset) {
  return "<joint" + attribute("name", joint) + "><mimic" + attribute("joint", other) +
         attribute("multiplier", multiplier) + attribute("offset", offset) + "/></joint>";
}

/// The type of `<loop>` for another tool's joint type; `...` if there is none.
std::string loop_type(const std::string& type) {
  static const std::map<std::string, std::string> kTypes = {
      {"ball", "codesign:spherical"},
      {"spherical", "codesign:spherical"},
      {"universal", "codesign:universal"},
      {"weld", "fixed"},
      {"fixed", "fixed"},
      {"revolute", "revolute"},
      {"hinge", "revolute"},
      {"continuous", "continuous"},
      {"prismatic", "prismatic"},
      {"slide", "prismatic"},
      {"planar", "planar"},
      {"cylindrical", "codesign:cylindrical"}};
  const auto found = kTypes.find(type);
  return found != kTypes.end() ? found->second : "...";
}

std::string trimmed(const char* text) {
  std::string joined;
  for (const std::string& word : split_words(text != nullptr ? text : ""))
    joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

/// The text of a child, such as SDF's <parent>arm</parent>; empty if there is none.
std::string child_text(const XmlElement& element, const std::string& tag) {
  const std::optional<XmlElement> child = element.child(tag);
  return child ? trimmed(child->node()->GetText()) : "";
}

std::string child_attribute(const XmlElement& element, const std::string& tag,
                            const std::string& name) {
  const std::optional<XmlElement> child = element.child(tag);
  return child ? trimmed(child->find(name).value_or("").c_str()) : "";
}

class Finder {
 public:
  Finder(const RobotDescription& robot, Warnings* warnings) : robot_(robot), warnings_(warnings) {}

  void visit(const XmlElement& element, bool in_gazebo, bool in_equality) {
    const std::string tag = element.tag();
    if (tag == "loop_joint") return report(element, of_loop_joint(element));
    if (tag == "plugin" && in_gazebo && is_detachable(element))
      return report_detachable_joint(element);
    if (tag == "plugin" && in_gazebo) return report_mimic_plugin(element);
    if (tag == "joint" && in_gazebo) return report(element, of_gazebo(element));
    if (tag == "drake:joint") return report(element, of_drake_joint(element));
    const bool constraint = tag.rfind("drake:", 0) == 0 && ends_with(tag, "_constraint");
    if (constraint || tag == "drake:linear_bushing_rpy")
      return report(element, of_drake_constraint(element));
    if (in_equality) return report_equality(element);
    for (const XmlElement& child : element.children())
      visit(child, in_gazebo || tag == "gazebo", tag == "equality");
  }

 private:
  void report(const XmlElement& element, const std::string& remedy) {
    warnings_->push_back(element.warning(
        "loop_ignored",
        "this element connects links or couples joints in other tools and is ignored here",
        "<" + element.tag() + ">", "write, in an overlay, " + remedy + ", or remove the element"));
  }

  void report(const XmlElement& element, const Suggestion& s) {
    if (!has_loop_between(robot_, s.predecessor.link, s.successor.link))
      report(element, loop_text(s));
  }

  /// Whether the joint follows another one already, or is coupled.
  bool follows(const std::string& follower) const {
    for (const JointDescription& joint : robot_.joints)
      if (joint.name == follower) return joint.mimic || joint.is_fixed() || is_coupled(joint.child);
    return false;
  }
  bool is_coupled(int link) const {
    return std::any_of(robot_.couplings.begin(), robot_.couplings.end(),
                       [link](const CouplingDescription& coupling) {
                         return coupling.predecessor == link || coupling.successor == link;
                       });
  }

  static bool is_detachable(const XmlElement& plugin) {
    const std::string name = plugin.find("name").value_or(""),
                      file = plugin.find("filename").value_or("");
    return ends_with(name, "DetachableJoint") || file.find("detachable-joint") != std::string::npos;
  }

  // Gazebo's plugin fixes the child to the parent where both are when it begins. A child of another
  // model, such as an object that a gripper takes, is no part of this mechanism.
  void report_detachable_joint(const XmlElement& plugin) {
    Suggestion s{"", "fixed", {}, {}, ""};
    s.predecessor.link = child_text(plugin, "parent_link");
    s.successor.link = child_text(plugin, "child_link");
    const auto pose = relative_at_zero(s.predecessor.link, s.successor.link);
    if (!pose) return;
    place(*pose, &s.predecessor);
    s.successor.placed = true;
    report(plugin, s);
  }

  // Gazebo does not read <mimic> and couples joints by plugins. Usually the file has the same
  // <mimic> too; then there is no warning.
  void report_mimic_plugin(const XmlElement& plugin) {
    const std::string follower = child_text(plugin, "mimicJoint"),
                      leader = child_text(plugin, "joint");
    if (follower.empty() || leader.empty()) return;
    if (follows(follower)) return;
    const std::string multiplier = child_text(plugin, "multiplier"),
                      offset = child_text(plugin, "offset");
    report(plugin, mimic_text(follower, leader, multiplier.empty() ? "1" : multiplier,
                              offset.empty() ? "0" : offset));
  }

  Suggestion of_loop_joint(const XmlElement& element) const {
    Suggestion s{element.find("name").value_or(""),
                 loop_type(element.find("type").value_or("revolute")),
                 {},
                 {},
                 ""};
    const auto end = [&element](const char* tag) {
      End result;
      if (const std::optional<XmlElement> link = element.child(tag)) {
        result = {link->find("link").value_or("..."), link->find("xyz").value_or(""),
                  link->find("rpy").value_or(""), true};
      }
      return result;
    };
    s.predecessor = end("link1");
    s.successor = end("link2");
    s.axis = child_attribute(element, "axis", "xyz");
    return s;
  }

  // In SDF the pose of a joint is given in the child link's frame.
  Suggestion of_gazebo(const XmlElement& element) const {
    Suggestion s{element.find("name").value_or(""),
                 loop_type(element.find("type").value_or("")),
                 {},
                 {},
                 ""};
    const std::string parent = child_text(element, "parent"), child = child_text(element, "child");
    if (!parent.empty()) s.predecessor.link = parent;
    if (!child.empty()) s.successor.link = child;
    Pose<double> X_CF;
    std::vector<double> pose;
    for (const std::string& word : split_words(child_text(element, "pose")))
      pose.push_back(parse_number(word).value_or(0.0));
    pose.resize(6, 0.0);
    X_CF.t = {pose[0], pose[1], pose[2]};
    X_CF.R = rotation_from_rpy<double>(Vector3<double>(pose[3], pose[4], pose[5]));
    place(X_CF, &s.successor);
    if (const auto X_PC = relative_at_zero(s.predecessor.link, s.successor.link))
      place(*X_PC * X_CF, &s.predecessor);
    if (const std::optional<XmlElement> axis = element.child("axis"))
      s.axis = child_text(*axis, "xyz");
    return s;
  }

  Suggestion of_drake_joint(const XmlElement& element) const {
    Suggestion s{element.find("name").value_or(""),
                 loop_type(element.find("type").value_or("")),
                 {},
                 {},
                 ""};
    const std::string parent = child_attribute(element, "parent", "link"),
                      child = child_attribute(element, "child", "link");
    s.predecessor = {parent.empty() ? "..." : parent, child_attribute(element, "origin", "xyz"),
                     child_attribute(element, "origin", "rpy"), true};
    s.successor = {child.empty() ? "..." : child, "", "", true};
    s.axis = child_attribute(element, "axis", "xyz");
    return s;
  }

  // Its children are <drake:ball_constraint_body_A name/>, <drake:ball_constraint_p_AP value/> and
  // similar ones.
  Suggestion of_drake_constraint(const XmlElement& element) const {
    Suggestion s{"", "codesign:spherical", {}, {}, ""};
    if (element.tag() == "drake:weld_constraint") s.type = "fixed";
    if (element.tag() == "drake:distance_constraint") s.type = "codesign:distance";
    for (const XmlElement& part : element.children()) {
      const std::string tag = part.tag();
      const std::string name = part.find("name").value_or(""),
                        value = part.find("value").value_or("");
      End* const end = tag.find("_A") != std::string::npos ? &s.predecessor : &s.successor;
      if (ends_with(tag, "_body_A") || ends_with(tag, "_body_B")) end->link = name;
      if (!ends_with(tag, "_p_AP") && !ends_with(tag, "_p_BQ")) continue;
      End* const at = ends_with(tag, "_p_AP") ? &s.predecessor : &s.successor;
      at->xyz = trimmed(value.c_str());
      at->placed = true;
    }
    return s;
  }

  void report_equality(const XmlElement& element) {
    if (element.tag() != "joint") return report(element, of_equality(element));
    const std::string follower = element.find("joint1").value_or("...");
    std::vector<std::string> polynomial = split_words(element.find("polycoef").value_or("0 1"));
    polynomial.resize(2, "0");
    if (!follows(follower))
      report(element, mimic_text(follower, element.find("joint2").value_or("..."), polynomial[1],
                                 polynomial[0]));
  }

  Suggestion of_equality(const XmlElement& element) const {
    Suggestion s{element.find("name").value_or(""),
                 element.tag() == "weld" ? "fixed" : "codesign:spherical",
                 {},
                 {},
                 ""};
    s.predecessor.link = element.find("body1").value_or("...");
    s.successor.link = element.find("body2").value_or(robot_.links[to_index(robot_.root)].name);
    Pose<double> X_1F;
    const std::vector<std::string> anchor = split_words(element.find("anchor").value_or("0 0 0"));
    for (std::size_t k = 0; k < anchor.size() && k < 3; ++k)
      X_1F.t[to_signed(k)] = parse_number(anchor[k]).value_or(0.0);
    place(X_1F, &s.predecessor);
    if (const auto X_21 = relative_at_zero(s.successor.link, s.predecessor.link))
      place(*X_21 * X_1F, &s.successor);
    if (element.tag() != "weld") s.predecessor.rpy = s.successor.rpy = "";
    return s;
  }

  static void place(const Pose<double>& X, End* end) {
    const auto text = [](const Vector3<double>& v) {
      const auto rounded = [](double x) { return std::round(x * 1e9) / 1e9 + 0.0; };
      return format_numbers({rounded(v[0]), rounded(v[1]), rounded(v[2])});
    };
    end->placed = true;
    end->xyz = text(X.t);
    const Vector3<double> rpy(std::atan2(X.R(2, 1), X.R(2, 2)),
                              std::asin(std::clamp(-X.R(2, 0), -1.0, 1.0)),
                              std::atan2(X.R(1, 0), X.R(0, 0)));
    end->rpy = rpy.norm() > 1e-9 ? text(rpy) : "";
  }

  /// The pose of link `b` in link `a` with all joints at zero; std::nullopt if a link is unknown.
  std::optional<Pose<double>> relative_at_zero(const std::string& a, const std::string& b) const {
    const auto X_Wa = at_zero(a), X_Wb = at_zero(b);
    if (!X_Wa || !X_Wb) return std::nullopt;
    return X_Wa->inverse() * *X_Wb;
  }

  std::optional<Pose<double>> at_zero(const std::string& name) const {
    const auto found =
        std::find_if(robot_.links.begin(), robot_.links.end(),
                     [&name](const LinkDescription& link) { return link.name == name; });
    if (found == robot_.links.end()) return std::nullopt;
    const std::vector<double> defaults = default_values(robot_);
    Pose<double> X;
    for (int link = static_cast<int>(found - robot_.links.begin()); link != robot_.root;) {
      const auto above = std::find_if(
          robot_.joints.begin(), robot_.joints.end(),
          [link](const JointDescription& joint) { return !joint.is_loop && joint.child == link; });
      if (above == robot_.joints.end()) return std::nullopt;
      X = pose_at(above->origin, defaults) * X;
      link = above->parent;
    }
    return X;
  }

  const RobotDescription& robot_;
  Warnings* warnings_;
};

}  // namespace

void warn_of_foreign_loops(const XmlElement& robot, const RobotDescription& description,
                           Warnings* warnings) {
  Finder finder(description, warnings);
  for (const XmlElement& child : robot.children())
    if (child.tag() != "link" && child.tag() != "joint") finder.visit(child, false, false);
}

}  // namespace codesign
