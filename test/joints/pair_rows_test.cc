// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "joints/pair_constants.h"
#include "joints/pair_rows.h"
#include "joints/two_bodies.h"
#include "math/differences.h"

namespace codesign {
namespace {

using C = std::complex<double>;

template <class T>
PairVector<T> direction() {
  return PairVector<T>::direction(Side::kI, Vector3<T>(T(0.6), T(0.0), T(0.8)));
}
template <class T>
PairVector<T> displacement() {
  return PairVector<T>::displacement(Vector3<T>(T(0.1), T(-0.2), T(0.3)),
                                     Vector3<T>(T(-0.3), T(0.1), T(0.2)));
}

/// phi, phi', phi'' of direction . displacement.
template <class T>
VectorX<T> motion(const VectorX<T>& q, const VectorX<T>& v, const VectorX<T>& a) {
  const auto i = local_body(q, v, a, 0), j = local_body(q, v, a, kBodySize);
  const ProductMotion<T> m =
      product_motion(motion_of(direction<T>(), i, j), motion_of(displacement<T>(), i, j));
  VectorX<T> all(3);
  all << m.phi, m.phid, m.phidd;
  return all;
}

class ScalarProduct : public ::testing::Test {
 protected:
  const Eigen::VectorXd q = generic_local(0.2), v = generic_local(1.3), a = generic_local(2.1);
  const BodyKinematics<double> i = local_body<double>(q, v, a, 0),
                               j = local_body<double>(q, v, a, kBodySize);
  const PairVector<double> X = direction<double>(), Y = displacement<double>();
  const VectorMotion<double> x = motion_of(X, i, j), y = motion_of(Y, i, j);
};

TEST_F(ScalarProduct, RatesAreTimeDerivatives) {
  constexpr double h = 1e-30;
  const Eigen::VectorXcd along = motion<C>(q.cast<C>() + C(0, h) * v.cast<C>(),
                                           v.cast<C>() + C(0, h) * a.cast<C>(), a.cast<C>());
  const Eigen::VectorXd m = motion<double>(q, v, a);
  EXPECT_NEAR(along[0].imag() / h, m[1], 1e-13);
  EXPECT_NEAR(along[1].imag() / h, m[2], 1e-13);
}

TEST_F(ScalarProduct, TheGradientIsExact) {
  const auto by_q = [&](const Eigen::VectorXcd& z) {
    return Eigen::VectorXcd(motion<C>(z, v.cast<C>(), a.cast<C>()).head(1));
  };
  EXPECT_LT(compare_jacobians(product_gradient(X, Y, x, y, i, j).transpose(),
                              complex_step_jacobian(by_q, q))
                .largest,
            1e-13);
}

TEST_F(ScalarProduct, LoadIsTheGradientTransposed) {
  BodyLoad<double> on_i, on_j;
  add_product_load(X, Y, x, y, 1.7, &on_i, &on_j);
  LocalRow<double> load;
  load << on_i.force, rotation_hessian(on_i.W) * i.p, on_j.force, rotation_hessian(on_j.W) * j.p;
  EXPECT_LT((load - 1.7 * product_gradient(X, Y, x, y, i, j)).norm(), 1e-13);
}

int rows_of(PairKind kind) { return pair_rows<double>(kind, PairConstants<double>()).size(); }

TEST(PairRows, EveryKindLeavesItsFreedoms) {
  EXPECT_EQ(rows_of(PairKind::kFixed), 6);
  EXPECT_EQ(rows_of(PairKind::kRevolute), 5);
  EXPECT_EQ(rows_of(PairKind::kPrismatic), 5);
  EXPECT_EQ(rows_of(PairKind::kCylindrical), 4);
  EXPECT_EQ(rows_of(PairKind::kUniversal), 4);
  EXPECT_EQ(rows_of(PairKind::kTable), 4);
  EXPECT_EQ(rows_of(PairKind::kSpherical), 3);
  EXPECT_EQ(rows_of(PairKind::kPlanar), 3);
  EXPECT_EQ(rows_of(PairKind::kTranslational), 3);
  EXPECT_EQ(rows_of(PairKind::kDistance), 1);
  EXPECT_EQ(rows_of(PairKind::kFree), 0);
}

TEST(PairRows, OnlyPointsOfDisplacementsAndAxesInUseAreMarked) {
  using Rows = PairRows<double>;
  const Rows hinge = pair_rows<double>(PairKind::kRevolute, PairConstants<double>());
  EXPECT_TRUE(hinge.coincident);
  const auto used = [&hinge](Side side, int k) {
    return hinge.used[static_cast<std::size_t>(Rows::shared(side, k))];
  };
  EXPECT_TRUE(used(Side::kI, 0));
  EXPECT_TRUE(used(Side::kI, 1));
  EXPECT_TRUE(used(Side::kJ, 2));
  EXPECT_FALSE(used(Side::kI, Rows::kPoint));
  EXPECT_FALSE(used(Side::kJ, 0));
}

TEST(PairRows, ADistanceIsHalfASquare) {
  PairConstants<double> c;
  c.distance = 0.3;
  const auto rows = pair_rows<double>(PairKind::kDistance, c);
  EXPECT_DOUBLE_EQ(rows.products.front().offset, 0.09);
  EXPECT_DOUBLE_EQ(rows.products.front().scale, 0.5);
}

TEST(LocalRow, CoordinatesStandBodyByBody) {
  EXPECT_EQ(r_offset(Side::kI), 0);
  EXPECT_EQ(p_offset(Side::kI), 3);
  EXPECT_EQ(r_offset(Side::kJ), 7);
  EXPECT_EQ(p_offset(Side::kJ), 10);
  EXPECT_EQ(p_offset(Side::kJ) + 4, kLocalSize);
}

TEST(PairVector, ADirectionHasOneTermAndADisplacementTwo) {
  const auto direction = PairVector<double>::direction(Side::kJ, {1.0, 2.0, 3.0});
  ASSERT_EQ(direction.terms, 1);
  EXPECT_FALSE(direction.term[0].point);
  EXPECT_EQ(direction.term[0].side, Side::kJ);
  const auto d = PairVector<double>::displacement({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  ASSERT_EQ(d.terms, 2);
  for (const auto& term : d.term) {
    EXPECT_TRUE(term.point);
    EXPECT_EQ(term.sign, term.side == Side::kJ ? 1.0 : -1.0) << "from i to j";
    EXPECT_EQ(term.s, (term.side == Side::kJ ? Vector3<double>(0.0, 1.0, 0.0)
                                             : Vector3<double>(1.0, 0.0, 0.0)));
  }
}

TEST(PairMotion, SharedVectorsMoveAsTheirOwn) {
  const Eigen::VectorXd q = generic_local(0.2), v = generic_local(1.3), a = generic_local(2.1);
  const auto i = local_body<double>(q, v, a, 0), j = local_body<double>(q, v, a, kBodySize);
  PairConstants<double> c;
  c.s_i = Vector3<double>(0.1, -0.2, 0.3);
  c.s_j = Vector3<double>(-0.3, 0.1, 0.2);
  const PairRows<double> rows = pair_rows(PairKind::kPrismatic, c);
  PairMotion<double> shared;
  shared.update(rows, i, j);
  for (const ProductRow<double>& row : rows.products) {
    for (const PairVector<double>* x : {&row.X, &row.Y}) {
      const VectorMotion<double> one = shared.of(*x), other = motion_of(*x, i, j);
      EXPECT_LT(
          (one.x - other.x).norm() + (one.xd - other.xd).norm() + (one.xdd - other.xdd).norm(),
          1e-14);
    }
  }
}

TEST(PairMotion, VectorsOnTheGroundRest) {
  const Eigen::VectorXd q = generic_local(0.2), v = generic_local(1.3), a = generic_local(2.1);
  const auto j = local_body<double>(q, v, a, kBodySize);
  const PairRows<double> rows = pair_rows(PairKind::kPlanar, PairConstants<double>());
  PairMotion<double> shared;
  BodyKinematics<double> ground;
  ground.at_rest = true;
  shared.update(rows, ground, j);
  const VectorMotion<double> z = shared.of(rows.products.front().X);
  EXPECT_EQ(z.x, Vector3<double>::UnitZ());
  EXPECT_EQ(z.xd, Vector3<double>::Zero());
  EXPECT_EQ(z.xdd, Vector3<double>::Zero());
}

}  // namespace

}  // namespace codesign
