// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/mesh_moments.h"

#include <Eigen/Geometry>
#include <map>
#include <utility>

namespace codesign {
namespace {

using Corner = std::array<float, 3>;
/// How often an edge of triangles goes from a corner to another, less how often it comes back.
using Edges = std::map<std::pair<Corner, Corner>, int>;

/// Files write the same corner of several triangles with the same digits.
Corner corner_at(const Eigen::Vector3d& x) {
  // -0 and 0 are one place.
  const auto round = [](double value) { return static_cast<float>(value) + 0.0F; };
  return {round(x[0]), round(x[1]), round(x[2])};
}

void add_edge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Edges* edges) {
  const Corner a = corner_at(from), b = corner_at(to);
  if (a < b)
    ++(*edges)[{a, b}];
  else if (b < a)
    --(*edges)[{b, a}];
}

Eigen::Vector3d place(const Corner& corner) {
  return {static_cast<double>(corner[0]), static_cast<double>(corner[1]),
          static_cast<double>(corner[2])};
}

/// The sum of the areas of the loops that the edges of one triangle alone form. They form loops,
/// since the edges of all triangles do: each corner is left as often as it is reached.
double area_of_holes(const Edges& edges) {
  std::multimap<Corner, Corner> open;
  for (const auto& [edge, count] : edges)
    for (int k = 0; k < std::abs(count); ++k)
      count > 0 ? open.emplace(edge.first, edge.second) : open.emplace(edge.second, edge.first);
  double area = 0.0;
  while (!open.empty()) {
    const Corner begin = open.begin()->first;
    const Eigen::Vector3d origin = place(begin);
    Eigen::Vector3d twice = Eigen::Vector3d::Zero();
    Corner at = begin;
    do {
      const auto next = open.find(at);
      if (next == open.end()) break;  // rounding of corners has opened the loop
      twice += (place(at) - origin).cross(place(next->second) - origin);
      at = next->second;
      open.erase(next);
    } while (at != begin);
    area += 0.5 * twice.norm();
  }
  return area;
}

}  // namespace

MeshMoments moments_of(const std::vector<Triangle>& triangles) {
  MeshMoments moments;
  Edges edges;
  double area = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double d = a.dot(b.cross(c));
    const Eigen::Vector3d s = a + b + c;
    moments.volume += d / 6.0;
    moments.first += d / 24.0 * s;
    moments.second +=
        d / 120.0 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    area += 0.5 * (b - a).cross(c - a).norm();
    add_edge(a, b, &edges);
    add_edge(b, c, &edges);
    add_edge(c, a, &edges);
  }
  if (moments.volume < 0.0) {
    moments.volume = -moments.volume;
    moments.first = -moments.first;
    moments.second = -moments.second;
  }
  moments.holes = area > 0.0 ? area_of_holes(edges) / area : 0.0;
  return moments;
}

}  // namespace codesign
