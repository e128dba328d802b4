// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/period_map.h"

#include <gtest/gtest.h>

#include <complex>

#include "statics/linear_cases.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

constexpr double kCartTime = 0.1, kCartGain = 3.0;  // [s], [N s/m]

/// A cart of 1 kg whose speed a sampled controller holds: x = (y, y', held) and, with a delay of a
/// sample, the output that waits.
struct SampledCart {
  explicit SampledCart(bool is_late)
      : problem(loaded(carts(1, {""}),
                       controlled(cart_servo(std::string("gains: {p: 3}, sample_time: 0.1") +
                                                 (is_late ? ", delay: 0.1" : ""),
                                             "0", "velocity")))),
        pattern(sample_pattern(study_of(problem))),
        size(is_late ? 4 : 3) {}

  template <class T>
  PeriodMap<T> map(T gain, int opened) const {
    using Matrix = typename PeriodMap<T>::Matrix;
    Matrix A = Matrix::Zero(size, size);
    A(0, 1) = A(1, 2) = 1.0;
    return {A,
            Matrix(size, 0),
            *system_of(problem),
            2,
            pattern,
            opened,
            [this, gain](const std::vector<ControlEvent>& events) {
              Matrix s = Matrix::Zero(size - 2, size);
              s.rightCols(size - 2).setIdentity();
              const Eigen::Index written = size - 3;
              for (const ControlEvent& event : events) {
                if (event.kind == ControlEvent::Kind::kApply) {
                  s.row(0) = s.row(written).eval();
                  continue;
                }
                s.row(written).setZero();
                s(written, 1) = -gain;
              }
              return s;
            }};
  }

  Problem problem;
  SamplePattern pattern;
  Eigen::Index size;
};

// y'+ = (1 - k T) y', y+ = y + (T - k T^2/2) y'; of the opened loop w moves what the output moves.
TEST(PeriodMap, OfAHeldOutput) {
  const SampledCart cart(false);
  const PeriodMap<double> map = cart.map(kCartGain, 0);
  Eigen::Matrix3d expected;
  expected << 1.0, kCartTime - 0.5 * kCartGain * kCartTime * kCartTime, 0.0, 0.0,
      1.0 - kCartGain * kCartTime, 0.0, 0.0, -kCartGain, 0.0;
  EXPECT_LT((map.by_states() - expected).norm(), 1e-14);
  EXPECT_LT((map.by_opened() - Eigen::Vector3d(0.5 * kCartTime * kCartTime, kCartTime, 1.0)).norm(),
            1e-14);
  EXPECT_LT((map.output() - Eigen::RowVector3d(0.0, -kCartGain, 0.0)).norm(), 1e-14);
  EXPECT_EQ(map.by_inputs().cols(), 0);
}

// Of a delay of a sample: what waits acts first, then the sample is taken.
TEST(PeriodMap, OfAQueue) {
  const SampledCart cart(true);
  const PeriodMap<double> map = cart.map(kCartGain, -1);
  Eigen::Matrix4d expected;
  expected << 1.0, kCartTime, 0.0, 0.5 * kCartTime * kCartTime, 0.0, 1.0, 0.0, kCartTime, 0.0, 0.0,
      0.0, 1.0, 0.0, -kCartGain, 0.0, 0.0;
  EXPECT_LT((map.by_states() - expected).norm(), 1e-14);
}

TEST(PeriodMap, CarriesDerivatives) {
  constexpr double kStep = 1e-30;
  const SampledCart cart(false);
  const Eigen::MatrixXd change = cart.map(Complex(kCartGain, kStep), -1).by_states().imag() / kStep;
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected.col(1) << -0.5 * kCartTime * kCartTime, -kCartTime, -1.0;
  EXPECT_LT((change - expected).norm(), 1e-14);
}

}  // namespace
}  // namespace codesign
