// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/poles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/arrays.h"
#include "math/linear_systems.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kStill = 1e-5;  // growth or turn in the duration
constexpr int kDigits = 6;

/// The rate of a motion whose change over a period is known.
Pole pole_of_period(std::complex<double> z, double uncertainty, double period) {
  const std::complex<double> s = std::log(z) / period;
  return {s, uncertainty / (std::abs(z) * period), false, {}, {}};
}

}  // namespace

const char* name_of(Stability stability) {
  switch (stability) {
    case Stability::kStable:
      return "stable";
    case Stability::kUnstable:
      return "unstable";
    case Stability::kNeutral:
      break;
  }
  return "neutral";
}

double Pole::frequency() const { return std::abs(value.imag()) / (2.0 * kPi); }
double Pole::damping_ratio() const {
  return value.real() == 0.0 ? 0.0 : -value.real() / std::abs(value);
}
double Pole::radius(double period) const { return std::exp(value.real() * period); }
bool Pole::is_zero(double duration) const {
  return std::abs(value) <= std::max(uncertainty, kStill / duration);
}

// A double pole at z = 0, as delays make, is found as several poles as large as the root of the
// rounding.
std::vector<Pole> poles_of(const StateSpace& system) {
  const SystemEigen eigen = system_eigen(system.A);
  std::vector<Pole> poles;
  for (Eigen::Index k = 0; k < eigen.values.size(); ++k) {
    const std::complex<double> value = eigen.values[k];
    const double uncertainty = eigen.uncertainty[k];
    if (value.imag() < 0.0) continue;
    Pole pole{value, uncertainty, false, {}, {}};
    if (system.period > 0.0) {
      if (std::abs(value) <= std::max(10.0 * uncertainty, 1e-14)) continue;
      pole = pole_of_period(value, uncertainty, system.period);
    }
    pole.is_pair = value.imag() > 0.0;
    pole.vector = eigen.vectors.col(k);
    pole.left = eigen.left.col(k);
    poles.push_back(pole);
  }
  std::stable_sort(poles.begin(), poles.end(), [](const Pole& one, const Pole& other) {
    const double tolerance = std::max(one.uncertainty, other.uncertainty);
    const double difference = one.growth() - other.growth();
    return std::abs(difference) > tolerance ? difference > 0.0
                                            : one.frequency() < other.frequency();
  });
  return poles;
}

Stability judge(const std::vector<Pole>& poles, double duration) {
  bool is_neutral = false;
  for (const Pole& pole : poles) {
    const bool is_zero = pole.is_zero(duration);
    is_neutral = is_neutral || is_zero;
    if (!is_zero && pole.growth() > pole.uncertainty) return Stability::kUnstable;
  }
  return is_neutral ? Stability::kNeutral : Stability::kStable;
}

std::string decisive_text(const std::vector<Pole>& poles, Stability stability, double period) {
  if (poles.empty()) return "no motion";
  const Pole& first = poles.front();
  std::string text;
  if (stability == Stability::kNeutral) {
    text = "a motion without force";
  } else if (std::abs(first.growth()) <= first.uncertainty) {
    text = "undamped, " + readable(first.frequency(), kDigits) + " Hz";
  } else {
    text = (stability == Stability::kUnstable ? "fastest growth " : "slowest pole ") +
           readable(first.growth(), kDigits) + " 1/s";
  }
  if (period > 0.0)
    text += ", spectral radius " + readable(first.radius(period), kDigits) + " over " +
            readable(period, kDigits) + " s";
  return text;
}

}  // namespace codesign
