// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/periodic_derivatives.h"

#include <cmath>
#include <vector>

#include "linear/opened_period.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Kind = LinearMeasure::Kind;

const Complex kImaginary(0.0, 1.0);

/// The closed loop from added outputs to outputs, and the opened one, with their derivatives.
class Period {
 public:
  Period(const ComplexSpace& closed, double period)
      : A_(closed.A.real()),
        B_(closed.B.real()),
        C_(closed.C.real()),
        D_(closed.D.real()),
        dA_(kPer * closed.A.imag()),
        dB_(kPer * closed.B.imag()),
        dC_(kPer * closed.C.imag()),
        dD_(kPer * closed.D.imag()),
        period_(period),
        open_(A_, B_, C_, D_, period) {
    const MatrixXd unit = MatrixXd::Identity(D_.rows(), D_.cols());
    const MatrixXd E = unit - open_.D, dE = -E * dD_ * E;
    open_dC_ = dE * C_ + E * dC_;
    open_dD_ = -dE;
    open_dB_ = dB_ * E + B_ * dE;
    open_dA_ = dA_ - dB_ * open_.C - B_ * open_dC_;
  }

  Eigen::Index samples() const { return B_.cols(); }
  double period() const { return period_; }
  const OpenedPeriod& open() const { return open_; }
  Complex turn(double frequency) const { return std::polar(1.0, frequency * period_); }

  /// How closed_by(factor) moves along the direction.
  MatrixXcd moved_by(Complex factor) const {
    const MatrixXcd per = MatrixXcd::Identity(D_.rows(), D_.cols()) - factor * open_.D;
    const MatrixXcd y = open_.outputs(factor);
    const MatrixXcd dy = complex_solution(
        per, open_dC_.cast<Complex>() + factor * product(open_dD_.cast<Complex>(), y));
    return open_dA_.cast<Complex>() +
           factor * (product(open_dB_.cast<Complex>(), y) + product(open_.B.cast<Complex>(), dy));
  }

  /// H at a frequency, how it moves along the direction, and by the frequency.
  struct Response {
    MatrixXcd value, change, slope;
  };
  Response response(double frequency) const {
    const Complex z = turn(frequency);
    const MatrixXcd M = z * MatrixXcd::Identity(A_.rows(), A_.cols()) - A_.cast<Complex>();
    const MatrixXcd x = complex_solution(M, B_.cast<Complex>());
    const MatrixXcd y = complex_solution(M.transpose(), C_.transpose().cast<Complex>()).transpose();
    return {product(C_.cast<Complex>(), x) + D_.cast<Complex>(),
            product(dC_.cast<Complex>(), x) +
                product(y, product(dA_.cast<Complex>(), x) + dB_.cast<Complex>()) +
                dD_.cast<Complex>(),
            -kImaginary * period_ * z * product(y, x)};
  }

 private:
  static constexpr double kPer = 1.0 / LinearDerivatives::kStep;
  MatrixXd A_, B_, C_, D_, dA_, dB_, dC_, dD_;
  double period_;
  OpenedPeriod open_;
  MatrixXd open_dA_, open_dB_, open_dC_, open_dD_;
};

double peak_derivative(const Period& loop, double frequency, bool complementary) {
  const Period::Response H = loop.response(frequency);
  MatrixXcd G = H.value;
  if (!complementary) G += MatrixXcd::Identity(G.rows(), G.cols());
  const LargestGain gain = largest_gain(G);
  return gain.left.dot(product(H.change, gain.right).col(0)).real();
}

/// The part of the response that has the frequency of the sinusoid, and its changes.
struct Part {
  Complex value, change, slope;
};
Part part_of(const Period& loop, double frequency) {
  const Eigen::Index samples = loop.samples();
  const double per = 1.0 / static_cast<double>(samples);
  const Period::Response H = loop.response(frequency);
  const Eigen::VectorXcd e = sinusoid(frequency, samples, loop.period());
  Eigen::VectorXcd turned = e;
  for (Eigen::Index k = 0; k < samples; ++k)
    turned[k] *= kImaginary * loop.period() * per * static_cast<double>(k);
  const auto form = [&](const Eigen::VectorXcd& a, const MatrixXcd& M, const Eigen::VectorXcd& b) {
    return part_at(a, product(M, b));
  };
  return {form(e, H.value, e), form(e, H.change, e),
          form(e, H.slope, e) + form(turned, H.value, e) + form(e, H.value, turned)};
}

// |T|^2 - |T(0)|^2/2 = 0.
double bandwidth_derivative(const Period& loop, double w, double rest) {
  const Part at = part_of(loop, w), still = part_of(loop, rest);
  const double change = (std::conj(at.value) * at.change).real() -
                        0.5 * (std::conj(still.value) * still.change).real();
  return -change / (std::conj(at.value) * at.slope).real();
}

}  // namespace

double periodic_derivative_of(const AtFrequency& margin, Kind kind, double rest,
                              const ComplexSpace& closed, double period) {
  const Period loop(closed, period);
  switch (kind) {
    case Kind::kBandwidth:
      return bandwidth_derivative(loop, margin.frequency, rest);
    case Kind::kSensitivity:
      return peak_derivative(loop, margin.frequency, false);
    case Kind::kComplementarySensitivity:
      return peak_derivative(loop, margin.frequency, true);
    default:
      return pole_margin_derivative(
          loop.open(), [&loop](Complex factor) { return loop.moved_by(factor); }, period, margin,
          kind);
  }
}

}  // namespace codesign
