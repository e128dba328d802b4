// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/tradeoff.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "optimization/algorithm.h"
#include "optimization/objectives.h"
#include "problem/load_problem.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Eigen::VectorXd;

// Differences below the first, in units of nadir - ideal, are the error of a search; objectives do
// not conflict if that range is below the second, in units of their values.
constexpr double kSame = 1e-6, kNoRange = 1e-6;
// What an end of the curve gives of its own objective so that the others gain at least ten times as
// much; and the gain after which the ranges are others, all in units of nadir - ideal.
constexpr double kGiven = 1e-4, kGainForEnds = 1e-3, kOtherRange = 0.1;
constexpr int kEndRounds = 3;
// The narrowest part of the line between the anchors that is halved, as a share of the mean one.
constexpr double kNarrowest = 1.0 / 16.0;

class Tradeoff {
 public:
  Tradeoff(const Problem& problem, int points, const TradeoffObserver& observer,
           const std::atomic<bool>* cancel)
      : problem_(problem), observer_(observer), cancel_(cancel), objectives_(problem, cancel) {
    for (const TradeoffObjective& objective : study_of(problem).tradeoff)
      result_.names.push_back(objective.name);
    points_ = points > 0 ? points : count() == 2 ? kTradeoffPoints : kTradeoffSide;
    planned_ = count() == 2 ? points_ : points_ * (points_ + 1) / 2;
  }

  TradeoffResult run() {
    if (find_anchors() && refine_ends() && has_conflict())
      count() == 2 ? follow_curve() : fill_triangle();
    conclude();
    return std::move(result_);
  }

 private:
  std::size_t count() const { return result_.names.size(); }
  std::vector<TradeoffPoint>& points() { return result_.points; }

  bool is_cancelled() {
    if (result_.status.ok() && is_set(cancel_))
      result_.status = {StatusCode::kCancelled, 0.0, "cancelled; the points so far are kept"};
    return !result_.status.ok();
  }

  /// Keeps a point of an ended search. False if the job is to end.
  bool keep(TradeoffPoint point) {
    result_.cost += point.cost;
    if (is_cancelled()) return false;
    const bool is_found = point.objectives.size() > 0;
    if (!is_found) {
      point.objectives.setConstant(to_signed(count()), std::numeric_limits<double>::quiet_NaN());
      point.kind = TradeoffKind::kFailed;
    } else if (!point.status.ok() || !is_success(point.termination)) {
      point.kind = TradeoffKind::kStoppedEarly;
    }
    points().push_back(std::move(point));
    if (observer_ && !observer_(points().back(), static_cast<int>(points().size()), planned_)) {
      result_.status = {StatusCode::kCancelled, 0.0, "cancelled; the points so far are kept"};
      return false;
    }
    return true;
  }

  bool find_anchors() {
    for (std::size_t k = 0; k < count(); ++k) {
      TradeoffPoint point;
      point.is_anchor = true;
      point.place = VectorXd::Unit(to_signed(count()), to_signed(k));
      const OptimizationResult found = objectives_.search_alone(k);
      take_search(found, &point);
      const bool has_design =
          found.best.gradient.size() > 0 && found.status.code != StatusCode::kInfeasible;
      const bool is_known = has_design && !is_set(cancel_) && objectives_.evaluate(&point);
      const Status status = point.status;
      if (!keep(std::move(point))) return false;
      if (is_known) continue;
      result_.status = status;
      result_.status.cause = "the least of " + result_.names[k] +
                             " alone, an end of the curve, was not found: " + status.cause;
      return false;
    }
    return true;
  }

  void take_ends() {
    anchors_.resize(to_signed(count()), to_signed(count()));
    for (std::size_t k = 0; k < count(); ++k) anchors_.col(to_signed(k)) = points()[k].objectives;
    // The least values of the first searches stay.
    const VectorXd least = anchors_.rowwise().minCoeff();
    result_.ideal = result_.ideal.size() > 0 ? VectorXd(result_.ideal.cwiseMin(least)) : least;
    result_.nadir = anchors_.rowwise().maxCoeff();
    range_ = result_.nadir - result_.ideal;
  }

  bool is_range(Eigen::Index k) const {
    return range_[k] > kNoRange * (std::abs(result_.nadir[k]) + std::abs(result_.ideal[k]));
  }

  /// The least of an objective alone may leave others undetermined, such as the least time the
  /// effort, and does not heed them where it is flat. So its end gives almost nothing of it for
  /// them.
  bool refine_ends() {
    take_ends();
    for (int round = 0; round < kEndRounds; ++round) {
      bool has_changed = false;
      for (std::size_t k = 0; k < count(); ++k) {
        if (is_cancelled()) return false;
        if (std::all_of(points().begin(), points().end(), [&](const TradeoffPoint& other) {
              return !is_range(to_signed(&other - points().data()));
            }))
          return true;
        has_changed = refine_end(k) || has_changed;
      }
      take_ends();
      if (!has_changed) return true;
    }
    return true;
  }

