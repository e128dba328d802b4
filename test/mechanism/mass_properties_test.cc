// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

#include "mechanism/mass_properties.h"

namespace codesign {
namespace {

/// The k-th of two independent variables.
Lanes<4> lane(double value, int k) {
  Lanes<4> x(value);
  x.v[k] = 1.0;
  return x;
}

using Kind = ShapeDescription::Kind;

ShapeDescription shape(Kind kind, const std::array<Quantity, 3>& size,
                       const QuantityVector& xyz = {}, const QuantityVector& rpy = {}) {
  return {kind, {xyz, rpy}, size, {}};
}

MassProperties<double> of_shapes(double density, const std::vector<ShapeDescription>& shapes) {
  InertialDescription inertial;
  inertial.density = density;
  inertial.shapes = shapes;
  return mass_properties(inertial, std::vector<double>{});
}

void expect_diagonal(const MassProperties<double>& properties, double x, double y, double z) {
  const Matrix3<double> expected = Vector3<double>(x, y, z).asDiagonal();
  EXPECT_LT((properties.inertia - expected).norm(), 1e-12 * expected.norm()) << properties.inertia;
}

TEST(MassProperties, RollPitchYawAreFixedAxisAngles) {
  const Matrix3<double> R = rotation_from_rpy<double>({0.1, -0.4, 2.0});
  const Matrix3<double> expected = (Eigen::AngleAxisd(2.0, Vector3<double>::UnitZ()) *
                                    Eigen::AngleAxisd(-0.4, Vector3<double>::UnitY()) *
                                    Eigen::AngleAxisd(0.1, Vector3<double>::UnitX()))
                                       .toRotationMatrix();
  EXPECT_LT((R - expected).norm(), 1e-15);
}

TEST(MassProperties, SolidsAlone) {
  const MassProperties<double> box = of_shapes(10.0, {shape(Kind::kBox, {1.0, 2.0, 3.0})});
  EXPECT_DOUBLE_EQ(box.mass, 60.0);
  expect_diagonal(box, 65.0, 50.0, 25.0);
  const MassProperties<double> cylinder =
      of_shapes(1.0 / M_PI, {shape(Kind::kCylinder, {2.0, 3.0})});
  EXPECT_DOUBLE_EQ(cylinder.mass, 12.0);
  expect_diagonal(cylinder, 21.0, 21.0, 24.0);
  const MassProperties<double> sphere =
      of_shapes(3.0 / (4.0 * M_PI), {shape(Kind::kSphere, {2.0})});
  EXPECT_DOUBLE_EQ(sphere.mass, 8.0);
  expect_diagonal(sphere, 12.8, 12.8, 12.8);
}

TEST(MassProperties, TurnedAndShiftedSolid) {
  const auto turned = of_shapes(
      10.0, {shape(Kind::kBox, {1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, {0.0, 0.0, M_PI / 2.0})});
  EXPECT_LT((turned.centre - Vector3<double>(4.0, 5.0, 6.0)).norm(), 1e-14);
  expect_diagonal(turned, 50.0, 65.0, 25.0);
}

TEST(MassProperties, ParallelAxes) {
  // Two cubes side by side are one bar.
  const auto bar = of_shapes(1.0, {shape(Kind::kBox, {1.0, 1.0, 1.0}, {0.5, 0.0, 0.0}),
                                   shape(Kind::kBox, {1.0, 1.0, 1.0}, {1.5, 0.0, 0.0})});
  EXPECT_DOUBLE_EQ(bar.mass, 2.0);
  EXPECT_LT((bar.centre - Vector3<double>(1.0, 0.0, 0.0)).norm(), 1e-15);
  expect_diagonal(bar, 2.0 * 2.0 / 12.0, 2.0 * 5.0 / 12.0, 2.0 * 5.0 / 12.0);
}

TEST(MassProperties, NumbersTurnedIntoLinkAxes) {
  InertialDescription inertial;
  inertial.mass = 3.0;
  inertial.inertia = {1.0, 0.1, 0.2, 2.0, 0.3, 2.5};
  inertial.origin = {{0.1, 0.2, 0.3}, {0.0, 0.0, M_PI / 2.0}};
  const MassProperties<double> properties = mass_properties(inertial, std::vector<double>{});
  Matrix3<double> expected;
  expected << 2.0, -0.1, -0.3, -0.1, 1.0, 0.2, -0.3, 0.2, 2.5;
  EXPECT_LT((properties.inertia - expected).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(properties.centre[2], 0.3);
}

TEST(MassProperties, DerivativesAgreeWithTheComplexStep) {
  const std::vector<std::string> names = {"a", "b"};
  const auto quantity = [&](double nominal, const char* text) {
    return Quantity(nominal, std::make_shared<const Expression>(text, names));
  };
  InertialDescription inertial;
  inertial.density = quantity(0.3, "a");
  inertial.shapes = {shape(Kind::kBox, {quantity(0.3, "a"), quantity(0.5, "b"), 0.2},
                           {quantity(0.5, "b"), 0.1, 0.0}, {0.3, quantity(0.3, "a"), 0.2}),
                     shape(Kind::kCylinder, {quantity(0.25, "b/2"), quantity(0.6, "2*a")}),
                     shape(Kind::kSphere, {quantity(0.15, "a*b")}, {0.0, 0.0, quantity(0.3, "a")})};
  const MassProperties<Lanes<4>> lanes =
      mass_properties(inertial, std::vector<Lanes<4>>{lane(0.3, 0), lane(0.5, 1)});
  for (int k = 0; k < 2; ++k) {
    std::vector<std::complex<double>> at = {0.3, 0.5};
    at[static_cast<std::size_t>(k)] += std::complex<double>(0.0, 1e-30);
    const MassProperties<std::complex<double>> step = mass_properties(inertial, at);
    EXPECT_NEAR(lanes.mass.v[k], step.mass.imag() / 1e-30, 1e-15);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(lanes.centre[i].v[k], step.centre[i].imag() / 1e-30, 1e-14);
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(lanes.inertia(i, j).v[k], step.inertia(i, j).imag() / 1e-30, 1e-15);
    }
    EXPECT_GT(std::abs(lanes.inertia(0, 1).v[k]), 1e-6) << "the test must see a derivative";
  }
}

TEST(MassProperties, AMeshIsItsSolidInItsScale) {
  // A box of 2 x 1 x 1 about its centre.
  MeshMoments moments;
  moments.volume = 2.0;
  moments.second = Eigen::Vector3d(2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0).asDiagonal();
  ShapeDescription mesh = shape(Kind::kMesh, {0.1, 0.2, 0.3}, {1.0, 2.0, 3.0}, {0.1, 0.2, 0.3});
  mesh.mesh = std::make_shared<const MeshMoments>(moments);
  const MassProperties<double> found = of_shapes(700.0, {mesh}),
                               box = of_shapes(700.0, {shape(Kind::kBox, {0.2, 0.2, 0.3},
                                                             {1.0, 2.0, 3.0}, {0.1, 0.2, 0.3})});
  EXPECT_NEAR(found.mass, box.mass, 1e-12 * box.mass);
  EXPECT_LT((found.centre - box.centre).norm(), 1e-12);
  EXPECT_LT((found.inertia - box.inertia).norm(), 1e-12 * box.inertia.norm());
}

MassProperties<double> cuboid(double mass, const Vector3<double>& size,
                              const Vector3<double>& centre) {
  MassProperties<double> m;
  m.mass = mass;
  m.centre = centre;
  const Vector3<double> square = size.cwiseProduct(size);
  m.inertia = (mass / 12.0 *
               Vector3<double>(square[1] + square[2], square[2] + square[0], square[0] + square[1]))
                  .asDiagonal();
  return m;
}

TEST(LogCholesky, OfACuboidByHand) {
  const auto numbers = log_cholesky(cuboid(2.0, {0.3, 0.2, 0.1}, {0.5, -0.4, 0.3}));
  ASSERT_TRUE(numbers);
  const double expected[] = {0.5 * std::log(2.0),
                             std::log(0.3 / std::sqrt(12.0)),
                             std::log(0.2 / std::sqrt(12.0)),
                             std::log(0.1 / std::sqrt(12.0)),
                             0.0,
                             0.0,
                             0.0,
                             0.5,
                             -0.4,
                             0.3};
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_NEAR((*numbers)[k], expected[k], 1e-14) << kLogCholeskyNames[k];
}

TEST(LogCholesky, TheFactorGivesTheSecondMomentsBack) {
  MassProperties<double> m = cuboid(1.5, {0.3, 0.2, 0.1}, {0.0, 0.0, 0.0});
  m.inertia = internal::turned(rotation_from_rpy<double>({0.3, -0.5, 0.8}), m.inertia);
  const auto n = log_cholesky(m);
  ASSERT_TRUE(n);
  const MassProperties<double> back = properties_of(*n);
  EXPECT_NEAR(back.mass, m.mass, 1e-15);
  EXPECT_EQ(back.centre, m.centre);
  EXPECT_LT((back.inertia - m.inertia).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(LogCholesky, PointsRodsPlatesAndImpossibleMomentsHaveNone) {
  EXPECT_FALSE(log_cholesky(cuboid(0.0, {0.3, 0.2, 0.1}, {0.0, 0.0, 0.0})));
  EXPECT_FALSE(log_cholesky(cuboid(1.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0})));
  for (int k = 0; k < 3; ++k) {
    Vector3<double> flat(0.3, 0.2, 0.1);
    flat[k] = 0.0;
    EXPECT_FALSE(log_cholesky(cuboid(1.0, flat, {0.0, 0.0, 0.0}))) << k;
  }
  MassProperties<double> impossible = cuboid(1.0, {0.3, 0.2, 0.1}, {0.0, 0.0, 0.0});
  impossible.inertia(0, 0) = 1.0;
  EXPECT_FALSE(log_cholesky(impossible));
}

}  // namespace

}  // namespace codesign
