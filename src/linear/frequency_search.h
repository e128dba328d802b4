// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "linear/loop_margins.h"
#include "linear/poles.h"

namespace codesign {

constexpr double kHalfTurn = 3.141592653589793;  // [rad]
/// A frequency that counts as rest, of the lowest one of a grid.
constexpr double kBesideRest = 1e-3;

/// Frequencies [rad/s], ascending, at which a loop is to be seen: 100 per decade across all poles
/// of the closed and the open loop, finer near each, up to half of the sampling rate.
/// @param period of samples [s]; 0: continuous.
std::vector<double> frequencies_about(const std::vector<Pole>& closed,
                                      const std::vector<Pole>& open, double period);

/// A zero of a function between two frequencies at which its signs differ.
template <class Function>
double zero_between(double low, double high, const Function& function) {
  constexpr int kBisections = 200;
  const bool rises = function(low) < 0.0;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    ((function(middle) < 0.0) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The largest value near a point of the grid, by golden sections between its neighbours.
template <class Function>
AtFrequency peak_between(double low, double high, const Function& function) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSections = 80;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = function(a), at_b = function(b);
  for (int k = 0; k < kSections; ++k) {
    if (at_a > at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = function(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = function(b);
    }
  }
  return at_a > at_b ? AtFrequency{at_a, a} : AtFrequency{at_b, b};
}

/// The peaks on a grid, the highest one first; an end of the grid only if nothing is higher.
template <class Function>
std::vector<AtFrequency> peaks(const std::vector<double>& grid, const Function& function) {
  constexpr std::size_t kRefined = 8;
  std::vector<double> values;
  values.reserve(grid.size());
  for (const double w : grid) values.push_back(function(w));
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < grid.size(); ++k)
    if ((k == 0 || values[k] > values[k - 1]) &&
        (k + 1 == grid.size() || values[k] >= values[k + 1]))
      places.push_back(k);
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t one, std::size_t other) { return values[one] > values[other]; });
  if (places.size() > kRefined) places.resize(kRefined);
  std::vector<AtFrequency> found;
  for (const std::size_t k : places) {
    const bool is_end = k == 0 || k + 1 == grid.size();
    if (is_end && !found.empty()) continue;
    found.push_back({values[k], grid[k]});
    if (is_end) continue;
    const AtFrequency peak = peak_between(grid[k - 1], grid[k + 1], function);
    if (peak.value > values[k]) found.back() = peak;
  }
  return found;
}

/// Sorts numbers by their size, the one that decides first. @returns it.
template <class Decides>
std::optional<AtFrequency> sort_margins(std::vector<AtFrequency>* all, const Decides& decides) {
  std::stable_sort(all->begin(), all->end(), [&](const auto& one, const auto& other) {
    return decides(one.value, other.value);
  });
  return all->empty() ? std::nullopt : std::optional<AtFrequency>(all->front());
}

/// Sets Ms and Mt, the largest of all peaks of each.
inline void take_largest_peaks(LoopMargins* margins) {
  margins->sensitivity = sort_margins(&margins->all.sensitivities, std::greater<>());
  margins->complementary = sort_margins(&margins->all.complementaries, std::greater<>());
}

/// The frequency that stands for rest [rad/s]: 0, or beside it where |T| has a pole there: a motion
/// that the loop does not see, such as the position of a speed loop.
/// @param complementary |T(w)|. @param grid frequencies in rising order
template <class Function>
double rest_of(const Function& complementary, const std::vector<double>& grid) {
  return std::isfinite(complementary(0.0)) ? 0.0 : kBesideRest * grid.front();
}

/// The lowest frequency at which |T| falls below sqrt(1/2) of its value at rest; none without one.
template <class Function>
std::optional<AtFrequency> bandwidth_of(const Function& complementary,
                                        const std::vector<double>& grid, double rest) {
  const double level = std::sqrt(0.5) * complementary(rest);
  if (!std::isfinite(level) || level == 0.0) return {};
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (complementary(grid[k]) >= level) continue;
    const double w = zero_between(k == 0 ? 0.0 : grid[k - 1], grid[k],
                                  [&](double at) { return complementary(at) - level; });
    return AtFrequency{w, w};
  }
  return {};
}

/// Sets the bandwidth, and the frequency that stands for rest. @param complementary |T(w)|
template <class Function>
void set_bandwidth(const Function& complementary, const std::vector<double>& grid,
                   LoopMargins* margins) {
  margins->rest = rest_of(complementary, grid);
  margins->bandwidth = bandwidth_of(complementary, grid, margins->rest);
}

}  // namespace codesign
