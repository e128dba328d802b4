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

constexpr double kOutside = 1e-6;  // beyond the unit circle, more than rounding
constexpr double kMostGain = 1e9;  // a larger factor counts as none

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

namespace {

Complex factor_at(bool is_lag, double place) {
  return is_lag ? std::polar(1.0, -place) : Complex(std::exp(place));
}

}  // namespace

int PeriodicLoop::unstable_with(Complex factor) const {
  const MatrixXcd map = open_.closed_by(factor);
  if (!map.allFinite()) return -1;
  const Eigen::VectorXcd values = complex_eigenvalues(map);
  return static_cast<int>((values.array().abs() > 1.0 + kOutside).count());
}

/// Halves the interval in which the number of poles outside changes, then goes to |z| = 1 by
/// Newton's method for the pole that moves.
PeriodicLoop::Crossing PeriodicLoop::crossing_between(Along along, double low, double high) const {
  constexpr int kHalvings = 40, kCorrections = 6;
  constexpr double kBeside = 1e-4;
  const bool is_lag = along == Along::kLag;
  const int before = unstable_with(factor_at(is_lag, low));
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (unstable_with(factor_at(is_lag, middle)) == before ? low : high) = middle;
  }
  Crossing found{0.5 * (low + high), 0.0};
  for (int k = 0; k < kCorrections; ++k) {
    const Complex factor = factor_at(is_lag, found.place);
    const Complex turn = is_lag ? Complex(0.0, -1.0) * factor : factor;
    const MatrixXcd by_place = turn * open_.by_factor(factor);
    double fastest = 0.0, step = 0.0;
    for (const EigenTriple& pole : complex_eigen(open_.closed_by(factor))) {
      const double beside = std::log(std::abs(pole.value));
      if (!(std::abs(beside) < kBeside)) continue;
      const Complex moves = product(pole.left.transpose(), product(by_place, pole.right))(0, 0);
      const double speed = (moves / pole.value).real();
      if (!(std::abs(speed) > fastest)) continue;
      fastest = std::abs(speed);
      step = -beside / speed;
      found.frequency = main_frequency(product(open_.outputs(factor), pole.right).col(0),
                                       std::arg(pole.value), period_);
    }
    if (!(std::abs(step) < 0.1)) break;
    found.place += step;
    if (std::abs(step) < 1e-15) break;
  }
  return found;
}

std::vector<PeriodicLoop::Crossing> PeriodicLoop::crossings(Along along, double first, double last,
                                                            int steps) const {
  const bool is_lag = along == Along::kLag;
  std::vector<Crossing> found;
  double place = first;
  int count = unstable_with(factor_at(is_lag, first));
  for (int k = 1; k <= steps; ++k) {
    const double next = first + (last - first) * k / steps;
    const int there = unstable_with(factor_at(is_lag, next));
    if (there < 0) break;
    if (there != count) {
      found.push_back(crossing_between(along, place, next));
      // Of gains the first one counts, of an unstable loop the one that leaves nothing outside.
      if (!is_lag && (is_stable_ || there == 0)) break;
    }
    place = next;
    count = there;
  }
  return found;
}

void PeriodicLoop::find_gains(LoopMargins* margins) const {
  constexpr int kSteps = 700;  // 3 % each
  const double most = std::log(kMostGain);
  const auto take = [&](double last, std::vector<AtFrequency>* all) {
    for (const Crossing& crossing : crossings(Along::kGain, 0.0, last, kSteps))
      all->push_back({std::exp(crossing.place), std::abs(crossing.frequency)});
  };
  if (is_stable_) take(most, &margins->all.gains);
  take(-most, &margins->all.reductions);
  margins->gain_margin = sort_margins(&margins->all.gains, std::less<>());
  // Of a loop that is unstable the last one leads to gains at which it is stable.
  margins->gain_reduction = sort_margins(&margins->all.reductions, std::less<>());
  if (is_stable_ || !margins->gain_reduction) return;
  constexpr double kBelow = 0.999;
  if (unstable_with(kBelow * margins->gain_reduction->value) != 0) {
    margins->all.reductions.clear();
    margins->gain_reduction.reset();
  } else {
    margins->all.reductions = {*margins->gain_reduction};
  }
}

// A lag of a positive frequency is a lead of the negative one.
void PeriodicLoop::find_lags(LoopMargins* margins) const {
  constexpr int kSteps = 720;  // a quarter of a degree each
  for (const Crossing& crossing : crossings(Along::kLag, 0.0, kHalfTurn, kSteps)) {
    const double frequency = std::abs(crossing.frequency);
    margins->all.phases.push_back({crossing.place, frequency});
    const double lag =
        crossing.frequency >= 0.0 ? crossing.place : 2.0 * kHalfTurn - crossing.place;
    if (frequency > 0.0) margins->all.delays.push_back({lag / frequency, frequency});
  }
  margins->phase_margin = sort_margins(&margins->all.phases, std::less<>());
  margins->delay_margin = sort_margins(&margins->all.delays, std::less<>());
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
  margins->sensitivity = sort_margins(&margins->all.sensitivities, std::greater<>());
  margins->complementary = sort_margins(&margins->all.complementaries, std::greater<>());
  const auto complementary = [&](double w) { return std::abs(closed_at(w)); };
  margins->rest = rest_of(complementary, grid_);
  margins->bandwidth = bandwidth_of(complementary, grid_, margins->rest);
}

LoopMargins PeriodicLoop::margins() const {
  LoopMargins margins;
  margins.is_stable = is_stable_;
  find_gains(&margins);
  if (!is_stable_) return margins;
  find_lags(&margins);
  find_peaks(&margins);
  return margins;
}

}  // namespace codesign
