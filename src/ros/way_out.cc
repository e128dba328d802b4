// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/way_out.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace codesign {
namespace {

using Interval = std::pair<double, double>;

/// The part of the ray from + s * along that lies in the box, s >= 0; empty (first > second) if none does.
Interval inside(const Eigen::Vector3d& from, const Eigen::Vector3d& along, const Eigen::Vector3d& half) {
  Interval part{0.0, std::numeric_limits<double>::infinity()};
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (std::abs(along[k]) < 1e-12) {
      if (std::abs(from[k]) > half[k]) return {1.0, 0.0};
      continue;
    }
    const double one = (-half[k] - from[k]) / along[k], other = (half[k] - from[k]) / along[k];
    part.first = std::max(part.first, std::min(one, other));
    part.second = std::min(part.second, std::max(one, other));
  }
  return part;
}

}  // namespace

double way_out(const Eigen::Vector3d& from, const Eigen::Vector3d& along, const Frame& frame, const LinkBoxes& boxes, double clearance) {
  std::vector<Interval> parts;
  for (std::size_t k = 0; k < boxes.size() && k < frame.links.size(); ++k) {
    const Eigen::Quaterniond to_link = frame.links[k].orientation.conjugate();
    for (const SolidBox& box : boxes[k]) {
      const Eigen::Vector3d in_link = to_link * (from - frame.links[k].position);
      const Interval part = inside(box.pose.inverse() * in_link, box.pose.linear().transpose() * (to_link * along), box.half);
      if (part.first <= part.second) parts.push_back(part);
    }
  }
  std::sort(parts.begin(), parts.end());
  double reached = 0.0;
  for (const Interval& part : parts)
    if (part.first <= reached + clearance) reached = std::max(reached, part.second);
  return reached;
}

}  // namespace codesign
