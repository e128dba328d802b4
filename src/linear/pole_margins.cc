// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/pole_margins.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "linear/frequency_search.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Kind = LinearMeasure::Kind;

constexpr double kOutside = 1e-6;  // beyond the unit circle, more than rounding
constexpr double kMostGain = 1e9;  // a larger factor counts as none
constexpr int kOverflow = -1;

/// What a factor is of: the logarithm of a gain, or a lag in rad.
enum class Along { kGain, kLag };

Complex factor_at(Along along, double place) {
  return along == Along::kLag ? std::polar(1.0, -place) : Complex(std::exp(place));
}

struct Crossing {
  double place, frequency;
};

class CrossingSearch {
 public:
  CrossingSearch(const FactoredLoop& loop, LoopMargins* margins)
      : loop_(loop), margins_(margins), is_stable_(margins->is_stable) {}

  void find_gains();
  void find_lags();

 private:
  int unstable_with(Complex factor) const;
  std::optional<Crossing> through_infinity(double last) const;
  Crossing crossing_between(Along along, double low, double high) const;
  std::vector<Crossing> crossings(Along along, double last, int steps) const;

  const FactoredLoop& loop_;
  LoopMargins* margins_;
  const bool is_stable_;
};

/// @returns a number of poles; kOverflow: some grow beyond all numbers.
int CrossingSearch::unstable_with(Complex factor) const {
  const MatrixXcd map = loop_.closed_by(factor);
  if (!map.allFinite()) return kOverflow;
  const Eigen::VectorXcd values = complex_eigenvalues(map);
  return static_cast<int>((values.array().abs() > 1.0 + kOutside).count());
}

/// Halves the interval in which the number of poles outside changes, then goes to |z| = 1 by
/// Newton's method for the pole that moves.
Crossing CrossingSearch::crossing_between(Along along, double low, double high) const {
  constexpr int kHalvings = 40, kCorrections = 6;
  constexpr double kBeside = 1e-4;
  const int before = unstable_with(factor_at(along, low));
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (unstable_with(factor_at(along, middle)) == before ? low : high) = middle;
  }
  Crossing found{0.5 * (low + high), 0.0};
  for (int k = 0; k < kCorrections; ++k) {
    const Complex factor = factor_at(along, found.place);
    const Complex turn = along == Along::kLag ? Complex(0.0, -1.0) * factor : factor;
    const MatrixXcd map = loop_.closed_by(factor), by_place = turn * loop_.by_factor(factor);
    if (!map.allFinite() || !by_place.allFinite()) break;
    double fastest = 0.0, step = 0.0;
    for (const EigenTriple& pole : complex_eigen(map)) {
      const double beside = std::log(std::abs(pole.value));
      if (!(std::abs(beside) < kBeside)) continue;
      const Complex moves = product(pole.left.transpose(), product(by_place, pole.right))(0, 0);
      const double speed = (moves / pole.value).real();
      if (!(std::abs(speed) > fastest)) continue;
      fastest = std::abs(speed);
      step = -beside / speed;
      found.frequency = loop_.frequency_of(factor, pole);
    }
    if (!(std::abs(step) < 0.1)) break;
    found.place += step;
    if (std::abs(step) < 1e-15) break;
  }
  return found;
}

/// The gain on the way to the last one at which a pole passes through infinity.
std::optional<Crossing> CrossingSearch::through_infinity(double last) const {
  const AtFrequency L = loop_.at_infinity();
  if (!(L.value < 0.0)) return {};
  const double place = std::log(-1.0 / L.value);
  if (!(place / last > 0.0 && place / last < 1.0)) return {};
  return Crossing{place, L.frequency};
}

std::vector<Crossing> CrossingSearch::crossings(Along along, double last, int steps) const {
  constexpr double kBeside = 1e-5;  // of infinity, where poles are too large for numbers
  std::vector<Crossing> found;
  double place = 0.0;
  int count = unstable_with(factor_at(along, place));
  // Of gains the first one counts, of an unstable loop the one that leaves nothing outside.
  const auto is_last = [&](int there) {
    return along == Along::kGain && (is_stable_ || there == 0);
  };
  const auto ends_at = [&](double next) {
    const int before = count;
    count = unstable_with(factor_at(along, next));
    // What overflows is unstable, by an unknown number of poles.
    const bool is_crossing =
        count != before && (std::min(count, before) >= 0 || std::max(count, before) == 0);
    if (is_crossing) found.push_back(crossing_between(along, place, next));
    place = next;
    return is_crossing && is_last(count);
  };
  const auto is_between = [&place](double at, double next) {
    return std::abs(at) > std::abs(place) && std::abs(at) <= std::abs(next);
  };
  const auto infinite = along == Along::kGain ? through_infinity(last) : std::nullopt;
  for (int k = 1; k <= steps; ++k) {
    const double next = last * k / steps;
    if (infinite && is_between(infinite->place, next)) {
      if (ends_at(infinite->place * (1.0 - kBeside))) break;
      found.push_back(*infinite);
      place = infinite->place * (1.0 + kBeside);
      count = unstable_with(factor_at(along, place));
      if (is_last(count)) break;
    }
    if (std::abs(next) > std::abs(place) && ends_at(next)) break;
  }
  return found;
}

