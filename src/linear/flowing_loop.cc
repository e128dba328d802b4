// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/flowing_loop.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "linear/flowing_norm.h"
#include "linear/frequency_search.h"
#include "linear/poles.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Kind = LinearMeasure::Kind;

constexpr double kSameLevel = 1e-9;

double shift_of(bool complementary) { return complementary ? 0.0 : 1.0; }

}  // namespace

FlowingLoop::FlowingLoop(ComplexSpace closed)
    : space_(std::move(closed)),
      closed_(values_of(space_)),
      open_(closed_.opened()),
      period_(closed_.period()) {
  const auto poles_with = [this](const MatrixXcd& A, double period) {
    StateSpace space;
    space.period = period;
    space.A = A.real();
    return poles_of(space);
  };
  std::vector<Pole> closed_poles = poles_with(map_with(closed_, 1.0), period_),
                    open_poles = poles_with(map_with(closed_, 0.0), period_);
  is_stable_ = std::none_of(closed_poles.begin(), closed_poles.end(),
                            [](const Pole& pole) { return pole.growth() > pole.uncertainty; });
  // Poles of a period tell frequencies up to half of its rate, those of the flow all of them.
  for (const Pole& pole : poles_with(closed_.A, 0.0)) closed_poles.push_back(pole);
  for (const Pole& pole : poles_with(open_.A, 0.0)) open_poles.push_back(pole);
  grid_ = frequencies_about(closed_poles, open_poles, 0.0);
}

Complex FlowingLoop::at(double frequency) const { return -part_at(open_, frequency); }

MatrixXcd FlowingLoop::closed_by(Complex factor) const { return map_with(closed_, factor); }
MatrixXcd FlowingLoop::by_factor(Complex factor) const { return map_by_factor(closed_, factor); }
double FlowingLoop::frequency_of(Complex factor, const EigenTriple& pole) const {
  return largest_sinusoid(closed_, factor, pole.right, std::arg(pole.value));
}

/// The largest norm, where it exceeds the response to sinusoids; else the peaks of that.
std::vector<AtFrequency> FlowingLoop::peaks_of(bool complementary, const Part& part) const {
  const double shift = shift_of(complementary);
  const auto response = [&](double w) { return std::abs(shift + part(w)); };
  const FlowingNorm norm(space_, shift);
  std::vector<AtFrequency> found = peaks(grid_, response);
  found.push_back({norm.of_fast_signals(), grid_.back()});
  sort_margins(&found, std::greater<>());
  const std::optional<FlowingNorm::Peak> largest =
      norm.above({found.front().value, found.front().frequency * period_});
  if (!largest) return found;
  if (!std::isfinite(largest->value)) return {};
  AtFrequency peak{largest->value, largest->angle / period_};
  double most = -1.0;
  for (const double angle : {largest->angle, -largest->angle})
    for (const double frequency : frequencies_near(closed_.A, angle, period_)) {
      const double size = response(frequency);
      if (size <= most * (1.0 + kSameLevel)) continue;
      most = size;
      peak.frequency = std::abs(frequency);
    }
  return {peak};
}

void FlowingLoop::find_peaks(LoopMargins* margins) const {
  std::map<double, Complex> known;
  const Part part = [&](double w) {
    const auto found = known.find(w);
    return found != known.end() ? found->second : known[w] = part_at(closed_, w);
  };
  const bool is_bounded = std::all_of(closed_.G.begin(), closed_.G.end(),
                                      [](const MatrixXcd& jump) { return jump.isZero(0.0); });
  if (is_bounded) {
    margins->all.sensitivities = peaks_of(false, part);
    margins->all.complementaries = peaks_of(true, part);
    take_largest_peaks(margins);
  }
  set_bandwidth([&](double w) { return std::abs(part(w)); }, grid_, margins);
}

LoopMargins FlowingLoop::margins() const {
  LoopMargins margins;
  margins.is_stable = is_stable_;
  find_pole_margins(*this, &margins);
  if (is_stable_) find_peaks(&margins);
  return margins;
}

double FlowingLoop::norm_derivative(const AtFrequency& margin, bool complementary) const {
  const FlowingNorm norm(space_, shift_of(complementary));
  if (margin.value <= norm.of_fast_signals() * (1.0 + kSameLevel))
    return norm.derivative_of_fast_signals();
  return norm.derivative_of({margin.value, margin.frequency * period_});
}

// |T|^2 - |T(0)|^2/2 = 0.
double FlowingLoop::bandwidth_derivative(double frequency, double rest) const {
  const FlowingSpace change = changes_of(space_);
  const Complex at = part_at(closed_, frequency), still = part_at(closed_, rest);
  const double moved = (std::conj(at) * part_along(closed_, frequency, change)).real() -
                       0.5 * (std::conj(still) * part_along(closed_, rest, change)).real();
  return -moved / (std::conj(at) * part_by_frequency(closed_, frequency)).real();
}

double FlowingLoop::derivative_of(const AtFrequency& margin, Kind kind, double rest) const {
  switch (kind) {
    case Kind::kBandwidth:
      return bandwidth_derivative(margin.frequency, rest);
    case Kind::kSensitivity:
      return norm_derivative(margin, false);
    case Kind::kComplementarySensitivity:
      return norm_derivative(margin, true);
    default:
      break;
  }
  const FlowingSpace change = changes_of(space_);
  const auto moved_by = [&](Complex factor) { return map_along(closed_, factor, change); };
  return pole_margin_derivative(*this, moved_by, period_, margin, kind);
}

}  // namespace codesign
