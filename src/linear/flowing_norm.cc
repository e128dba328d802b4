// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/flowing_norm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "linear/flowing_period.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;

/// States x and costates q from one instant to the next, both ways: x1 = xx x0 + xq q1, q0 = qx x0
/// + qq q1. Unlike the map of both in time it does not grow.
struct Scattering {
  MatrixXcd xx, xq, qx, qq;
  /// Whether no signal of this time alone, from rest, is amplified beyond the level.
  bool is_below = true;
};

Scattering behind(const Scattering& a, const Scattering& b) {
  const Index n = a.xx.rows();
  MatrixXcd right(n, 2 * n);
  right << a.xx, product(a.xq, b.qq);
  const MatrixXcd x = complex_solution(MatrixXcd::Identity(n, n) - product(a.xq, b.qx), right);
  const MatrixXcd by_x = x.leftCols(n), by_q = x.rightCols(n);
  // What the first signals leave, as the later time amplifies it.
  const MatrixXcd again = product(a.xq, b.qx).real().cast<Complex>();
  const bool is_below = a.is_below && b.is_below && again.allFinite() &&
                        (again.isZero(0.0) || complex_eigenvalues(again).real().maxCoeff() < 1.0);
  return {product(b.xx, by_x), product(b.xx, by_q) + b.xq,
          a.qx + product(a.qq, product(b.qx, by_x)), product(a.qq, product(b.qx, by_q) + b.qq),
          is_below};
}

/// Short enough that nothing grows much, then doubled.
Scattering scattered(const MatrixXcd& flow, double time) {
  constexpr double kGrowth = 1.0;
  const Index n = flow.rows() / 2;
  const double fastest = complex_eigenvalues(flow.real().cast<Complex>()).cwiseAbs().maxCoeff();
  const int doublings = fastest * time > kGrowth
                            ? static_cast<int>(std::ceil(std::log2(fastest * time / kGrowth)))
                            : 0;
  const MatrixXcd all = matrix_exponential(MatrixXcd(flow * (time * std::exp2(-doublings))));
  const MatrixXcd back = complex_solution(all.bottomRightCorner(n, n), MatrixXcd::Identity(n, n));
  const MatrixXcd xq = product(all.topRightCorner(n, n), back),
                  qx = -product(back, all.bottomLeftCorner(n, n));
  Scattering result{all.topLeftCorner(n, n) + product(all.topRightCorner(n, n), qx), xq, qx, back,
                    true};
  for (int k = 0; k < doublings; ++k) result = behind(result, result);
  return result;
}

ComplexSpace without_changes(ComplexSpace space) {
  for (MatrixXcd* matrix : {&space.A, &space.B, &space.C, &space.D}) matrix->imag().setZero();
  for (PeriodPiece& piece : space.pieces.different) piece.jump.imag().setZero();
  return space;
}

}  // namespace

FlowingNorm::FlowingNorm(ComplexSpace space, double shift)
    : space_(std::move(space)), values_(without_changes(space_)), shift_(shift) {
  constexpr double kOnCircle = 1e-6;
  for (const Complex& z : complex_eigenvalues(map_with(values_of(space_), 1.0)))
    if (std::abs(std::abs(z) - 1.0) < kOnCircle) marginal_.push_back(z);
}

double FlowingNorm::of_fast_signals() const { return std::abs(shift_ + space_.D(0, 0).real()); }

double FlowingNorm::derivative_of_fast_signals() const {
  const double change = space_.D(0, 0).imag() / ComplexSpace::kStep;
  return shift_ + space_.D(0, 0).real() < 0.0 ? -change : change;
}

// w = (level B^T q + d z)/level^2 with d = shift + D makes |z|^2 - level^2 |w|^2 stationary.
FlowingNorm::Pencil FlowingNorm::pencil(const ComplexSpace& space, Complex level,
                                        bool with_doublings) const {
  constexpr int kDoublings = 10;
  const Index n = space.A.rows();
  const Complex d = space.D(0, 0) + shift_, per = 1.0 / (level * level - d * d);
  MatrixXcd flow(2 * n, 2 * n);
  const MatrixXcd own = space.A + d * per * product(space.B, space.C);
  flow << own, level * per * product(space.B, space.B.transpose()),
      -level * per * product(space.C.transpose(), space.C), -own.transpose();
  std::map<double, Scattering> flows;
  const MatrixXcd unit = MatrixXcd::Identity(n, n), zero = MatrixXcd::Zero(n, n);
  std::vector<Scattering> pieces;
  for (const PeriodPiece& piece : space.pieces.different) {
    const MatrixXcd J = piece.jump.leftCols(n);
    pieces.push_back({J, zero, zero, J.transpose(), true});
    if (!(piece.time > 0.0)) continue;
    if (flows.count(piece.time) == 0) flows[piece.time] = scattered(flow, piece.time);
    pieces.back() = behind(pieces.back(), flows[piece.time]);
  }
  Scattering all = in_order(std::move(pieces), space.pieces.order, behind);
  Pencil result{MatrixXcd(2 * n, 2 * n), MatrixXcd(2 * n, 2 * n), all.is_below};
  result.M << all.xx, zero, all.qx, -unit;
  result.N << unit, -all.xq, zero, -all.qq;
  if (with_doublings)
    for (int k = 0; k < kDoublings && all.is_below; ++k) all = behind(all, all);
  result.is_below = all.is_below;
  return result;
}

