// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/loop_margins.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "linear/frequency_search.h"
#include "linear/poles.h"
#include "math/arrays.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

constexpr double kPole = 1e9;  // a value that rounding makes of infinity; of zero its inverse

/// Takes a crossing of the negative real axis, but not one through infinity, at a pole, or through
/// zero.
void take_gain(const Complex& L, double frequency, LoopMargins::All* all) {
  if (!(L.real() < -1.0 / kPole && L.real() > -kPole)) return;
  const double factor = -1.0 / L.real();
  (factor >= 1.0 ? all->gains : all->reductions).push_back({factor, frequency});
}

/// Takes a crossing of the unit circle.
void take_phase(const Complex& L, double frequency, LoopMargins::All* all) {
  const double beyond = std::arg(-L);  // from -1, in (-pi, pi]
  all->phases.push_back({std::abs(beyond), frequency});
  const double lag = beyond >= 0.0 ? beyond : beyond + 2.0 * kHalfTurn;
  all->delays.push_back({lag / frequency, frequency});
}

}  // namespace

struct OpenLoop::Functions {
  TransferFunction closed, open;
};

// With w = u - y the closed loop x' = A x + B w, y = C x + D w becomes the open one from u to y.
OpenLoop::OpenLoop(const StateSpace& closed) : period_(closed.period), open_(closed) {
  const double d = closed.D(0, 0), per = 1.0 / (1.0 + d);
  open_.A -= per * closed.B * closed.C;
  open_.B *= per;
  open_.C *= per;
  open_.D *= per;
  functions_ = std::make_unique<Functions>(
      Functions{TransferFunction(closed.A, closed.B, closed.C, d),
                TransferFunction(open_.A, open_.B, open_.C, open_.D(0, 0))});
  is_stable_ = is_stable_with(1.0);
  grid_ = frequencies_about(poles_of(closed), poles_of(open_), period_);
}

OpenLoop::~OpenLoop() = default;
OpenLoop::OpenLoop(OpenLoop&&) noexcept = default;

Complex OpenLoop::at(double frequency) const {
  if (period_ > 0.0) return -functions_->open.at(std::polar(1.0, frequency * period_));
  return -functions_->open.at(Complex(0.0, frequency));
}

// u = factor y in place of u = y.
bool OpenLoop::is_stable_with(double factor) const {
  StateSpace closed = open_;
  closed.A += factor / (1.0 - factor * open_.D(0, 0)) * open_.B * open_.C;
  const std::vector<Pole> poles = poles_of(closed);
  return std::none_of(poles.begin(), poles.end(),
                      [](const Pole& pole) { return pole.growth() > pole.uncertainty; });
}

Complex OpenLoop::closed_at(double frequency) const {
  if (period_ > 0.0) return functions_->closed.at(std::polar(1.0, frequency * period_));
  return functions_->closed.at(Complex(0.0, frequency));
}

// L is real at w = 0 and, sampled, at the end of the grid, pi/period: crossings, too. Near that end
// its imaginary part is rounding.
void OpenLoop::find_crossings(LoopMargins* margins) const {
  std::vector<Complex> L;
  L.reserve(grid_.size());
  for (const double w : grid_) L.push_back(at(w));
  take_gain(at(0.0).real(), 0.0, &margins->all);
  if (period_ > 0.0) take_gain(L.back().real(), grid_.back(), &margins->all);
  // At infinite frequency L is its direct part: at -1 a pole passes through infinity, and beyond a
  // magnitude of 1 any delay makes the loop unstable.
  const double far = period_ > 0.0 ? 0.0 : -open_.D(0, 0);
  take_gain(far, grid_.back(), &margins->all);
  if (std::abs(far) > 1.0) margins->all.delays.push_back({0.0, grid_.back()});
  for (std::size_t k = 0; k + 1 < grid_.size(); ++k) {
    const bool is_end = period_ > 0.0 && k + 2 == grid_.size();
    if (!is_end && (L[k].imag() < 0.0) != (L[k + 1].imag() < 0.0) &&
        (L[k].real() < 0.0 || L[k + 1].real() < 0.0)) {
      const double w =
          zero_between(grid_[k], grid_[k + 1], [&](double at_w) { return at(at_w).imag(); });
      take_gain(at(w), w, &margins->all);
    }
    if ((std::abs(L[k]) < 1.0) == (std::abs(L[k + 1]) < 1.0)) continue;
    const double w =
        zero_between(grid_[k], grid_[k + 1], [&](double at_w) { return std::abs(at(at_w)) - 1.0; });
    take_phase(at(w), w, &margins->all);
  }
  margins->gain_margin = sort_margins(&margins->all.gains, std::less<>());
  margins->gain_reduction = sort_margins(&margins->all.reductions, std::greater<>());
  margins->phase_margin = sort_margins(&margins->all.phases, std::less<>());
  margins->delay_margin = sort_margins(&margins->all.delays, std::less<>());
}

// At infinite frequency L is its direct part.
void OpenLoop::find_peaks(LoopMargins* margins) const {
  const auto complementary = [&](double w) { return std::abs(closed_at(w)); };
  LoopMargins::All& all = margins->all;
  all.sensitivities = peaks(grid_, [&](double w) { return std::abs(1.0 + closed_at(w)); });
  all.complementaries = peaks(grid_, complementary);
  const double far = functions_->closed.at_infinity();
  if (period_ == 0.0) all.sensitivities.push_back({std::abs(1.0 + far), grid_.back()});
  if (period_ == 0.0 && far != 0.0) all.complementaries.push_back({std::abs(far), grid_.back()});
  take_largest_peaks(margins);
  set_bandwidth(complementary, grid_, margins);
}

LoopMargins OpenLoop::margins() const {
  constexpr double kBelow = 0.999;  // a crossing
  LoopMargins margins;
  margins.is_stable = is_stable_;
  find_crossings(&margins);
  if (is_stable_) {
    find_peaks(&margins);
    return margins;
  }
  LoopMargins unstable;
  unstable.is_stable = false;
  if (margins.gain_reduction && is_stable_with(kBelow * margins.gain_reduction->value)) {
    unstable.gain_reduction = margins.gain_reduction;
    unstable.all.reductions = {*margins.gain_reduction};
  }
  return unstable;
}

}  // namespace codesign
