// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace codesign {

/// The direction of rviz's Orbit view: z is up, `yaw` turns about it from x, `pitch` rises above
/// the plane of x and y [rad].
struct SceneView {
  double yaw = 5.2, pitch = 0.45;

  /// Unit vectors: to the viewer, to the right of the picture, and up in it.
  Eigen::Vector3d towards_viewer() const;
  Eigen::Vector3d right() const;
  Eigen::Vector3d up() const { return towards_viewer().cross(right()); }

  /// The rectangle around the picture of points, seen from far: to the right and up [m].
  Eigen::AlignedBox2d picture(const std::vector<Eigen::Vector3d>& points) const;
};

/// A view on the broad side of a mechanism, a little from above: a mechanism that is flat along x
/// is seen from x, a mechanism that lies flat from high above.
/// @param sizes of the box around it [m].
SceneView view_of(const Eigen::Vector3d& sizes);

/// The place of the camera.
struct CameraPlace {
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();  ///< the middle of the picture [m]
  double distance = 1.0;                            ///< distance of the camera from the focus [m]
};

/// Aspect ratio of the picture, at least: the shipped configurations of rviz have a slightly wider
/// picture.
constexpr double kAspect = 1.24;  ///< width over height
/// Half of the picture's height at a distance of one: rviz's picture is 45 degrees high.
constexpr double kHalfHeight = 0.41421356237309503;
/// The largest distance of points from the middle of the picture, as a share of the distance to the
/// edge.
constexpr double kFilled = 0.92;

/// The nearest place from which all points lie within `kFilled` of the picture. @param points at
/// least one.
/// @param top likewise for points in the upper half; the room above is for a text.
CameraPlace place_camera(const std::vector<Eigen::Vector3d>& points, const SceneView& view,
                         double top = kFilled);

/// The eight corners of a box, none for an empty one.
std::vector<Eigen::Vector3d> corners(const Eigen::AlignedBox3d& box);

/// The largest of 1, 2 and 5 times a power of ten that is not larger than `length` > 0.
double round_down(double length);

}  // namespace codesign
