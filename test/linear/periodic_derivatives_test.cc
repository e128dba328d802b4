// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/periodic_derivatives.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linear/measure_derivatives.h"
#include "linear/periodic_loop.h"
#include "math/differences.h"

namespace codesign {
namespace {

constexpr double kPeriod = 0.3;

/// A stable loop of three samples, and a direction of its matrices.
StateSpace loop_at(double step) {
  StateSpace loop;
  loop.period = kPeriod;
  const auto filled = [step](Eigen::Index rows, Eigen::Index columns, double seed, double size) {
    Eigen::MatrixXd matrix(rows, columns);
    for (Eigen::Index row = 0; row < rows; ++row)
      for (Eigen::Index column = 0; column < columns; ++column) {
        const double place =
            seed + 1.7 * static_cast<double>(row) + 2.9 * static_cast<double>(column);
        matrix(row, column) = size * (std::sin(place * place) + step * std::cos(3.0 * place));
      }
    return matrix;
  };
  loop.A = filled(4, 4, 0.3, 0.35);
  loop.B = filled(4, 3, 1.1, 0.5);
  loop.C = filled(3, 4, 2.3, 0.5);
  loop.D = filled(3, 3, 0.9, 0.4);
  for (Eigen::Index row = 0; row < 3; ++row) loop.D.row(row).tail(3 - row).setZero();
  return loop;
}

TEST(PeriodicDerivatives, OfAllMargins) {
  const LoopMargins margins = PeriodicLoop(loop_at(0.0)).margins();
  ASSERT_TRUE(margins.is_stable);
  const StateSpace at = loop_at(0.0), beside = loop_at(1.0);
  const auto stepped = [](const Eigen::MatrixXd& value, const Eigen::MatrixXd& moved) {
    Eigen::MatrixXcd result = value.cast<std::complex<double>>();
    result.imag() = LinearDerivatives::kStep * (moved - value);
    return result;
  };
  const ComplexSpace closed{stepped(at.A, beside.A), stepped(at.B, beside.B),
                            stepped(at.C, beside.C), stepped(at.D, beside.D)};
  int compared = 0;
  for (const auto kind :
       {LinearMeasure::Kind::kGainMargin, LinearMeasure::Kind::kPhaseMargin,
        LinearMeasure::Kind::kDelayMargin, LinearMeasure::Kind::kBandwidth,
        LinearMeasure::Kind::kSensitivity, LinearMeasure::Kind::kComplementarySensitivity}) {
    const std::vector<AtFrequency> all = margins_of(margins, kind);
    if (all.empty()) continue;
    ++compared;
    const RiddersDerivative reference = ridders_derivative(
        [kind](double step) {
          return margins_of(PeriodicLoop(loop_at(step)).margins(), kind).front().value;
        },
        0.0, 2e-3);
    EXPECT_NEAR(periodic_derivative_of(all.front(), kind, margins.rest, closed, kPeriod),
                reference.value, 1e-7 * (1.0 + std::abs(reference.value)) + 10.0 * reference.error)
        << static_cast<int>(kind);
    EXPECT_LT(reference.error, 1e-6 * (1.0 + std::abs(reference.value)));
  }
  EXPECT_GE(compared, 4);
}

}  // namespace
}  // namespace codesign
