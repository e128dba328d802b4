// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joints/scalar_product.h"

#include <gtest/gtest.h>

#include "joints/two_bodies.h"
#include "math/derivative_check.h"

namespace codesign {
namespace {

using C = std::complex<double>;

template <class T>
PairVector<T> direction() {
  return PairVector<T>::direction(Side::kI, Vector3<T>(T(0.6), T(0.0), T(0.8)));
}
template <class T>
PairVector<T> displacement() {
  return PairVector<T>::displacement(Vector3<T>(T(0.1), T(-0.2), T(0.3)), Vector3<T>(T(-0.3), T(0.1), T(0.2)));
}

/// phi, phi', phi'' of direction . displacement.
template <class T>
VectorX<T> motion(const VectorX<T>& q, const VectorX<T>& v, const VectorX<T>& a) {
  const auto i = local_body(q, v, a, 0), j = local_body(q, v, a, kBodySize);
  const ProductMotion<T> m = product_motion(motion_of(direction<T>(), i, j), motion_of(displacement<T>(), i, j));
  VectorX<T> all(3);
  all << m.phi, m.phid, m.phidd;
  return all;
}

class ScalarProduct : public ::testing::Test {
 protected:
  const Eigen::VectorXd q = generic_local(0.2), v = generic_local(1.3), a = generic_local(2.1);
  const BodyKinematics<double> i = local_body<double>(q, v, a, 0), j = local_body<double>(q, v, a, kBodySize);
  const PairVector<double> X = direction<double>(), Y = displacement<double>();
  const VectorMotion<double> x = motion_of(X, i, j), y = motion_of(Y, i, j);
};

TEST_F(ScalarProduct, RatesAreTimeDerivatives) {
  constexpr double h = 1e-30;
  const Eigen::VectorXcd along = motion<C>(q.cast<C>() + C(0, h) * v.cast<C>(), v.cast<C>() + C(0, h) * a.cast<C>(), a.cast<C>());
  const Eigen::VectorXd m = motion<double>(q, v, a);
  EXPECT_NEAR(along[0].imag() / h, m[1], 1e-13);
  EXPECT_NEAR(along[1].imag() / h, m[2], 1e-13);
}

TEST_F(ScalarProduct, TheGradientIsExact) {
  const auto by_q = [&](const Eigen::VectorXcd& z) { return Eigen::VectorXcd(motion<C>(z, v.cast<C>(), a.cast<C>()).head(1)); };
  EXPECT_LT(compare_jacobians(product_gradient(X, Y, x, y, i, j).transpose(), complex_step_jacobian(by_q, q)).largest, 1e-13);
}

TEST_F(ScalarProduct, LoadIsTheGradientTransposed) {
  BodyLoad<double> on_i, on_j;
  add_product_load(X, Y, x, y, 1.7, &on_i, &on_j);
  LocalRow<double> load;
  load << on_i.force, rotation_hessian(on_i.W) * i.p, on_j.force, rotation_hessian(on_j.W) * j.p;
  EXPECT_LT((load - 1.7 * product_gradient(X, Y, x, y, i, j)).norm(), 1e-13);
}

}  // namespace
}  // namespace codesign
