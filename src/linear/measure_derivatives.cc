// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/measure_derivatives.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "linear/flowing_loop.h"
#include "linear/periodic_derivatives.h"
#include "math/arrays.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using ComplexNumber = std::complex<double>;
using Kind = LinearMeasure::Kind;

constexpr double kTurn = 6.283185307179586;  // [rad]

/// The transfer function H of a closed loop at a frequency: value, derivatives along the direction
/// and by the frequency, first and second.
struct Response {
  ComplexNumber value, change, slope, curvature;
};

class Loop {
 public:
  Loop(const ComplexSpace& closed, double period)
      : A_(closed.A.real()), B_(closed.B.real()), C_(closed.C.real()), period_(period) {
    constexpr double kPer = 1.0 / LinearDerivatives::kStep;
    dA_ = kPer * closed.A.imag();
    dB_ = kPer * closed.B.imag();
    dC_ = kPer * closed.C.imag();
    D_ = closed.D(0, 0).real();
    dD_ = kPer * closed.D(0, 0).imag();
  }

  // s = jw, or z = exp(jwT) with z' = jT z, z'' = -T^2 z.
  Response at(double w) const {
    const ComplexNumber j(0.0, 1.0);
    const ComplexNumber s = period_ > 0.0 ? std::polar(1.0, w * period_) : j * w;
    const ComplexNumber by_w = period_ > 0.0 ? j * period_ * s : j;
    const ComplexNumber twice = period_ > 0.0 ? -period_ * period_ * s : 0.0;
    Eigen::MatrixXcd M = -A_;
    M.diagonal().array() += s;
    const Eigen::MatrixXcd x = complex_solution(M, B_),
                           y = complex_solution(M.transpose(), C_.transpose()).transpose();
    const Eigen::MatrixXcd far = complex_solution(M, x);
    const ComplexNumber first = -product(y, x)(0, 0), second = 2.0 * product(y, far)(0, 0);
    const ComplexNumber change =
        product(dC_, x)(0, 0) + product(y, product(dA_, x) + dB_)(0, 0) + dD_;
    return {product(C_, x)(0, 0) + D_, change, first * by_w, second * by_w * by_w + first * twice};
  }
  /// L = -H/(1 + H) with its derivatives.
  Response opened(double w) const {
    const Response H = at(w);
    const ComplexNumber per = 1.0 / (1.0 + H.value);
    return {-H.value * per, -H.change * per * per, -H.slope * per * per, {}};
  }
  Response at_infinity() const { return {D_, dD_, 0.0, 0.0}; }

 private:
  Eigen::MatrixXcd A_, B_, C_, dA_, dB_, dC_;
  double D_ = 0.0, dD_ = 0.0;
  double period_;
};

// Im L = 0, or a fixed frequency where L is real by itself.
double gain_derivative(const Loop& loop, double w, double period) {
  const Response L = loop.opened(w);
  const bool is_fixed = w == 0.0 || (period > 0.0 && w >= 0.5 * kTurn / period * (1.0 - 1e-12));
  const double moves = is_fixed ? 0.0 : -L.change.imag() / L.slope.imag();
  return (L.change + L.slope * moves).real() / std::norm(L.value);
}

// |L| = 1.
struct PhaseChange {
  double angle, frequency;
};
PhaseChange phase_change(const Loop& loop, double w) {
  const Response L = loop.opened(w);
  const double moves =
      -(std::conj(L.value) * L.change).real() / (std::conj(L.value) * L.slope).real();
  return {((L.change + L.slope * moves) / L.value).imag(), moves};
}

double delay_derivative(const Loop& loop, const AtFrequency& margin) {
  const PhaseChange change = phase_change(loop, margin.frequency);
  return (change.angle - margin.value * change.frequency) / margin.frequency;
}

