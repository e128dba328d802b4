// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/periodic_loop.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "linear/frequency_search.h"
#include "linear/poles.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;

MatrixXcd unit(Eigen::Index size) { return MatrixXcd::Identity(size, size); }

}  // namespace

PeriodicLoop::PeriodicLoop(const StateSpace& closed)
    : closed_(closed), open_(closed), samples_(closed.B.cols()), period_(closed.period) {
  const std::vector<Pole> poles = poles_of(closed);
  is_stable_ = std::none_of(poles.begin(), poles.end(),
                            [](const Pole& pole) { return pole.growth() > pole.uncertainty; });
  StateSpace open = closed;
  open.A = open_.A;
  const std::vector<Pole> opened = poles_of(open);
  grid_ = frequencies_about(poles, opened, period_ / static_cast<double>(samples_));
  of_period_ = frequencies_about(poles, opened, period_);
}

namespace {

/// A loop at one frequency: what becomes of values at the samples of a period.
class AtSamples {
 public:
  AtSamples(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C,
            const Eigen::MatrixXd& D, Complex z)
      : D_(D.cast<Complex>()) {
    const MatrixXcd M = z * unit(A.rows()) - A.cast<Complex>();
    in_ = complex_solution(M, B.cast<Complex>());
    out_ = C.cast<Complex>();
  }
  /// (H + direct) w, and its adjoint.
  MatrixXcd of(const MatrixXcd& w, double direct) const {
    return product(out_, product(in_, w)) + product(D_, w) + direct * w;
  }
  MatrixXcd adjoint_of(const MatrixXcd& y, double direct) const {
    return product(in_.adjoint(), product(out_.adjoint(), y)) + product(D_.adjoint(), y) +
           direct * y;
  }

 private:
  MatrixXcd in_, out_, D_;
};

}  // namespace

Complex PeriodicLoop::closed_at(double frequency) const {
  const Eigen::VectorXcd e = sinusoid(frequency, samples_, period_);
  const AtSamples H(closed_.A, closed_.B, closed_.C, closed_.D,
                    std::polar(1.0, frequency * period_));
  return part_at(e, H.of(e, 0.0));
}

Complex PeriodicLoop::at(double frequency) const {
  const Eigen::VectorXcd e = sinusoid(frequency, samples_, period_);
  const AtSamples L(open_.A, open_.B, open_.C, open_.D, std::polar(1.0, frequency * period_));
  return -part_at(e, L.of(e, 0.0));
}

/// The largest singular value of I + H, or H, by power iteration from that of the frequency before;
/// a part of all directions keeps it from one that has become the second one.
double PeriodicLoop::norm_at(double frequency, bool complementary, Eigen::VectorXcd* right) const {
  constexpr int kMostIterations = 60, kSettled = 3;
  constexpr double kPart = 1e-3, kChange = 1e-14;
  const AtSamples H(closed_.A, closed_.B, closed_.C, closed_.D,
                    std::polar(1.0, frequency * period_));
  const double direct = complementary ? 0.0 : 1.0;
  MatrixXcd v(samples_, 1);
  for (Eigen::Index k = 0; k < samples_; ++k) {
    const Complex other = std::polar(1.0, 1.0 + 2.3 * static_cast<double>(k * k % 17));
    v(k, 0) = right->size() == samples_ ? (*right)[k] + kPart * other : other;
  }
  double norm = 0.0;
  for (int k = 0, settled = 0; k < kMostIterations && settled < kSettled; ++k) {
    v /= v.norm();
    const MatrixXcd y = H.of(v, direct);
    const double next = y.norm();
    settled = std::abs(next - norm) <= kChange * next ? settled + 1 : 0;
    norm = next;
    if (!(norm > 0.0 && std::isfinite(norm))) break;
    *right = v.col(0);
    v = H.adjoint_of(y, direct);
  }
  return norm;
}

std::vector<AtFrequency> PeriodicLoop::peaks_of(bool complementary) const {
  Eigen::VectorXcd right;
  std::vector<AtFrequency> found =
      peaks(of_period_, [&](double w) { return norm_at(w, complementary, &right); });
  for (AtFrequency& peak : found) {
    norm_at(peak.frequency, complementary, &right);
    peak.frequency = std::abs(main_frequency(right, peak.frequency * period_, period_));
  }
  return found;
}

void PeriodicLoop::find_peaks(LoopMargins* margins) const {
  margins->all.sensitivities = peaks_of(false);
  margins->all.complementaries = peaks_of(true);
  take_largest_peaks(margins);
  set_bandwidth([&](double w) { return std::abs(closed_at(w)); }, grid_, margins);
}

LoopMargins PeriodicLoop::margins() const {
  LoopMargins margins;
  margins.is_stable = is_stable_;
  find_pole_margins(open_, &margins);
  if (is_stable_) find_peaks(&margins);
  return margins;
}

}  // namespace codesign
