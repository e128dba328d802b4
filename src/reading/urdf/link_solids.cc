// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/pictures.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {

double plain_number(const tinyxml2::XMLElement* element, const char* attribute) {
  const char* text = element != nullptr ? element->Attribute(attribute) : nullptr;
  const double value = text != nullptr ? parse_number(text).value_or(0.0) : 0.0;
  return std::isfinite(value) ? value : 0.0;
}

Eigen::Vector3d plain_vector(const tinyxml2::XMLElement* element, const char* attribute) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  const char* text = element != nullptr ? element->Attribute(attribute) : nullptr;
  if (text == nullptr) return result;
  const std::vector<std::string> words = split_words(text);
  for (std::size_t k = 0; k < words.size() && k < 3; ++k) {
    const double value = parse_number(words[k]).value_or(0.0);
    if (std::isfinite(value)) result[to_signed(k)] = value;
  }
  return result;
}

Eigen::Isometry3d plain_origin(const tinyxml2::XMLElement* element) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (element == nullptr) return pose;
  const bool is_origin =
      element->Attribute("xyz") != nullptr || element->Attribute("rpy") != nullptr;
  const tinyxml2::XMLElement* origin = is_origin ? element : element->FirstChildElement("origin");
  const Eigen::Vector3d rpy = plain_vector(origin, "rpy");
  pose.linear() = (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() = plain_vector(origin, "xyz");
  return pose;
}

namespace {

using tinyxml2::XMLElement;

/// Half of the sides of the shape's box; zero for a shape without a known size.
Eigen::Vector3d half_of(const XMLElement* geometry) {
  const XMLElement* shape = geometry != nullptr ? geometry->FirstChildElement() : nullptr;
  if (shape == nullptr) return Eigen::Vector3d::Zero();
  const std::string kind = shape->Name();
  const double radius = plain_number(shape, "radius");
  if (kind == "box") return 0.5 * plain_vector(shape, "size").cwiseAbs();
  if (kind == "sphere") return Eigen::Vector3d::Constant(radius);
  if (kind == "cylinder") return {radius, radius, 0.5 * plain_number(shape, "length")};
  return Eigen::Vector3d::Zero();
}

std::vector<SolidBox> boxes_of(const XMLElement* link, const char* tag) {
  std::vector<SolidBox> boxes;
  for (const XMLElement* solid = link->FirstChildElement(tag); solid != nullptr;
       solid = solid->NextSiblingElement(tag)) {
    const SolidBox box{plain_origin(solid), half_of(solid->FirstChildElement("geometry"))};
    if (box.half.minCoeff() > 0.0) boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

LinkBoxes link_boxes(const std::string& urdf, const std::vector<std::string>& links,
                     const char* tag) {
  LinkBoxes boxes(links.size());
  tinyxml2::XMLDocument document;
  if (document.Parse(urdf.c_str(), urdf.size()) != tinyxml2::XML_SUCCESS ||
      document.RootElement() == nullptr)
    return boxes;
  for (const XMLElement* link = document.RootElement()->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    const char* name = link->Attribute("name");
    const auto found = std::find(links.begin(), links.end(), name != nullptr ? name : "");
    if (found != links.end()) boxes[to_index(found - links.begin())] = boxes_of(link, tag);
  }
  return boxes;
}

}  // namespace codesign
