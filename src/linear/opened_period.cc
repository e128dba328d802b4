// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/opened_period.h"

#include <cmath>

#include "linear/frequency_search.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;

/// (I - k D)^-1 b: D is strictly lower triangular.
MatrixXcd solved(const Eigen::MatrixXd& D, Complex factor, const MatrixXcd& b) {
  MatrixXcd x = b;
  for (Eigen::Index row = 1; row < D.rows(); ++row)
    for (Eigen::Index column = 0; column < row; ++column)
      if (D(row, column) != 0.0) x.row(row) += (factor * D(row, column)) * x.row(column);
  return x;
}

}  // namespace

OpenedPeriod::OpenedPeriod(const StateSpace& closed)
    : OpenedPeriod(closed.A, closed.B, closed.C, closed.D, closed.period) {}

// With w = u - y the closed loop from w to y becomes the open one from u to y.
OpenedPeriod::OpenedPeriod(const Eigen::MatrixXd& closed_A, const Eigen::MatrixXd& closed_B,
                           const Eigen::MatrixXd& closed_C, const Eigen::MatrixXd& closed_D,
                           double time)
    : period(time) {
  const MatrixXcd unit = MatrixXcd::Identity(closed_D.rows(), closed_D.rows());
  const MatrixXcd per = complex_solution(unit + closed_D.cast<Complex>(), unit);
  const Eigen::MatrixXd E = per.real();
  C = E * closed_C;
  D = E * closed_D;
  A = closed_A - closed_B * C;
  B = closed_B * E;
}

MatrixXcd OpenedPeriod::outputs(Complex factor) const {
  return solved(D, factor, C.cast<Complex>());
}

MatrixXcd OpenedPeriod::closed_by(Complex factor) const {
  return A.cast<Complex>() + factor * product(B.cast<Complex>(), outputs(factor));
}

// With F = (I - k D)^-1: d(k F)/dk = F F.
MatrixXcd OpenedPeriod::by_factor(Complex factor) const {
  return product(B.cast<Complex>(), solved(D, factor, outputs(factor)));
}

double OpenedPeriod::frequency_of(Complex factor, const EigenTriple& pole) const {
  return main_frequency(product(outputs(factor), pole.right).col(0), std::arg(pole.value), period);
}

Eigen::VectorXcd sinusoid(double frequency, Eigen::Index samples, double period) {
  Eigen::VectorXcd values(samples);
  for (Eigen::Index k = 0; k < samples; ++k)
    values[k] =
        std::polar(1.0, frequency * period * static_cast<double>(k) / static_cast<double>(samples));
  return values;
}

Complex part_at(const Eigen::VectorXcd& sinusoid, const Eigen::VectorXcd& values) {
  return sinusoid.dot(values) / static_cast<double>(values.size());
}

double main_frequency(const Eigen::VectorXcd& samples, double angle, double period) {
  const Eigen::Index count = samples.size();
  double main = angle / period, largest = -1.0;
  for (Eigen::Index m = -count / 2; m <= count / 2; ++m) {
    const double frequency = (angle + 2.0 * kHalfTurn * static_cast<double>(m)) / period;
    if (std::abs(frequency) * period > kHalfTurn * static_cast<double>(count) * (1.0 + 1e-9))
      continue;
    const double part = std::abs(part_at(sinusoid(frequency, count, period), samples));
    if (part <= largest * (1.0 + 1e-9)) continue;
    largest = part;
    main = frequency;
  }
  return main;
}

}  // namespace codesign
