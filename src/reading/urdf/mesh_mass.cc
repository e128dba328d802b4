// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/mesh_mass.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "mechanism_codesign/source_text.h"
#include "reading/urdf/pictures.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;
using Triangles = std::vector<Triangle>;

constexpr std::size_t kHeader = 80, kCount = 4, kPerTriangle = 50;

template <class T>
T number_at(const std::string& bytes, std::size_t place) {
  T number;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

/// STL of bytes: a header, the number of triangles, of each a normal and three points.
std::optional<Triangles> read_bytes(const std::string& bytes) {
  if (bytes.size() < kHeader + kCount) return {};
  const auto count = number_at<std::uint32_t>(bytes, kHeader);
  if (bytes.size() != kHeader + kCount + std::size_t{count} * kPerTriangle) return {};
  Triangles triangles(count);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t point = 0; point < 3; ++point)
      for (std::size_t axis = 0; axis < 3; ++axis)
        triangles[k][point][static_cast<Eigen::Index>(axis)] = static_cast<double>(number_at<float>(
            bytes, kHeader + kCount + k * kPerTriangle + 12 * (point + 1) + 4 * axis));
  return triangles;
}

/// STL of words: `vertex X Y Z` three times for each triangle.
std::optional<Triangles> read_words(const std::string& text) {
  const std::vector<std::string> words = split_words(text);
  if (words.empty() || words[0] != "solid") return {};
  Triangles triangles;
  std::size_t points = 0;
  for (std::size_t k = 0; k + 3 < words.size(); ++k) {
    if (words[k] != "vertex") continue;
    if (points % 3 == 0) triangles.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::optional<double> number = parse_number(words[k + 1 + axis]);
      if (!number) return {};
      triangles.back()[points % 3][static_cast<Eigen::Index>(axis)] = *number;
    }
    ++points;
  }
  if (points == 0 || points % 3 != 0) return {};
  return triangles;
}

std::optional<Triangles> read_stl(const std::string& path) {
  try {
    const std::string bytes = read_source(path).text;
    const std::optional<Triangles> triangles = read_bytes(bytes);
    return triangles ? triangles : read_words(bytes);
  } catch (const InputError&) {
    return {};
  }
}

/// Moments of volume about the origin.
struct Moments {
  double volume = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

/// Of the inside of a surface, whatever the sense of its triangles; nothing if it is not closed.
std::optional<Moments> moments_of(const Triangles& triangles) {
  constexpr double kClosed = 1e-3;  // of the whole area
  Moments moments;
  Eigen::Vector3d directed = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d sum = a + b + c, normal = (b - a).cross(c - a);
    const double d = a.dot(b.cross(c));
    directed += normal;
    area += normal.norm();
    moments.volume += d / 6.0;
    moments.first += d / 24.0 * sum;
    moments.second +=
        d / 120.0 *
        (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (!(directed.norm() <= kClosed * area)) return {};
  const double sign = moments.volume < 0.0 ? -1.0 : 1.0;
  return Moments{sign * moments.volume, sign * moments.first, sign * moments.second};
}

/// The triangles of a `<visual>` or `<collision>` in the link frame.
std::optional<Triangles> triangles_of(const XmlElement& shape, const std::string& folder) {
  const tinyxml2::XMLElement* const geometry = shape.node()->FirstChildElement("geometry");
  const tinyxml2::XMLElement* const mesh =
      geometry != nullptr ? geometry->FirstChildElement("mesh") : nullptr;
  const char* const name = mesh != nullptr ? mesh->Attribute("filename") : nullptr;
  if (name == nullptr) return {};
  const bool has_scheme = std::strstr(name, "://") != nullptr;
  const std::filesystem::path path =
      has_scheme ? MeshFinder().path_of(name) : std::filesystem::path(folder) / name;
  if (path.empty()) return {};
  std::optional<Triangles> triangles = read_stl(path.string());
  if (!triangles) return {};
  const Eigen::Isometry3d pose = plain_origin(shape.node());
  const Eigen::Vector3d scale =
      mesh->Attribute("scale") != nullptr ? plain_vector(mesh, "scale") : Eigen::Vector3d::Ones();
  for (Triangle& triangle : *triangles)
    for (Eigen::Vector3d& point : triangle) point = pose * scale.cwiseProduct(point);
  return triangles;
}

}  // namespace

std::optional<MassProperties<double>> mass_of_meshes(const XmlElement& link, const std::string& tag,
                                                     const std::string& folder, double density) {
  Moments all;
  for (const XmlElement& shape : link.children(tag)) {
    const std::optional<Triangles> triangles = triangles_of(shape, folder);
    const std::optional<Moments> moments = triangles ? moments_of(*triangles) : std::nullopt;
    if (!moments) return {};
    all.volume += moments->volume;
    all.first += moments->first;
    all.second += moments->second;
  }
  if (!(all.volume > 0.0) || !std::isfinite(all.volume)) return {};
  MassProperties<double> properties;
  properties.mass = density * all.volume;
  properties.centre = all.first / all.volume;
  const Eigen::Matrix3d about_centre =
      all.second - all.volume * properties.centre * properties.centre.transpose();
  properties.inertia =
      density * (about_centre.trace() * Eigen::Matrix3d::Identity() - about_centre);
  return properties;
}

}  // namespace codesign
