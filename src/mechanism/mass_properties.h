// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "description/robot.h"
#include "math/mesh_moments.h"
#include "math/scalar.h"

namespace codesign {

/// Mass [kg], centre of mass [m, link frame] and inertia [kg m^2, about the centre, in the link's
/// axes].
template <class T>
struct MassProperties {
  T mass{};
  Vector3<T> centre = Vector3<T>::Zero();
  Matrix3<T> inertia = Matrix3<T>::Zero();
};

/// R = R_z(yaw) R_y(pitch) R_x(roll), URDF's fixed-axis angles [rad].
template <class T>
Matrix3<T> rotation_from_rpy(const Vector3<T>& rpy) {
  using std::cos;
  using std::sin;
  const T cr = cos(rpy[0]), sr = sin(rpy[0]), cp = cos(rpy[1]), sp = sin(rpy[1]), cy = cos(rpy[2]),
          sy = sin(rpy[2]);
  Matrix3<T> R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return R;
}

namespace internal {

/// The three components at `parameters`.
template <class T>
Vector3<T> values_at(const QuantityVector& vector, const std::vector<T>& parameters) {
  return {vector[0].at(parameters), vector[1].at(parameters), vector[2].at(parameters)};
}

/// R J R^T. Transposed without conjugation, also for complex numbers.
template <class T>
Matrix3<T> turned(const Matrix3<T>& R, const Matrix3<T>& J) {
  return R * J * R.transpose();
}

/// m (d.d I - d d^T), the parallel-axis term.
template <class T>
Matrix3<T> point_inertia(const T& mass, const Vector3<T>& d) {
  const T square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  return mass * (square * Matrix3<T>::Identity() - d * d.transpose());
}

/// The solid of a mesh about its centre of mass, which is not the origin of its axes.
template <class T>
MassProperties<T> mesh_solid(const MeshMoments& mesh, const T& density, const Vector3<T>& scale) {
  MassProperties<T> result;
  T volume = scale[0] * scale[1] * scale[2];
  if (is_less(volume, T(0.0), false)) volume = -volume;  // it is mirrored
  result.mass = density * volume * mesh.volume;
  const Vector3<double> mean = mesh.first / mesh.volume;
  Matrix3<T> S;  // second moments about the centre
  for (int i = 0; i < 3; ++i) {
    result.centre[i] = scale[i] * mean[i];
    for (int k = 0; k < 3; ++k)
      S(i, k) = density * volume * scale[i] * scale[k] *
                (mesh.second(i, k) - mesh.volume * mean[i] * mean[k]);
  }
  const T trace = S(0, 0) + S(1, 1) + S(2, 2);
  result.inertia = trace * Matrix3<T>::Identity() - S;
  return result;
}

/// A homogeneous solid about its own centre, in its own axes.
template <class T>
MassProperties<T> solid(const ShapeDescription& shape, const T& density,
                        const std::vector<T>& parameters) {
  const Vector3<T> size = values_at(shape.size, parameters);
  MassProperties<T> result;
  Vector3<T> J = Vector3<T>::Zero();
  switch (shape.kind) {
    case ShapeDescription::Kind::kBox: {
      result.mass = density * size[0] * size[1] * size[2];
      const Vector3<T> square = size.cwiseProduct(size);
      J = Vector3<T>(square[1] + square[2], square[2] + square[0], square[0] + square[1]) *
          (result.mass / 12.0);
      break;
    }
    case ShapeDescription::Kind::kCylinder: {
      const T r2 = size[0] * size[0];
      result.mass = density * M_PI * r2 * size[1];
      const T across = result.mass * (3.0 * r2 + size[1] * size[1]) / 12.0;
      J = Vector3<T>(across, across, result.mass * r2 / 2.0);
      break;
    }
    case ShapeDescription::Kind::kSphere: {
      const T r2 = size[0] * size[0];
      result.mass = density * (4.0 / 3.0 * M_PI) * r2 * size[0];
      J.setConstant(0.4 * result.mass * r2);
      break;
    }
    case ShapeDescription::Kind::kMesh:
      return mesh_solid(*shape.mesh, density, size);
  }
  result.inertia = J.asDiagonal();
  return result;
}

/// The sum of the solids, in the link's frame. Without mass, centre and inertia are zero. @param
/// workspace overwritten.
template <class T>
MassProperties<T> from_shapes(const InertialDescription& inertial, const std::vector<T>& parameters,
                              std::vector<MassProperties<T>>* workspace) {
  const T density = inertial.density->at(parameters);
  std::vector<MassProperties<T>>& parts = *workspace;
  parts.clear();
  MassProperties<T> total;
  for (const ShapeDescription& shape : inertial.shapes) {
    MassProperties<T> part = solid(shape, density, parameters);
    const Matrix3<T> R = rotation_from_rpy<T>(values_at(shape.origin.rpy, parameters));
    const Vector3<T> own = part.centre;
    part.centre = values_at(shape.origin.xyz, parameters);
    if (shape.kind == ShapeDescription::Kind::kMesh) part.centre += R * own;
    part.inertia = turned(R, part.inertia);
    total.mass += part.mass;
    total.centre += part.mass * part.centre;
    parts.push_back(part);
  }
  if (!is_less(T(0.0), T(total.mass * total.mass), true)) return total;
  total.centre /= total.mass;
  for (const MassProperties<T>& part : parts) {
    const Vector3<T> d = part.centre - total.centre;
    total.inertia += part.inertia + point_inertia(part.mass, d);
  }
  return total;
}

}  // namespace internal

/// Mass properties of a link at `parameters`: the numbers given or, with a density, computed from
/// its boxes, cylinders, spheres and meshes by the parallel-axis theorem; overlapping solids count
/// twice.
/// @param workspace overwritten.
template <class T>
MassProperties<T> mass_properties(const InertialDescription& inertial,
                                  const std::vector<T>& parameters,
                                  std::vector<MassProperties<T>>* workspace) {
  if (inertial.density) return internal::from_shapes(inertial, parameters, workspace);
  MassProperties<T> result;
  result.mass = inertial.mass.at(parameters);
  result.centre = internal::values_at(inertial.origin.xyz, parameters);
  const auto J = [&](std::size_t k) { return inertial.inertia[k].at(parameters); };
  Matrix3<T> given;
  given << J(0), J(1), J(2),  //
      J(1), J(3), J(4),       //
      J(2), J(4), J(5);
  result.inertia = internal::turned(
      rotation_from_rpy<T>(internal::values_at(inertial.origin.rpy, parameters)), given);
  return result;
}
template <class T>
MassProperties<T> mass_properties(const InertialDescription& inertial,
                                  const std::vector<T>& parameters) {
  std::vector<MassProperties<T>> workspace;
  return mass_properties(inertial, parameters, &workspace);
}

/// The names of the ten numbers below, which follow the name of the link: LINK_alpha and so on.
inline constexpr std::array<const char*, 10> kLogCholeskyNames{"alpha", "d1",  "d2", "d3", "s12",
                                                               "s23",   "s13", "t1", "t2", "t3"};
/// Their units: alpha is half the logarithm of the mass in kg, d the logarithm of a length in m.
inline constexpr std::array<const char*, 10> kLogCholeskyUnits{"",  "",  "",  "",  "m",
                                                               "m", "m", "m", "m", "m"};

/// The ten numbers of mass, centre and inertia by the logarithmic Cholesky factor of the
/// pseudo-inertia (Rucker and Wensing [18]), theory (28e): for all values of the ten numbers there
/// is a distribution of positive mass with these properties, and every such distribution has ten
/// numbers.
/// @param properties in the link's axes.
/// @returns in the order of kLogCholeskyNames; std::nullopt if mass or extent along some direction
/// is not positive, as for points, rods and plates, or if a principal moment is not below the sum
/// of the others.
std::optional<std::array<double, 10>> log_cholesky(const MassProperties<double>& properties);
/// The mass properties for any ten numbers; the inverse of log_cholesky().
MassProperties<double> properties_of(const std::array<double, 10>& numbers);

}  // namespace codesign