void CrossingSearch::find_gains() {
  constexpr int kSteps = 700;  // 3 % each
  const double most = std::log(kMostGain);
  const auto take = [&](double last, std::vector<AtFrequency>* all) {
    for (const Crossing& crossing : crossings(Along::kGain, last, kSteps))
      all->push_back({std::exp(crossing.place), std::abs(crossing.frequency)});
  };
  if (is_stable_) take(most, &margins_->all.gains);
  take(-most, &margins_->all.reductions);
  margins_->gain_margin = sort_margins(&margins_->all.gains, std::less<>());
  // Of a loop that is unstable the last one leads to gains at which it is stable.
  margins_->gain_reduction = sort_margins(&margins_->all.reductions, std::less<>());
  if (is_stable_ || !margins_->gain_reduction) return;
  constexpr double kBelow = 0.999;
  if (unstable_with(kBelow * margins_->gain_reduction->value) != 0) {
    margins_->all.reductions.clear();
    margins_->gain_reduction.reset();
  } else {
    margins_->all.reductions = {*margins_->gain_reduction};
  }
}

// A lag of a positive frequency is a lead of the negative one.
void CrossingSearch::find_lags() {
  constexpr int kSteps = 720;  // a quarter of a degree each
  for (const Crossing& crossing : crossings(Along::kLag, kHalfTurn, kSteps)) {
    const double frequency = std::abs(crossing.frequency);
    margins_->all.phases.push_back({crossing.place, frequency});
    const double lag =
        crossing.frequency >= 0.0 ? crossing.place : 2.0 * kHalfTurn - crossing.place;
    if (frequency > 0.0) margins_->all.delays.push_back({lag / frequency, frequency});
  }
  if (const AtFrequency L = loop_.at_infinity(); std::abs(L.value) > 1.0)
    margins_->all.delays.push_back({0.0, L.frequency});
  margins_->phase_margin = sort_margins(&margins_->all.phases, std::less<>());
  margins_->delay_margin = sort_margins(&margins_->all.delays, std::less<>());
}

/// A pole on the unit circle, and the relative change of z along the direction and by the factor.
struct OnCircle {
  Complex factor;
  double apart = 0.0;  ///< of the pole from where it is to be
  Complex change, by_factor;
};

/// The change of a lag [rad], and of the frequency at which it is.
struct LagChange {
  double lag = 0.0, frequency = 0.0;
};

class CrossingDerivative {
 public:
  CrossingDerivative(const FactoredLoop& loop, const MovedBy& moved_by, double period)
      : loop_(loop), moved_by_(moved_by), period_(period) {}

  double of_gain(const AtFrequency& margin) const {
    const OnCircle at = on_circle(margin.value, margin.frequency);
    return -at.change.real() / at.by_factor.real();
  }
  double of_phase(const AtFrequency& margin) const {
    const OnCircle lag = on_circle(std::polar(1.0, -margin.value), margin.frequency),
                   lead = on_circle(std::polar(1.0, margin.value), margin.frequency);
    return lag.apart <= lead.apart ? change_of(lag).lag : -change_of(lead).lag;
  }
  double of_delay(const AtFrequency& margin) const {
    const double w = margin.frequency;
    const LagChange change = change_of(on_circle(std::polar(1.0, -margin.value * w), w));
    return (change.lag - margin.value * change.frequency) / w;
  }

 private:
  OnCircle on_circle(Complex factor, double frequency) const {
    const Complex z = std::polar(1.0, frequency * period_);
    const std::vector<EigenTriple> poles = complex_eigen(loop_.closed_by(factor));
    const auto nearest = std::min_element(
        poles.begin(), poles.end(), [&z](const EigenTriple& one, const EigenTriple& other) {
          return std::abs(one.value - z) < std::abs(other.value - z);
        });
    const auto moved = [&](const MatrixXcd& by) {
      return product(nearest->left.transpose(), product(by, nearest->right))(0, 0) / nearest->value;
    };
    return {factor, std::abs(nearest->value - z), moved(moved_by_(factor)),
            moved(loop_.by_factor(factor))};
  }
  LagChange change_of(const OnCircle& at) const {
    const Complex by_lag = Complex(0.0, -1.0) * at.factor * at.by_factor;
    const double lag = -at.change.real() / by_lag.real();
    return {lag, (at.change + by_lag * lag).imag() / period_};
  }

  const FactoredLoop& loop_;
  const MovedBy& moved_by_;
  const double period_;
};

}  // namespace

void find_pole_margins(const FactoredLoop& loop, LoopMargins* margins) {
  CrossingSearch search(loop, margins);
  search.find_gains();
  if (margins->is_stable) search.find_lags();
}

double pole_margin_derivative(const FactoredLoop& loop, const MovedBy& moved_by, double period,
                              const AtFrequency& margin, Kind kind) {
  const CrossingDerivative derivative(loop, moved_by, period);
  switch (kind) {
    case Kind::kPhaseMargin:
      return derivative.of_phase(margin);
    case Kind::kDelayMargin:
      return derivative.of_delay(margin);
    default:
      return derivative.of_gain(margin);
  }
}

}  // namespace codesign