// |T|^2 - |T(0)|^2/2 = 0.
double bandwidth_derivative(const Loop& loop, double w, double rest) {
  const Response H = loop.at(w), still = loop.at(rest);
  const double change =
      (std::conj(H.value) * H.change).real() - 0.5 * (std::conj(still.value) * still.change).real();
  return -change / (std::conj(H.value) * H.slope).real();
}

/// The derivative of |shift + H| at its peak, which Newton's method brings nearer to the maximum.
double peak_derivative(const Loop& loop, const AtFrequency& peak, double shift, double period) {
  constexpr int kCorrections = 4;
  constexpr double kNear = 1e-3;  // beyond this part of the frequency it is another extremum
  Response H = loop.at(peak.frequency);
  const Response far = loop.at_infinity();
  constexpr double kSame = 1e-14;
  if (period == 0.0 && std::abs(std::abs(shift + far.value) - peak.value) <= kSame * peak.value) {
    H = far;
  } else {
    double w = peak.frequency;
    for (int k = 0; k < kCorrections; ++k) {
      const ComplexNumber all = std::conj(shift + H.value);
      const double slope = (all * H.slope).real(),
                   curvature = (all * H.curvature).real() + std::norm(H.slope);
      const double step = -slope / curvature;
      if (!(curvature < 0.0 && std::abs(w + step - peak.frequency) < kNear * peak.frequency)) break;
      w += step;
      H = loop.at(w);
    }
  }
  const ComplexNumber all = shift + H.value;
  return (std::conj(all) * H.change).real() / std::abs(all);
}

/// The derivative of a margin at infinite frequency; none: it is at another one.
std::optional<double> far_derivative(const AtFrequency& margin, Kind kind,
                                     const ComplexNumber& direct) {
  constexpr double kSame = 1e-12;
  if (kind == Kind::kDelayMargin && margin.value == 0.0) return 0.0;
  if (kind != Kind::kGainMargin && kind != Kind::kGainReduction) return {};
  const double D = direct.real(), dD = direct.imag() / LinearDerivatives::kStep;
  if (!(std::abs(margin.value - (1.0 + 1.0 / D)) <= kSame * margin.value)) return {};
  return -dD / (D * D);
}

double lower_damping(const ComplexNumber& s) {
  return s.real() == 0.0 ? 0.0 : -s.real() / std::abs(s);
}

/// The eigenvalue of a pole, and how far rounding moves it.
ComplexNumber eigenvalue_of(const Pole& pole, double period) {
  return period > 0.0 ? std::exp(pole.value * period) : pole.value;
}
bool meets_its_pair(const Pole& pole, double period) {
  const ComplexNumber value = eigenvalue_of(pole, period);
  const double uncertainty = pole.uncertainty * (period > 0.0 ? std::abs(value) * period : 1.0);
  return pole.is_pair && std::abs(value.imag()) <= uncertainty;
}

/// Eigenvalues about a centre, and the circle between them and all others.
struct Circle {
  ComplexNumber centre;
  double count = 0.0, inner = 0.0, outer = 0.0;
};

Circle circle_of(const PoleCluster& cluster, const std::vector<Pole>& poles, double period) {
  std::vector<ComplexNumber> inside, outside;
  if (period > 0.0) outside.emplace_back(0.0);  // where ln z ends, and poles that are left out
  bool has_pairs = false;
  for (const std::size_t member : cluster.members)
    has_pairs = has_pairs || meets_its_pair(poles[member], period);
  for (std::size_t k = 0; k < poles.size(); ++k) {
    const ComplexNumber value = eigenvalue_of(poles[k], period);
    const bool is_member =
        std::find(cluster.members.begin(), cluster.members.end(), k) != cluster.members.end();
    (is_member ? inside : outside).push_back(value);
    if (poles[k].is_pair) (is_member && has_pairs ? inside : outside).push_back(std::conj(value));
  }
  Circle circle;
  circle.count = static_cast<double>(inside.size());
  circle.centre = std::accumulate(inside.begin(), inside.end(), ComplexNumber(0.0)) / circle.count;
  for (const ComplexNumber& value : inside)
    circle.inner = std::max(circle.inner, std::abs(value - circle.centre));
  circle.outer = 4.0 * std::max(circle.inner, std::abs(circle.centre));
  if (circle.outer == 0.0) circle.outer = 1.0;
  for (const ComplexNumber& value : outside)
    circle.outer = std::min(circle.outer, std::abs(value - circle.centre));
  return circle;
}