  bool refine_end(std::size_t end) {
    TradeoffPoint& known = points()[end];
    VectorXd scale(range_.size());
    for (Eigen::Index k = 0; k < scale.size(); ++k)
      scale[k] = is_range(k) ? range_[k] : std::abs(known.objectives[k]) + 1.0;
    VectorXd offset = known.objectives - scale;
    offset[to_signed(end)] = known.objectives[to_signed(end)];
    scale[to_signed(end)] *= kGiven;
    const std::vector<Scenario> scenarios = objectives_.scaled(offset, scale);
    const OptimizationResult found = objectives_.search(known.rho, scenarios);
    TradeoffPoint point;
    point.place = known.place;
    point.is_anchor = true;
    take_search(found, &point);
    result_.cost += point.cost;
    const double gain =
        found.status.ok() && found.best.values.size() > 0 ? 1.0 - found.best.objective : 0.0;
    if (gain < kGainForEnds) return false;
    objectives_.take_values(scenarios, found.best.values, &point);
    point.kind =
        is_success(point.termination) ? TradeoffKind::kOnCurve : TradeoffKind::kStoppedEarly;
    known = std::move(point);
    return gain > kOtherRange;
  }

  bool has_conflict() {
    for (std::size_t k = 0; k < count(); ++k) {
      const auto i = to_signed(k);
      if (is_range(i)) continue;
      const TradeoffObjective& objective = study_of(problem_).tradeoff[k];
      append({warn("no_tradeoff",
                   {objective.where, "tradeoff[" + std::to_string(k) + "]",
                    "the objective is the same at the least of each other one, so that there is "
                    "nothing to trade",
                    readable(result_.nadir[i]), "objectives that differ in their best designs"})},
             &result_.warnings);
      range_.resize(0);  // no units to compare points in
      return false;
    }
    return true;
  }

  /// The objectives in the units of theory (24m).
  std::vector<Scenario> scenarios_at(const VectorXd& place) const {
    return objectives_.scaled(anchors_ * place - range_, range_);
  }

  /// @param starts tried one after the other, until a search ends at a stationary point; else the
  /// best of them counts.
  TradeoffPoint find(const VectorXd& place, const std::vector<VectorXd>& starts) const {
    TradeoffPoint best;
    best.place = place;
    std::optional<std::pair<bool, double>> rank;
    const std::vector<Scenario> scenarios = scenarios_at(place);
    SearchCost cost;
    for (const VectorXd& start : starts) {
      const OptimizationResult found = objectives_.search(start, scenarios);
      TradeoffPoint point;
      point.place = place;
      point.cost = cost;
      take_search(found, &point);
      cost = point.cost;
      const bool has_point = found.best.values.size() == to_signed(scenarios.size()) &&
                             found.status.code != StatusCode::kInfeasible;
      if (has_point) objectives_.take_values(scenarios, found.best.values, &point);
      const bool is_end = has_point && found.status.ok() && is_success(found.termination);
      const std::pair<bool, double> now{
          !is_end, has_point ? found.best.objective : std::numeric_limits<double>::infinity()};
      if (!rank || now < *rank) {
        rank = now;
        best = std::move(point);
      }
      if (is_end || is_set(cancel_)) break;
    }
    best.cost = cost;
    return best;
  }

  double distance(const TradeoffPoint& a, const TradeoffPoint& b) const {
    return (a.objectives - b.objectives).cwiseQuotient(range_).norm();
  }

  /// Halves the longest part of the curve between neighbours, again and again.
  void follow_curve() {
    std::vector<std::size_t> order{0, 1};  // along the curve: beta of the first anchor falls
    std::vector<bool> is_shut{false};      // per part: not to be halved
    const double narrowest = kNarrowest / points_;
    while (static_cast<int>(points().size()) < points_ && !is_cancelled()) {
      std::size_t longest = is_shut.size();
      double length = 0.0;
      for (std::size_t k = 0; k < is_shut.size(); ++k) {
        const TradeoffPoint &a = points()[order[k]], &b = points()[order[k + 1]];
        if (is_shut[k] || !(distance(a, b) > length) || a.place[0] - b.place[0] < narrowest)
          continue;
        longest = k;
        length = distance(a, b);
      }
      if (longest == is_shut.size()) return;
      const TradeoffPoint &a = points()[order[longest]], &b = points()[order[longest + 1]];
      if (!keep(find(0.5 * (a.place + b.place), {0.5 * (a.rho + b.rho), a.rho, b.rho}))) return;
      if (points().back().kind == TradeoffKind::kFailed) {
        is_shut[longest] = true;
        continue;
      }
      order.insert(order.begin() + to_signed(longest) + 1, points().size() - 1);
      is_shut.insert(is_shut.begin() + to_signed(longest), false);
    }
  }

