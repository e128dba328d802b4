// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/limit_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include "excitation/trajectory_space.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Kind = LimitedSignal::Kind;
constexpr Eigen::Index kScanPerWave = 64;
// Each round halves the intervals beside a peak, and reduces the error of the peak to a quarter.
constexpr int kRounds = 14;
constexpr double kMissed = 1e-11;  // peaks between the times that rise less do not count
// Beyond it a peak's exact height does not matter, and differences of heights may be no numbers.
constexpr double kFarOutside = 1e6;
// Target of fit(): the errors of peaks are smaller than the remainder.
constexpr double kKept = 1.0 - 1e-8;
// Smallest factor of fit(): smaller motions determine nothing.
constexpr double kLeastFactor = 1e-6;
constexpr int kMostFits = 100;
constexpr double kBesideTurn[] = {1e-4, 1e-3, 1e-2, 3e-2,
                                  0.1,  0.3};  // fractions of a step around a change of direction

/// The time between `from` and `to` at which the velocity of a joint changes its sign.
double turning_time(const TrajectorySpace& space, const Eigen::VectorXd& coefficients, double from,
                    double to) {
  const auto velocity = [&](double time) { return space.basis().at(time).rate.dot(coefficients); };
  const bool rises = velocity(from) < 0.0;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (from + to);
    ((velocity(middle) < 0.0) == rises ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

}  // namespace

Eigen::RowVectorXd samples_of(const LimitedSignal& signal, const DrivePath& path,
                              const PathResponse& response) {
  const Eigen::MatrixXd& from =
      signal.is_follower
          ? signal.kind == Kind::kPosition ? response.follower_position : response.follower_velocity
      : signal.kind == Kind::kEffort   ? response.effort
      : signal.kind == Kind::kPosition ? path.position
      : signal.kind == Kind::kVelocity ? path.velocity
                                       : path.acceleration;
  return from.row(signal.joint);
}

double LimitScan::relative(const ScanPoint& point, std::size_t signal) const {
  return limits_.signals[signal].relative(point.values[to_signed(signal)]);
}

std::vector<double> LimitScan::first_times(const Eigen::VectorXd& x) const {
  const TrajectoryBasis& basis = space_.basis();
  const auto waves = static_cast<Eigen::Index>(std::ceil(basis.period() / basis.shortest_wave()));
  std::vector<double> times = times_in_period(basis.period(), kScanPerWave * waves);
  const Eigen::MatrixXd velocity = space_.path(x, SampledShapes(basis, times)).velocity;
  const Eigen::MatrixXd c = space_.coefficients(x);
  const double step = times[1];
  for (Eigen::Index joint = 0; joint < space_.joints(); ++joint)
    for (Eigen::Index k = 1; k < velocity.cols(); ++k) {
      if ((velocity(joint, k - 1) < 0.0) == (velocity(joint, k) < 0.0)) continue;
      const double turn = turning_time(space_, c.col(joint), step * static_cast<double>(k - 1),
                                       step * static_cast<double>(k));
      for (const double beside : kBesideTurn)
        for (const double side : {-1.0, 1.0})
          times.push_back(std::clamp(turn + side * beside * step, 0.0, basis.period()));
    }
  times.push_back(basis.period());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

Status LimitScan::evaluate(const Eigen::VectorXd& x, const std::vector<double>& times,
                           std::vector<ScanPoint>* points) {
  const DrivePath path = space_.path(x, SampledShapes(space_.basis(), times));
  PathResponse response;
  if (Status status = motion_.respond(path, false, &response); !status.ok()) return status;
  const auto count = to_signed(limits_.signals.size());
  Eigen::MatrixXd values(count, path.samples());
  for (Eigen::Index s = 0; s < count; ++s)
    values.row(s) = samples_of(limits_.signals[to_index(s)], path, response);
  for (std::size_t k = 0; k < times.size(); ++k)
    points->push_back({times[k], values.col(to_signed(k))});
  std::sort(points->begin(), points->end(),
            [](const ScanPoint& a, const ScanPoint& b) { return a.time < b.time; });
  return {};
}

// The middles of both intervals beside each peak that may exceed the highest or lowest value of its
// signal, as estimated from the bend of its neighbours.
std::vector<double> LimitScan::finer_times(const std::vector<ScanPoint>& points) const {
  std::vector<double> times;
  for (std::size_t s = 0; s < limits_.signals.size(); ++s)
    for (const double side : {-1.0, 1.0}) {
      double farthest = -std::numeric_limits<double>::infinity();
      for (const ScanPoint& point : points)
        farthest = std::max(farthest, side * relative(point, s));
      for (std::size_t k = 1; k + 1 < points.size(); ++k) {
        const double before = side * relative(points[k - 1], s),
                     here = side * relative(points[k], s),
                     after = side * relative(points[k + 1], s);
        const double bend = 2.0 * here - before - after;
        if (here < before || here < after || bend < kMissed || here + bend < farthest) continue;
        times.push_back(0.5 * (points[k - 1].time + points[k].time));
        times.push_back(0.5 * (points[k].time + points[k + 1].time));
      }
    }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

LimitScan::Extremes LimitScan::scan(const Eigen::VectorXd& x) {
  Extremes extremes;
  std::vector<ScanPoint> points;
  std::vector<double> times = first_times(x);
  for (int round = 0; round < kRounds && !times.empty(); ++round) {
    extremes.status = evaluate(x, times, &points);
    if (!extremes.status.ok()) return extremes;
    for (const ScanPoint& point : points)
      for (std::size_t s = 0; s < limits_.signals.size(); ++s)
        extremes.worst = std::max(extremes.worst, std::abs(relative(point, s)));
    if (extremes.worst > kFarOutside) break;
    times = finer_times(points);
  }
  extremes.signals.resize(limits_.signals.size());
  for (std::size_t s = 0; s < limits_.signals.size(); ++s) {
    const auto column = to_signed(s);
    extremes.signals[s] = {points.front().values[column], points.front().values[column]};
    for (const ScanPoint& point : points) {
      extremes.signals[s].lowest = std::min(extremes.signals[s].lowest, point.values[column]);
      extremes.signals[s].highest = std::max(extremes.signals[s].highest, point.values[column]);
    }
  }
  return extremes;
}

bool LimitScan::fit(Eigen::VectorXd* x, Extremes* extremes) {
  double haste = 1.0, total = 1.0;
  for (int k = 0; k < kMostFits && total > kLeastFactor; ++k) {
    *extremes = scan(*x);
    if (extremes->status.is_interrupted()) return false;
    if (extremes->status.ok() && extremes->worst <= 1.0) return true;
    // Gravity and the rest position do not shrink with the excursion, so that a reduction by the
    // excess may not suffice; the next one is then twice as large.
    const double factor = extremes->status.ok()
                              ? std::max(0.5, 1.0 / (1.0 + haste * (extremes->worst - kKept)))
                              : 0.8;
    haste = std::min(2.0 * haste, 64.0);
    total *= factor;
    *x = space_.shrunk(*x, factor);
  }
  return false;
}

}  // namespace codesign
