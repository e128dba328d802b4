// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "forces/law.h"
#include "math/scalar.h"

namespace codesign {

/// The numbers of a shape [m]; those that it does not have are zero.
template <class T>
struct ShapeNumbers {
  T radius{0.0}, length{0.0};
  Vector3<T> size = Vector3<T>::Zero();  ///< whole edges
};

/// Where a point lies beside a surface, in the frame of its shape.
template <class T>
struct SurfaceDistance {
  T distance{0.0};                         ///< [m], negative in the body
  Vector3<T> normal = Vector3<T>::Zero();  ///< outward, its gradient [-]
};

/// @param at the point, in the frame of the shape [m].
template <class T>
using SurfaceFunction = SurfaceDistance<T> (*)(const Vector3<T>& at, const ShapeNumbers<T>& c);
/// The k-th of the points by which a shape touches, in its frame [m]. @param towards a direction
/// against the normal of the other surface, in the frame of the shape [-].
template <class T>
using TouchingPoint = Vector3<T> (*)(int k, const Vector3<T>& towards, const ShapeNumbers<T>& c);
/// Its curvature [1/m], for Hertz's stiffness: negative where it is hollow.
template <class T>
using CurvatureFunction = T (*)(const ShapeNumbers<T>& c);

/// A shape that may touch, one row of the table in contact_shape.cc; theory (13k). One shape of a
/// contact touches with its points, the other with its surface: every row has a surface, or points,
/// or both.
struct ContactShape {
  const char* name = "";  ///< the value of `shape`
  Law<TouchingPoint> point{};
  Law<SurfaceFunction> surface{};
  Law<CurvatureFunction> curvature{};
  int points = 0;  ///< how many; 0: it touches with its surface only
  bool has_radius = false, has_length = false, has_size = false;
  bool ball = false;   ///< its points are centres of balls of its radius, else corners
  bool turns = false;  ///< its points depend on the direction, so that the surface must be a plane
  /// flat or hollow, so that a body between points that do not touch does not either
  bool holds_points = false;
  bool flat = false;  ///< its normal is the same everywhere

  /// Whether points of another shape may touch its surface.
  bool takes(const ContactShape& other) const {
    if (!surface || other.points == 0) return false;
    if (other.turns) return flat;
    return holds_points || (other.ball && other.points == 1);
  }
};

class ShapeKind : public RowReference<ContactShape> {
 public:
  using RowReference::RowReference;
  static const ShapeKind kSphere, kSocket, kBore, kBox, kSlot;
};

/// The library's shapes.
std::vector<ShapeKind> contact_shapes();

/// The smallest of its extents [m], by which a penetration is judged; infinity for a plane.
double extent_of(const ContactShape& shape, const ShapeNumbers<double>& numbers);

}  // namespace codesign