  /// Equal steps between the anchors, from the corners inwards by their distance from a point that
  /// is known.
  void fill_triangle() {
    std::vector<VectorXd> places;
    const int steps = points_ - 1;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j)
        if (std::max({i, j, steps - i - j}) < steps)
          places.push_back(Eigen::Vector3d(i, j, steps - i - j) / steps);
    while (!places.empty() && !is_cancelled()) {
      std::size_t next = 0, from = 0;
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t p = 0; p < places.size(); ++p)
        for (std::size_t k = 0; k < points().size(); ++k) {
          const double away = (places[p] - points()[k].place).norm();
          if (points()[k].kind == TradeoffKind::kFailed || !(away < nearest)) continue;
          nearest = away;
          next = p;
          from = k;
        }
      if (!keep(find(places[next], {points()[from].rho, problem_.start()}))) return;
      places.erase(places.begin() + to_signed(next));
    }
  }

  void conclude() {
    std::stable_sort(points().begin(), points().end(),
                     [](const TradeoffPoint& a, const TradeoffPoint& b) {
                       return std::lexicographical_compare(b.place.begin(), b.place.end(),
                                                           a.place.begin(), a.place.end());
                     });
    if (range_.size() == 0) return;
    sort_out(range_, &points());
    if (count() != 2) return;
    const TradeoffPoint* before = nullptr;
    for (const TradeoffPoint& point : points()) {
      if (point.kind > TradeoffKind::kStoppedEarly) continue;
      if (before) {
        const double gap = distance(*before, point);
        result_.smallest_gap = std::fmin(result_.smallest_gap, gap);
        result_.largest_gap = std::fmax(result_.largest_gap, gap);
      }
      before = &point;
    }
  }

  const Problem& problem_;
  const TradeoffObserver& observer_;
  const std::atomic<bool>* cancel_;
  TradeoffResult result_;
  const Objectives objectives_;
  int points_ = 0, planned_ = 0;
  Eigen::MatrixXd anchors_;  ///< objectives of the anchors, one per column
  VectorXd range_;           ///< nadir - ideal, once the anchors are known
};

/// Rows of one program are means or worst values.
void require_measure(const Study& study) {
  const RobustOptions robust = study.ensemble.robust_options();
  if (robust.measure == RobustMeasure::kMean || robust.measure == RobustMeasure::kWorst) return;
  throw InputError({robust.where, "robust.measure",
                    "a trade-off over runs or samples is that of their means or of the worst",
                    kRobustMeasureNames[to_index(robust.measure)], "mean, worst"});
}

}  // namespace

void sort_out(const VectorXd& range, std::vector<TradeoffPoint>* points) {
  const auto is_found = [](const TradeoffPoint& point) {
    return point.kind != TradeoffKind::kFailed;
  };
  for (std::size_t k = 0; k < points->size(); ++k) {
    TradeoffPoint& point = (*points)[k];
    if (!is_found(point)) continue;
    for (std::size_t other = 0; other < points->size(); ++other) {
      const TradeoffPoint& than = (*points)[other];
      if (other == k || !is_found(than)) continue;
      const VectorXd worse = (than.objectives - point.objectives).cwiseQuotient(range);
      if (!(worse.maxCoeff() <= kSame)) continue;
      if (worse.minCoeff() < -kSame) {
        point.kind = TradeoffKind::kDominated;
        break;
      }
      if (than.kind != TradeoffKind::kRepeated && (than.is_anchor || other < k) && !point.is_anchor)
        point.kind = TradeoffKind::kRepeated;
    }
  }
}

TradeoffResult find_tradeoff(const Problem& problem, int points, const TradeoffObserver& observer,
                             const std::atomic<bool>* cancel) {
  const Study& study = study_of(problem);
  if (study.tradeoff.empty())
    throw InputError(
        {{study.file, 1},
         "tradeoff",
         "the study has no objectives to trade",
         "",
         "tradeoff: [{name: NAME, objective: {...}}, {name: NAME, objective: {...}}]"});
  require_tuned(study);
  require_measure(study);
  const bool is_curve = study.tradeoff.size() == 2;
  const int least = is_curve ? 3 : 2, most = is_curve ? kMostTradeoffPoints : kMostTradeoffSide;
  if (points != 0 && (points < least || points > most))
    throw InputError({{study.file, 1},
                      "points",
                      is_curve
                          ? "the number of points of the curve is out of range"
                          : "the number of points along a side of the triangle is out of range",
                      std::to_string(points),
                      std::to_string(least) + " to " + std::to_string(most)});
  return Tradeoff(problem, points, observer, cancel).run();
}

}  // namespace codesign
