// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/frequency_search.h"

#include <cmath>
#include <complex>

namespace codesign {
namespace {

using Complex = std::complex<double>;

constexpr int kPerDecade = 100;
constexpr double kBeyond = 1e3;  // the slowest and the fastest pole

/// The frequencies of one pole and around it, where the response turns by half.
void add_around(const Complex& pole, std::vector<double>* grid) {
  constexpr int kSteps = 24;
  const double width = std::abs(pole.real()), centre = std::abs(pole.imag());
  if (std::abs(pole) == 0.0) return;
  grid->push_back(std::abs(pole));
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double at = centre + width * std::sinh(0.2 * k);
    if (at > 0.0) grid->push_back(at);
  }
}

}  // namespace

std::vector<double> frequencies_about(const std::vector<Pole>& closed,
                                      const std::vector<Pole>& open, double period) {
  double slowest = 0.0, fastest = 0.0;
  std::vector<double> grid;
  for (const auto* poles : {&closed, &open})
    for (const Pole& pole : *poles) {
      const double size = std::abs(pole.value);
      if (size <= 10.0 * pole.uncertainty) continue;
      slowest = slowest == 0.0 ? size : std::min(slowest, size);
      fastest = std::max(fastest, size);
      add_around(pole.value, &grid);
    }
  if (fastest == 0.0) slowest = fastest = 1.0;
  double last = kBeyond * fastest;
  if (period > 0.0) last = kHalfTurn / period;
  const double first = std::min(slowest / kBeyond, last / kBeyond);
  const int count = static_cast<int>(kPerDecade * std::log10(last / first)) + 2;
  for (int k = 0; k <= count; ++k)
    grid.push_back(first * std::pow(last / first, static_cast<double>(k) / count));
  grid.erase(
      std::remove_if(grid.begin(), grid.end(), [&](double w) { return !(w >= first && w < last); }),
      grid.end());
  grid.push_back(last);
  std::sort(grid.begin(), grid.end());
  grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
  return grid;
}

}  // namespace codesign
