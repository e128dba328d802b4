// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/trajectory_basis.h"

#include <cmath>

namespace codesign {
namespace {

/// A function with its first two derivatives.
struct Shape {
  double value, rate, acceleration;
};

/// The cubic B-spline with knots 0, 1, ..., 4, whose value is 2/3 in the middle.
Shape cubic_spline(double u) {
  if (u <= 0.0 || u >= 4.0) return {0.0, 0.0, 0.0};
  if (u > 2.0) {
    const Shape mirrored = cubic_spline(4.0 - u);
    return {mirrored.value, -mirrored.rate, mirrored.acceleration};
  }
  if (u <= 1.0) return {u * u * u / 6.0, 0.5 * u * u, u};
  const double s = u - 1.0;
  return {(1.0 + 3.0 * s + 3.0 * s * s - 3.0 * s * s * s) / 6.0,
          0.5 * (1.0 + 2.0 * s - 3.0 * s * s), 1.0 - 3.0 * s};
}

}  // namespace

TrajectoryBasis::TrajectoryBasis(const ExcitationDescription& description)
    : kind_(description.trajectory),
      period_(description.period),
      waves_(kind_ == TrajectoryKind::kFourier ? description.harmonics : description.knots),
      size_(kind_ == TrajectoryKind::kFourier ? 2 * (waves_ - 1) : waves_ - 3) {}

double TrajectoryBasis::shortest_wave() const {
  return (kind_ == TrajectoryKind::kFourier ? 1.0 : 4.0) * period_ / waves_;
}

TrajectoryBasis::Shapes TrajectoryBasis::at(double time) const {
  Shapes shapes;
  for (Eigen::VectorXd* part : {&shapes.value, &shapes.rate, &shapes.acceleration})
    part->setZero(size_);
  const double begun = time - period_ * std::floor(time / period_);
  if (kind_ == TrajectoryKind::kFourier)
    add_fourier(begun, &shapes);
  else
    add_spline(begun, &shapes);
  return shapes;
}

// Each shape combines neighbouring harmonics: the velocities of two sines, and the accelerations of
// two cosines, cancel at time 0.
void TrajectoryBasis::add_fourier(double time, Shapes* shapes) const {
  const double omega = 2.0 * M_PI / period_;
  const auto add = [&](int harmonic, double sign) {
    const double l = harmonic, s = std::sin(l * omega * time), c = std::cos(l * omega * time);
    const Eigen::Index sine = 2 * (sign > 0.0 ? harmonic - 1 : harmonic - 2), cosine = sine + 1;
    shapes->value[sine] += sign * s / l;
    shapes->rate[sine] += sign * omega * c;
    shapes->acceleration[sine] -= sign * omega * omega * l * s;
    shapes->value[cosine] += sign * (c - 1.0) / (l * l);
    shapes->rate[cosine] -= sign * omega * s / l;
    shapes->acceleration[cosine] -= sign * omega * omega * c;
  };
  for (int l = 1; l < waves_; ++l) {
    add(l, 1.0);
    add(l + 1, -1.0);
  }
}

// The B-splines that lie within the period: at the ends of its support a cubic B-spline and its
// first two derivatives are zero.
void TrajectoryBasis::add_spline(double time, Shapes* shapes) const {
  const double step = period_ / waves_;
  for (Eigen::Index k = 0; k < size_; ++k) {
    const Shape shape = cubic_spline(time / step - static_cast<double>(k));
    shapes->value[k] = shape.value;
    shapes->rate[k] = shape.rate / step;
    shapes->acceleration[k] = shape.acceleration / (step * step);
  }
}

Eigen::VectorXd TrajectoryBasis::plain(int k) const {
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(size_);
  if (kind_ == TrajectoryKind::kFourier) {
    coefficients[2 * (k % (waves_ - 1)) + 1] = 1.0;
    return coefficients;
  }
  const auto swings = static_cast<double>(1 + k % 4);
  for (Eigen::Index i = 0; i < size_; ++i)
    coefficients[i] =
        std::sin(M_PI * swings * static_cast<double>(i + 1) / static_cast<double>(size_ + 1));
  return coefficients;
}

}  // namespace codesign
