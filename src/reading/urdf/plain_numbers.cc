// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/plain_numbers.h"

#include <cmath>
#include <string>
#include <vector>

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
    if (std::isfinite(value)) result[static_cast<Eigen::Index>(k)] = value;
  }
  return result;
}

Eigen::Isometry3d plain_origin(const tinyxml2::XMLElement* element) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (element == nullptr) return pose;
  const bool is_origin = element->Attribute("xyz") != nullptr || element->Attribute("rpy") != nullptr;
  const tinyxml2::XMLElement* origin = is_origin ? element : element->FirstChildElement("origin");
  const Eigen::Vector3d rpy = plain_vector(origin, "rpy");
  pose.linear() = (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() = plain_vector(origin, "xyz");
  return pose;
}

}  // namespace codesign