// z on the circle is an imaginary (z - a)/(z + a) with any a on it.
std::optional<double> FlowingNorm::angle_at(double level, double otherwise) const {
  constexpr double kOnCircle = 1e-7, kBesideMarginal = 1e-4, kSamePeak = 1e-3;
  const Complex a = std::polar(1.0, 2.345);
  const Pencil at = pencil(values_, level, true);
  std::vector<double> angles;
  for (const Complex& mu :
       complex_eigenvalues(complex_solution(at.M + a * at.N, at.M - a * at.N))) {
    const Complex z = a * (1.0 + mu) / (1.0 - mu);
    if (!(std::abs(std::abs(z) - 1.0) < kOnCircle)) continue;
    if (std::any_of(marginal_.begin(), marginal_.end(),
                    [&z](const Complex& own) { return std::abs(own - z) < kBesideMarginal; }))
      continue;
    angles.push_back(std::abs(std::arg(z)));
  }
  if (angles.empty()) return at.is_below ? std::nullopt : std::optional<double>(otherwise);
  double sum = 0.0, count = 0.0;
  for (const double angle : angles)
    if (std::abs(angle - angles.front()) < kSamePeak) {
      sum += angle;
      count += 1.0;
    }
  return sum / count;
}

/// At a level and an angle: how far the level is from a singular value, and how that moves.
struct FlowingNorm::Turning {
  double missing, by_angle, by_design;
};

// With the left and right vectors of the smallest singular value of the pencil.
FlowingNorm::Turning FlowingNorm::turning(const Peak& peak) const {
  constexpr double kPer = 1.0 / ComplexSpace::kStep;
  const Complex z = std::polar(1.0, peak.angle);
  const Pencil by_level = pencil(values_, Complex(peak.value, ComplexSpace::kStep), false),
               by_design = pencil(space_, peak.value, false);
  const auto joined = [&z](const Eigen::MatrixXd& M, const Eigen::MatrixXd& N) -> MatrixXcd {
    return M.cast<Complex>() - z * N.cast<Complex>();
  };
  const MatrixXcd at = joined(by_level.M.real(), by_level.N.real());
  const MatrixXcd inverse = complex_solution(at, MatrixXcd::Identity(at.rows(), at.rows()));
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!inverse.allFinite()) return {kNone, kNone, kNone};
  const LargestGain gain = largest_gain(inverse);
  const auto form = [&gain](const MatrixXcd& P) {
    return gain.right.dot(product(P, gain.left).col(0));
  };
  const Complex per = -1.0 / form(joined(kPer * by_level.M.imag(), kPer * by_level.N.imag()));
  return {(form(at) * per).real(),
          (form(Complex(0.0, -1.0) * z * by_level.N.real().cast<Complex>()) * per).real(),
          (form(joined(kPer * by_design.M.imag(), kPer * by_design.N.imag())) * per).real()};
}

/// Newton's method for the level and, by differences of the slope, for the angle.
bool FlowingNorm::refine(Peak* peak) const {
  constexpr int kCorrections = 6;
  constexpr double kBeside = 1e-5, kNear = 1e-5, kSettled = 1e-12;
  Peak at = *peak;
  for (int k = 0; k < kCorrections; ++k) {
    const Turning here = turning(at), beside = turning({at.value, at.angle + kBeside});
    const double curvature = (beside.by_angle - here.by_angle) / kBeside;
    const double step = curvature < 0.0 ? -here.by_angle / curvature : 0.0;
    at.value += here.missing;
    if (std::abs(step) < 0.1) at.angle += step;
    if (!(std::abs(at.value / peak->value - 1.0) < kNear)) return false;
    if (std::abs(step) < kSettled) break;
  }
  *peak = {at.value, std::abs(at.angle) < kSettled ? 0.0 : std::abs(at.angle)};
  return true;
}

std::optional<FlowingNorm::Peak> FlowingNorm::above(const Peak& known) const {
  constexpr double kRounding = 1e-9, kFirst = 1e-6, kMost = 1e9, kNear = 1e-6, kExact = 1e-13;
  if (known.value == 0.0) return {};
  // The pencil has no level that is the direct part itself.
  const double least =
      std::max(known.value * (1.0 + kRounding), of_fast_signals() * (1.0 + kFirst));
  double low = least, high = low;
  std::optional<double> angle = angle_at(low, known.angle);
  if (!angle) return {};
  for (double step = kFirst;; step *= 4.0) {
    if (step > kMost) return Peak{std::numeric_limits<double>::infinity(), *angle};
    high = least * (1.0 + step);
    const std::optional<double> there = angle_at(high, *angle);
    if (!there) break;
    low = high;
    angle = there;
  }
  const auto narrow = [&](double until) {
    while (high > low * (1.0 + until)) {
      const double middle = std::sqrt(low * high);
      const std::optional<double> there = angle_at(middle, *angle);
      (there ? low : high) = middle;
      if (there) angle = there;
    }
  };
  narrow(kNear);
  Peak peak{low, *angle};
  if (refine(&peak)) return peak;
  narrow(kExact);
  return Peak{low, *angle};
}

double FlowingNorm::derivative_of(const Peak& peak) const { return turning(peak).by_design; }

}  // namespace codesign
