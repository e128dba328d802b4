// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/hinge_angles.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "joints/coordinate.h"

namespace codesign {
namespace {

using HingeKind = CoordinateConstants<double>::Kind;

/// Three hinges with z2 along y, z1 along z, and z3 at `gamma` about z2 from z1.
ThreeHinges<double> hinges_at(double gamma, std::optional<double> start) {
  const Eigen::Matrix3d zero =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  return {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY(),
          Eigen::AngleAxisd(gamma, Eigen::Vector3d::UnitY()) * Eigen::Vector3d::UnitZ(), start,
          zero};
}

/// The angle of a hinge where the joints have the angles a, b, c, as the bodies show it.
double read_angle(const ThreeHinges<double>& hinges, std::size_t hinge, double a, double b,
                  double c) {
  BodyKinematics<double> i, j;
  i.A = Eigen::AngleAxisd(-1.1, Eigen::Vector3d(0.3, 0.4, 1.0).normalized()).toRotationMatrix();
  j.A = i.A * Eigen::AngleAxisd(a, hinges.z1).toRotationMatrix() *
        Eigen::AngleAxisd(b, hinges.z2).toRotationMatrix() *
        Eigen::AngleAxisd(c, hinges.z3).toRotationMatrix() * hinges.R_ji.transpose();
  return coordinate_position(PairConstants<double>(), hinges.angle(hinge), i, j);
}

double turned_back(double angle) { return std::remainder(angle, 2.0 * M_PI); }

TEST(HingeAngles, EachHingeReadsItsOwnAngle) {
  for (const double gamma : {0.0, M_PI, -M_PI, 0.3, -2.0, M_PI_2, -M_PI_2, 1e-3})
    for (const double start : {0.5, -0.5, 2.4, -2.4, 4.0, -9.0})
      for (const double beside : {0.0, 0.3, -0.2}) {
        const ThreeHinges<double> hinges = hinges_at(gamma, start);
        const double b = start + beside;
        // On the other side of the singular posture, where both axes coincide, the angles are those
        // of the other triple; right angles keep their own side, that of zero position.
        const double side = std::sin(start + gamma), here = std::sin(b + gamma);
        const bool right_angled = std::abs(std::cos(gamma)) < 1e-9;
        if (side * here <= 0.0 || (right_angled && std::cos(b) <= 0.0)) continue;
        EXPECT_NEAR(turned_back(read_angle(hinges, 0, 0.7, b, -1.9) - 0.7), 0.0, 1e-12)
            << gamma << " " << b;
        EXPECT_NEAR(turned_back(read_angle(hinges, 1, 0.7, b, -1.9) - b), 0.0, 1e-7)
            << gamma << " " << b;
        EXPECT_NEAR(turned_back(read_angle(hinges, 2, 0.7, b, -1.9) + 1.9), 0.0, 1e-12)
            << gamma << " " << b;
      }
}

TEST(HingeAngles, WithoutAStartTheSideIsThatOfZeroPosition) {
  for (const double gamma : {0.3, -0.3, 2.0})
    for (std::size_t hinge : {0U, 1U, 2U}) {
      const double expected[] = {0.2, 0.1, -0.4};
      EXPECT_NEAR(read_angle(hinges_at(gamma, std::nullopt), hinge, 0.2, 0.1, -0.4),
                  expected[hinge], 1e-7);
    }
}

TEST(HingeAngles, ParallelAxesNeedAStartToOneSide) {
  for (const double gamma : {0.0, M_PI})
    for (const std::optional<double>& start :
         {std::optional<double>(), std::optional<double>(0.0), std::optional<double>(M_PI)})
      EXPECT_EQ(hinges_at(gamma, start).angle(1).kind, HingeKind::kNone);
  EXPECT_EQ(hinges_at(0.0, 0.5).angle(0).kind, HingeKind::kAngle);
  EXPECT_EQ(hinges_at(0.0, 0.5).angle(1).kind, HingeKind::kSine);
}

TEST(HingeAngles, HingesAtOtherAnglesToTheNextHaveNone) {
  ThreeHinges<double> skew = hinges_at(M_PI_2, 0.5);
  skew.z2 = Eigen::Vector3d(0.6, 0.8, 0.0);
  for (std::size_t hinge : {0U, 1U, 2U}) EXPECT_EQ(skew.angle(hinge).kind, HingeKind::kNone);
}

}  // namespace
}  // namespace codesign
