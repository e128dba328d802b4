// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/scene_view.h"

#include <algorithm>
#include <cmath>

namespace codesign {

Eigen::Vector3d SceneView::towards_viewer() const {
  return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
}

Eigen::Vector3d SceneView::right() const { return {-std::sin(yaw), std::cos(yaw), 0.0}; }

Eigen::AlignedBox2d SceneView::picture(const std::vector<Eigen::Vector3d>& points) const {
  Eigen::AlignedBox2d rectangle;
  for (const Eigen::Vector3d& point : points)
    rectangle.extend(Eigen::Vector2d(point.dot(right()), point.dot(up())));
  return rectangle;
}

SceneView view_of(const Eigen::Vector3d& sizes) {
  SceneView view;
  constexpr double kFlat = 0.4;
  if (sizes.x() < kFlat * sizes.y() && sizes.x() <= sizes.z()) view.yaw = 0.55;
  if (sizes.z() < kFlat * std::min(sizes.x(), sizes.y())) view.pitch = 0.8;
  return view;
}

CameraPlace place_camera(const std::vector<Eigen::Vector3d>& points, const SceneView& view,
                         double top) {
  const Eigen::Vector3d toward = view.towards_viewer(), right = view.right(), up = view.up();
  const double half_width = kFilled * kAspect * kHalfHeight, above = top * kHalfHeight,
               below = kFilled * kHalfHeight;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) box.extend(point);
  CameraPlace place{box.center(), 0.0};
  constexpr int kRounds = 25;
  // Points nearer to the camera take more room in the picture: the camera moves until both sides
  // have the same distance from the edge.
  for (int round = 0; round <= kRounds; ++round) {
    place.distance = 1e-3;
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d from = point - place.focus;
      const double height = from.dot(up);
      const double needed = std::max(std::abs(from.dot(right)) / half_width,
                                     height > 0.0 ? height / above : -height / below);
      place.distance = std::max(place.distance, from.dot(toward) + needed);
    }
    if (round == kRounds) break;
    Eigen::AlignedBox2d picture;
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d from = point - place.focus;
      const double away = std::max(place.distance - from.dot(toward), 1e-9);
      picture.extend(Eigen::Vector2d(from.dot(right) / away, from.dot(up) / away));
    }
    place.focus += place.distance * (picture.center().x() * right +
                                     (picture.center().y() - 0.5 * (above - below)) * up);
  }
  return place;
}

std::vector<Eigen::Vector3d> corners(const Eigen::AlignedBox3d& box) {
  std::vector<Eigen::Vector3d> points;
  if (box.isEmpty()) return points;
  for (int k = 0; k < 8; ++k)
    points.emplace_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)));
  return points;
}

double round_down(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= length) return digit * power;
  return power;
}

}  // namespace codesign
