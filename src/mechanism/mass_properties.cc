// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/mass_properties.h"

#include <cmath>

namespace codesign {
namespace {

constexpr double kFlat = 1e-12;  // a smaller share of the extent along one direction is rounding

}  // namespace

std::optional<std::array<double, 10>> log_cholesky(const MassProperties<double>& properties) {
  if (!(properties.mass > 0.0)) return std::nullopt;
  // Second moments about the centre per mass, S = (tr J / 2 - J) / m = L L^T with L upper
  // triangular, from the last row up.
  const Matrix3<double> S =
      (0.5 * properties.inertia.trace() * Matrix3<double>::Identity() - properties.inertia) /
      properties.mass;
  const double least = kFlat * S.trace();
  if (!(S(2, 2) > least)) return std::nullopt;
  const double l3 = std::sqrt(S(2, 2)), s13 = S(0, 2) / l3, s23 = S(1, 2) / l3,
               second = S(1, 1) - s23 * s23;
  if (!(second > least)) return std::nullopt;
  const double l2 = std::sqrt(second), s12 = (S(0, 1) - s13 * s23) / l2,
               first = S(0, 0) - s12 * s12 - s13 * s13;
  if (!(first > least)) return std::nullopt;
  const Vector3<double>& t = properties.centre;
  return std::array<double, 10>{0.5 * std::log(properties.mass),
                                0.5 * std::log(first),
                                std::log(l2),
                                std::log(l3),
                                s12,
                                s23,
                                s13,
                                t[0],
                                t[1],
                                t[2]};
}

MassProperties<double> properties_of(const std::array<double, 10>& numbers) {
  const auto& [alpha, d1, d2, d3, s12, s23, s13, t1, t2, t3] = numbers;
  Matrix3<double> L;
  L << std::exp(d1), s12, s13, 0.0, std::exp(d2), s23, 0.0, 0.0, std::exp(d3);
  const Matrix3<double> S = L * L.transpose();
  MassProperties<double> result;
  result.mass = std::exp(2.0 * alpha);
  result.centre = {t1, t2, t3};
  result.inertia = result.mass * (S.trace() * Matrix3<double>::Identity() - S);
  return result;
}

}  // namespace codesign
