// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mechanism_codesign/optimization.h"

namespace codesign {

/// What a point of a trade-off is.
enum class TradeoffKind {
  kOnCurve,  ///< a search has ended there at a stationary point, and no other point dominates it
  kStoppedEarly,  ///< the search ended on a slope; no other point dominates it
  kRepeated,      ///< another point has the same objectives: the curve has a gap there
  kDominated,     ///< another point is as good in all objectives and better in one
  kFailed         ///< the search has no point that meets the constraints
};
constexpr std::array<const char*, 5> kTradeoffKindNames{"on_curve", "stopped_early", "repeated",
                                                        "dominated", "failed"};

/// One design of a trade-off and the search that has found it.
struct TradeoffPoint {
  /// beta: of the anchors in the reference point, sum 1, theory (24m)
  Eigen::VectorXd place;
  Eigen::VectorXd rho;         ///< order of Problem::tuned_names()
  Eigen::VectorXd objectives;  ///< f_k, order of TradeoffResult::names; not numbers if it failed
  TradeoffKind kind = TradeoffKind::kOnCurve;
  bool is_anchor = false;  ///< the least of one objective alone
  Status status;           ///< of the search
  std::string termination;
  double stationarity = 0.0;  ///< as OptimalityResult
  SearchCost cost;
  std::vector<std::string> warnings;  ///< codes of the search's warnings
};

/// The designs of which none is better in one objective without being worse in another.
struct TradeoffResult {
  Status status;                   ///< kCancelled with the points so far; of an anchor that failed
  std::vector<std::string> names;  ///< of the objectives
  std::vector<TradeoffPoint> points;  ///< along the curve: by their places
  /// The least values of the objectives and their values at the other anchors, the worst of them.
  Eigen::VectorXd ideal, nadir;
  /// Of two objectives: the smallest and the largest distance of neighbours on the curve, relative
  /// to nadir - ideal; not numbers otherwise.
  double smallest_gap = std::numeric_limits<double>::quiet_NaN(),
         largest_gap = std::numeric_limits<double>::quiet_NaN();
  SearchCost cost;  ///< of all searches
  Warnings warnings;
};

/// Called after each search. @param of the number of searches that are planned. Returning false
/// ends the job.
using TradeoffObserver = std::function<bool(const TradeoffPoint&, int done, int of)>;

/// The number of points where none is given: of two objectives along the curve, of three along each
/// side of the triangle between the anchors.
constexpr int kTradeoffPoints = 11, kTradeoffSide = 5;
/// Most points of two objectives, and of a side of three.
constexpr int kMostTradeoffPoints = 1000, kMostTradeoffSide = 40;

/// The trade-off between the objectives of `tradeoff:`, by normal boundary intersection; theory
/// (24m). First the least of each objective alone, from the study's start, then points between,
/// each from its neighbours.
/// @param points 0: the default. @throws InputError for a study without `tradeoff`, with another
/// measure than mean and worst, and as optimize().
TradeoffResult find_tradeoff(const Problem& problem, int points, const TradeoffObserver& observer,
                             const std::atomic<bool>* cancel);

/// Sets TradeoffPoint::kind of all points. @param range nadir - ideal.
void sort_out(const Eigen::VectorXd& range, std::vector<TradeoffPoint>* points);

/// The problem of one of the objectives alone.
Problem objective_of(const Problem& problem, std::size_t objective);

}  // namespace codesign