/// How the mean of a cluster moves, as s. NaN where the circle does not tell it from others.
ComplexNumber mean_change(const Circle& circle, double period, const Eigen::MatrixXd& A,
                          const Eigen::MatrixXd& change) {
  constexpr double kApart = 2.0, kDigits = 36.0;  // e^-36 is rounding
  if (!(circle.outer > kApart * circle.inner)) return std::numeric_limits<double>::quiet_NaN();
  const double radius = std::max(0.25 * circle.outer, std::sqrt(circle.inner * circle.outer));
  const double factor = std::max(circle.inner / radius, radius / circle.outer);
  const int points = static_cast<int>(std::ceil(kDigits / -std::log(factor)));
  const Eigen::MatrixXcd weights =
      within_circle(A, circle.centre, radius, points, [period](const ComplexNumber& z) {
        return period > 0.0 ? 1.0 / (z * period) : ComplexNumber(1.0);
      });
  return weights.transpose().cwiseProduct(change.cast<ComplexNumber>()).sum() / circle.count;
}

/// The mean of the poles of a cluster, with those of pairs where a pair meets on the real axis.
void set_mean(const std::vector<Pole>& poles, PoleCluster* cluster) {
  bool is_real = false;
  double count = 0.0;
  ComplexNumber sum = 0.0;
  for (const std::size_t member : cluster->members) {
    const Pole& pole = poles[member];
    is_real = is_real || std::abs(pole.value.imag()) <= pole.uncertainty;
    const double times = pole.is_pair ? 2.0 : 1.0;
    count += times;
    sum += times * pole.value;
  }
  cluster->value = sum / count;
  if (is_real) cluster->value = cluster->value.real();
}

/// How a pole moves that is alone.
ComplexNumber pole_change(const Pole& pole, double period, const Eigen::MatrixXd& change) {
  const ComplexNumber of_eigenvalue =
      product(pole.left.transpose(),
              product(Eigen::MatrixXcd(change.cast<ComplexNumber>()), pole.vector))(0, 0);
  return period > 0.0 ? of_eigenvalue / (std::exp(pole.value * period) * period) : of_eigenvalue;
}

}  // namespace

std::vector<PoleCluster> ranked(const std::vector<Pole>& poles, Kind kind, double duration) {
  std::vector<PoleCluster> clusters;
  std::vector<bool> taken(poles.size());
  for (std::size_t k = 0; k < poles.size(); ++k) {
    if (kind == Kind::kDampingRatio && poles[k].is_zero(duration)) continue;
    if (taken[k]) continue;
    PoleCluster cluster;
    for (std::size_t other = k; other < poles.size(); ++other) {
      const double apart = std::abs(poles[other].value - poles[k].value);
      if (taken[other] || apart > poles[other].uncertainty + poles[k].uncertainty) continue;
      taken[other] = true;
      cluster.members.push_back(other);
      cluster.is_pair = cluster.is_pair || poles[other].is_pair;
    }
    set_mean(poles, &cluster);
    clusters.push_back(std::move(cluster));
  }
  const auto decides = [kind](const PoleCluster& one, const PoleCluster& other) {
    return kind == Kind::kDampingRatio ? lower_damping(one.value) < lower_damping(other.value)
                                       : one.value.real() > other.value.real();
  };
  std::stable_sort(clusters.begin(), clusters.end(), decides);
  std::vector<PoleCluster> places;
  for (const PoleCluster& cluster : clusters) {
    std::size_t count = 0;
    for (const std::size_t member : cluster.members) count += poles[member].is_pair ? 2 : 1;
    places.insert(places.end(), count, cluster);
  }
  if (!places.empty()) places.resize(LinearMeasure::kPoles, places.back());
  return places;
}

