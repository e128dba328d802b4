// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/pictures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "text/number_text.h"

namespace codesign {
namespace {

using tinyxml2::XMLElement;

/// The drawable parts of a link.
struct Skeleton {
  bool is_root = true, slides = false;
  /// frames of the joints and loops that hang on it, in its frame [m]
  std::vector<Eigen::Vector3d> points;
};

using Skeletons = std::map<std::string, Skeleton>;

std::string text_of(const XMLElement* element, const char* attribute) {
  const char* text = element != nullptr ? element->Attribute(attribute) : nullptr;
  return text != nullptr ? text : "";
}

Skeletons read_skeletons(const XMLElement* robot) {
  Skeletons skeletons;
  for (const XMLElement* joint = robot->FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    Skeleton& child = skeletons[text_of(joint->FirstChildElement("child"), "link")];
    child.is_root = false;
    child.slides = text_of(joint, "type") == "prismatic";
    skeletons[text_of(joint->FirstChildElement("parent"), "link")].points.emplace_back(
        plain_origin(joint).translation());
  }
  for (const XMLElement* loop = robot->FirstChildElement("loop"); loop != nullptr;
       loop = loop->NextSiblingElement("loop"))
    for (const char* end : {"predecessor", "successor"}) {
      const XMLElement* place = loop->FirstChildElement(end);
      skeletons[text_of(place, "link")].points.emplace_back(plain_origin(place).translation());
    }
  return skeletons;
}

double mass_of(const XMLElement* link) {
  const XMLElement* inertial = link->FirstChildElement("inertial");
  return inertial != nullptr ? plain_number(inertial->FirstChildElement("mass"), "value") : 0.0;
}

/// Whether a viewer can load a visual or a collision.
bool is_loadable(const XMLElement* shape, MeshFinder* meshes) {
  const XMLElement* geometry = shape->FirstChildElement("geometry");
  const XMLElement* mesh = geometry != nullptr ? geometry->FirstChildElement("mesh") : nullptr;
  return mesh == nullptr || meshes->is_there(text_of(mesh, "filename"));
}

/// Removes the visuals and collisions that a viewer cannot load, since rviz shows the whole robot
/// as faulty for one of them. Returns whether there were any.
bool remove_missing(XMLElement* link, MeshFinder* meshes) {
  bool has_removed = false;
  for (const char* kind : {"visual", "collision"})
    for (XMLElement *shape = link->FirstChildElement(kind), *next = nullptr; shape != nullptr;
         shape = next) {
      next = shape->NextSiblingElement(kind);
      if (is_loadable(shape, meshes)) continue;
      link->DeleteChild(shape);
      has_removed = true;
    }
  return has_removed;
}

bool is_seen(const XMLElement* link) { return link->FirstChildElement("visual") != nullptr; }

std::string numbers(const Eigen::Vector3d& v) {
  return to_decimal(v.x()) + ' ' + to_decimal(v.y()) + ' ' + to_decimal(v.z());
}

/// Adds visuals of one color to a link.
class Pencil {
 public:
  Pencil(XMLElement* link, double radius, const char* material, const char* rgba)
      : link_(link), radius_(radius), material_(material), rgba_(rgba) {}

  void stick(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d along = to - from;
    const double length = along.norm();
    if (length < 0.5 * radius_) return;
    const double tilt = std::acos(std::clamp(along.z() / length, -1.0, 1.0)),
                 turn = std::atan2(along.y(), along.x());
    XMLElement* cylinder = add(0.5 * (from + to), {0.0, tilt, turn}, "cylinder");
    cylinder->SetAttribute("radius", to_decimal(radius_).c_str());
    cylinder->SetAttribute("length", to_decimal(length).c_str());
  }

  void sphere(const Eigen::Vector3d& at, double size) {
    add(at, Eigen::Vector3d::Zero(), "sphere")
        ->SetAttribute("radius", to_decimal(size * radius_).c_str());
  }

  void box(const Eigen::Vector3d& at, double size) {
    add(at, Eigen::Vector3d::Zero(), "box")
        ->SetAttribute("size", numbers(Eigen::Vector3d::Constant(size * radius_)).c_str());
  }

 private:
  XMLElement* add(const Eigen::Vector3d& at, const Eigen::Vector3d& rpy, const char* shape) {
    XMLElement* visual = link_->InsertNewChildElement("visual");
    visual->SetAttribute("name", "stick");
    XMLElement* origin = visual->InsertNewChildElement("origin");
    origin->SetAttribute("xyz", numbers(at).c_str());
    origin->SetAttribute("rpy", numbers(rpy).c_str());
    XMLElement* result = visual->InsertNewChildElement("geometry")->InsertNewChildElement(shape);
    XMLElement* material = visual->InsertNewChildElement("material");
    material->SetAttribute("name", material_);
    material->InsertNewChildElement("color")->SetAttribute("rgba", rgba_);
    return result;
  }

  XMLElement* link_;
  double radius_;
  const char *material_, *rgba_;
};

void draw_root(const Skeleton& skeleton, double radius, XMLElement* link) {
  Pencil pencil(link, radius, "stick_ground", "0.45 0.47 0.5 1");
  for (std::size_t k = 1; k < skeleton.points.size(); ++k)
    pencil.stick(skeleton.points[k - 1], skeleton.points[k]);
}

void draw_link(const Skeleton& skeleton, double radius, XMLElement* link) {
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Pencil sticks(link, radius, "stick_link", "0.16 0.42 0.75 1"),
      ends(link, radius, "stick_joint", "0.93 0.49 0.13 1");
  for (const Eigen::Vector3d& point : skeleton.points) sticks.stick(origin, point);
  if (mass_of(link) <= 0.0) return;
  if (skeleton.slides)
    ends.box(origin, 5.0);
  else
    ends.sphere(origin, 1.8);
  const bool is_last = std::all_of(skeleton.points.begin(), skeleton.points.end(),
                                   [&](const auto& p) { return p.norm() < radius; });
  const Eigen::Vector3d centre = plain_origin(link->FirstChildElement("inertial")).translation();
  if (!is_last || centre.norm() < radius) return;
  sticks.stick(origin, centre);
  sticks.sphere(centre, 3.0);
}

/// The longest link, from its frame to the frame of a joint or to its centre of mass [m].
double longest(const XMLElement* robot, const Skeletons& skeletons) {
  double length = 0.0;
  for (const auto& [name, skeleton] : skeletons)
    for (const Eigen::Vector3d& point : skeleton.points) length = std::max(length, point.norm());
  for (const XMLElement* link = robot->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link"))
    length =
        std::max(length, plain_origin(link->FirstChildElement("inertial")).translation().norm());
  return length > 0.0 ? length : 0.2;
}

}  // namespace

std::string with_sticks(const std::string& urdf) {
  tinyxml2::XMLDocument document;
  if (document.Parse(urdf.c_str(), urdf.size()) != tinyxml2::XML_SUCCESS ||
      document.RootElement() == nullptr)
    return urdf;
  XMLElement* robot = document.RootElement();
  const Skeletons skeletons = read_skeletons(robot);
  const double radius = 0.02 * longest(robot, skeletons);
  bool has_changed = false;
  MeshFinder meshes;
  for (XMLElement* link = robot->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    has_changed = remove_missing(link, &meshes) || has_changed;
    const auto found = skeletons.find(text_of(link, "name"));
    if (found == skeletons.end() || is_seen(link)) continue;
    if (found->second.is_root)
      draw_root(found->second, radius, link);
    else
      draw_link(found->second, radius, link);
    has_changed = has_changed || is_seen(link);
  }
  if (!has_changed) return urdf;
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace codesign