double value_of(const PoleCluster& cluster, Kind kind, double period) {
  switch (kind) {
    case Kind::kDampingRatio:
      return lower_damping(cluster.value);
    case Kind::kRadius:
      return std::exp(cluster.value.real() * period);
    default:
      return cluster.value.real();
  }
}

double derivative_of(const PoleCluster& cluster, const std::vector<Pole>& poles, Kind kind,
                     double period, const Eigen::MatrixXd& A, const Eigen::MatrixXd& change) {
  const Pole& first = poles[cluster.members.front()];
  const bool is_alone = cluster.members.size() == 1 && !meets_its_pair(first, period);
  const ComplexNumber moves =
      is_alone ? pole_change(first, period, change)
               : mean_change(circle_of(cluster, poles, period), period, A, change);
  const ComplexNumber s = cluster.value;
  const double size = std::abs(s);
  switch (kind) {
    case Kind::kDampingRatio:
      if (!cluster.is_pair && s.imag() == 0.0) return 0.0;
      return (-moves.real() + s.real() * (std::conj(s) * moves).real() / (size * size)) / size;
    case Kind::kRadius:
      return period * moves.real() * std::exp(s.real() * period);
    default:
      return moves.real();
  }
}

std::vector<AtFrequency> margins_of(const LoopMargins& margins, Kind kind) {
  const auto first_of = [&]() -> std::vector<AtFrequency> {
    switch (kind) {
      case Kind::kGainMargin:
        return margins.all.gains;
      case Kind::kGainReduction:
        return margins.all.reductions;
      case Kind::kPhaseMargin:
        return margins.all.phases;
      case Kind::kDelayMargin:
        return margins.all.delays;
      case Kind::kSensitivity:
        return margins.all.sensitivities;
      case Kind::kComplementarySensitivity:
        return margins.all.complementaries;
      default:
        return margins.bandwidth ? std::vector<AtFrequency>{*margins.bandwidth}
                                 : std::vector<AtFrequency>{};
    }
  };
  std::vector<AtFrequency> all = first_of();
  if (all.size() > LinearMeasure::kCrossings) all.resize(LinearMeasure::kCrossings);
  return all;
}

double derivative_of(const AtFrequency& margin, Kind kind, double rest, const ComplexSpace& closed,
                     double period) {
  const bool has_pieces = !closed.pieces.order.empty();
  if (has_pieces || period == 0.0)
    if (const auto far = far_derivative(margin, kind, closed.D(0, 0))) return *far;
  if (has_pieces) return FlowingLoop(closed).derivative_of(margin, kind, rest);
  if (closed.B.cols() > 1) return periodic_derivative_of(margin, kind, rest, closed, period);
  const Loop loop(closed, period);
  switch (kind) {
    case Kind::kGainMargin:
    case Kind::kGainReduction:
      return gain_derivative(loop, margin.frequency, period);
    case Kind::kPhaseMargin: {
      const ComplexNumber L = loop.opened(margin.frequency).value;
      const double sign = std::arg(-L) < 0.0 ? -1.0 : 1.0;
      return sign * phase_change(loop, margin.frequency).angle;
    }
    case Kind::kDelayMargin:
      return delay_derivative(loop, margin);
    case Kind::kBandwidth:
      return bandwidth_derivative(loop, margin.frequency, rest);
    case Kind::kSensitivity:
      return peak_derivative(loop, margin, 1.0, period);
    default:
      return peak_derivative(loop, margin, 0.0, period);
  }
}

}  // namespace codesign
