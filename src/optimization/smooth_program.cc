// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/smooth_program.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "math/arrays.h"
#include "optimization/lagrangian.h"
#include "sampling/measure.h"
#include "sensitivity/signal_watch.h"

namespace codesign {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// The result of a watched signal before any scenario is added.
WatchedResult describe_bounds(const WatchedSignal& signal, const std::vector<double>& parameters) {
  WatchedResult result;
  result.element = signal.element;
  result.signal = describe(signal);
  if (signal.lower) result.lower = signal.lower->at(parameters);
  if (signal.upper) result.upper = signal.upper->at(parameters);
  result.after = signal.after;
  result.before = signal.before;
  result.smallest = result.initial_smallest = kUnbounded;
  result.largest = result.initial_largest = -kUnbounded;
  return result;
}

/// Extends the ranges of a watched signal, or of its measure, by those of one scenario.
void widen(const WatchLayout::Entry& entry, const Extremes& extremes, const Extremes& initial,
           int scenario, WatchedResult* result) {
  const auto range_of = [&entry](const Eigen::VectorXd& values) {
    return entry.is_measured ? RangePlaces{entry.measure(), entry.measure()}
                             : find_range(entry, values);
  };
  const RangePlaces now = range_of(extremes.values), before = range_of(initial.values);
  if (extremes.values[now.smallest] < result->smallest) {
    result->smallest = extremes.values[now.smallest];
    result->smallest_time = extremes.times[now.smallest];
    result->smallest_scenario = scenario;
  }
  if (extremes.values[now.largest] > result->largest) {
    result->largest = extremes.values[now.largest];
    result->largest_time = extremes.times[now.largest];
    result->largest_scenario = scenario;
  }
  result->initial_smallest = std::min(result->initial_smallest, initial.values[before.smallest]);
  result->initial_largest = std::max(result->initial_largest, initial.values[before.largest]);
}

}  // namespace

SmoothProgram::SmoothProgram(const Ensemble& ensemble)
    : ensemble_(ensemble), slack_(ensemble.options(), ensemble.weights()) {
  const std::vector<Scenario>& scenarios = ensemble.scenarios();
  rows_.reserve(scenarios.size());
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const SignalRows& rows = rows_.emplace_back(scenarios[i].system->whole_study());
    first_.push_back(static_cast<int>(is_free_.size()));
    for (std::size_t k : rows.peaks()) {
      const WatchedSignal::Measure measure = scenarios[i].system->whole_study().watched[k].measure;
      is_free_.push_back(measure == WatchedSignal::Measure::kMaximum ||
                         measure == WatchedSignal::Measure::kMinimum);
    }
    is_free_.insert(is_free_.end(), rows.centres().size(), true);
    const std::vector<WatchedSignal>& watched = scenarios[i].system->whole_study().watched;
    const auto counts = [&](const SignalRow& row) {
      return !scenarios[i].repeats_bounds || is_term(watched[row.watched]);
    };
    for (const SignalRow& row : rows.inequalities())
      if (counts(row)) inequality_places_.push_back({i, &row});
    for (const SignalRow& row : rows.equalities())
      if (counts(row)) equality_places_.push_back({i, &row});
  }
  inequality_rows_ = static_cast<int>(inequality_places_.size());
  equality_rows_ = static_cast<int>(equality_places_.size());
  units_.setOnes(to_signed(is_free_.size()));
}

double SmoothProgram::lower(int slack) const {
  if (slack < slack_.variables()) return slack_.lower(slack);
  return is_free_[to_index(slack - slack_.variables())] ? -kUnbounded : 0.0;
}

bool SmoothProgram::bounds_read(int parameter) const {
  const auto reads = [parameter](const std::optional<Quantity>& bound) {
    if (!bound || bound->is_constant()) return false;
    const std::vector<int>& read = bound->expression()->dependencies();
    return std::find(read.begin(), read.end(), parameter) != read.end();
  };
  const std::vector<WatchedSignal>& watched =
      ensemble_.scenarios().front().system->whole_study().watched;
  return std::any_of(watched.begin(), watched.end(), [&](const WatchedSignal& one) {
    return reads(one.lower) || reads(one.upper) || reads(one.band_lower) || reads(one.band_upper);
  });
}

Eigen::VectorXd SmoothProgram::start(const EnsembleEvaluation& at, double unit) {
  unit_ = unit;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(slacks());
  if (!at.total.status.ok()) return y;
  if (slack_.variables() > 0)
    y.head(slack_.variables()) = slack_.start(at.values, at.threshold) / unit_;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto set = [&](int variable, double value, double size) {
      unit_of(variable) = size > 0.0 ? size : 1.0;
      y[variable] = value / unit_of(variable);
    };
    for (int j = 0; j < static_cast<int>(rows_[i].peaks().size()); ++j) {
      const double peak = rows_[i].peak(j, at.extremes[i]);
      set(peak_variable(i, j), peak, std::abs(peak));
    }
    for (int j = 0; j < static_cast<int>(rows_[i].centres().size()); ++j) {
      const SignalRows::Centre centre = rows_[i].centre(j, at.extremes[i]);
      set(centre_variable(i, j), centre.value, centre.half_range);
    }
  }
  return y;
}

void SmoothProgram::take(const EnsembleEvaluation& all, const Eigen::VectorXd& rho) {
  all_ = &all;
  smooth_values_ = all.values;
  smooth_gradients_ = all.gradients;
  parameters_.clear();
  if (!has_signals()) return;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Scenario& scenario = ensemble_.scenarios()[i];
    parameters_.push_back(scenario.parameters(rho));
    const auto column = to_signed(i);
    for (int j = 0; j < static_cast<int>(rows_[i].peaks().size()); ++j) {
      Eigen::VectorXd of_peak = Eigen::VectorXd::Zero(rho.size());
      const std::size_t watched = rows_[i].peaks()[to_index(j)];
      const double term = watched_term(peak_signal(i, j), rows_[i].layout().entries()[watched],
                                       all.extremes[i], &of_peak);
      smooth_values_[column] -= term / scenario.scale;
      smooth_gradients_.col(column) -= of_peak / scenario.scale;
    }
  }
}

SmoothProgram::Value SmoothProgram::blank() const {
  Value value;
  value.by_rho.setZero(smooth_gradients_.rows());
  value.by_slack.setZero(slacks());
  return value;
}

SmoothProgram::Value SmoothProgram::objective(const Eigen::VectorXd& slack) const {
  Value result = blank();
  if (slack_.variables() > 0) {
    result.value = slack_.objective(slack.head(slack_.variables()));
    result.by_slack.head(slack_.variables()) = slack_.gradient();
    return result;
  }
  Eigen::VectorXd psi = smooth_values_;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (int j = 0; j < static_cast<int>(rows_[i].peaks().size()); ++j)
      psi[to_signed(i)] += unit_ * peak_factor(i, j) * slack[peak_variable(i, j)];
  const Measured measured = measure(ensemble_.options(), psi, ensemble_.weights());
  result.value = measured.value / unit_;
  result.by_rho = smooth_gradients_ * measured.by_value / unit_;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (int j = 0; j < static_cast<int>(rows_[i].peaks().size()); ++j)
      result.by_slack[peak_variable(i, j)] = measured.by_value[to_signed(i)] * peak_factor(i, j);
  return result;
}

const WatchedSignal& SmoothProgram::peak_signal(std::size_t scenario, int peak) const {
  return ensemble_.scenarios()[scenario]
      .system->whole_study()
      .watched[rows_[scenario].peaks()[to_index(peak)]];
}

double SmoothProgram::peak_factor(std::size_t scenario, int peak) const {
  const WatchedSignal& watched = peak_signal(scenario, peak);
  const bool is_stroke = watched.measure == WatchedSignal::Measure::kStroke;
  return (is_stroke ? 2.0 : 1.0) * std::abs(watched.weight) *
         unit_of(peak_variable(scenario, peak)) / (unit_ * ensemble_.scenarios()[scenario].scale);
}

SmoothProgram::Value SmoothProgram::signal_value(const WatchedRow& place) const {
  Value result = blank();
  const SignalRows& rows = rows_[place.scenario];
  const Extremes& extremes = all_->extremes[place.scenario];
  result.value = rows.value(*place.row, extremes, parameters_[place.scenario]);
  for (Eigen::Index k = 0; k < result.by_rho.size(); ++k)
    result.by_rho[k] =
        rows.derivative(*place.row, to_index(k), extremes, parameters_[place.scenario]);
  return result;
}

// psi_i - t - z_i <= 0 for the robust measure, then the rows of signals.
SmoothProgram::Value SmoothProgram::inequality(int row, const Eigen::VectorXd& slack) const {
  if (row >= slack_.constraints()) {
    const WatchedRow& place = inequality_places_[to_index(row - slack_.constraints())];
    Value result = signal_value(place);
    const SignalRow& of = *place.row;
    if (of.centre >= 0) {
      const int variable = centre_variable(place.scenario, of.centre);
      result.by_slack[variable] = -of.sign * unit_of(variable);
    }
    if (of.peak >= 0)
      result.by_slack[peak_variable(place.scenario, of.peak)] =
          -unit_of(peak_variable(place.scenario, of.peak));
    if (of.peak < 0 && of.centre < 0) return result;
    result.value += result.by_slack.dot(slack);
    if (of.peak < 0) return result;
    const double size = unit_of(peak_variable(place.scenario, of.peak));
    result.value /= size;
    result.by_rho /= size;
    result.by_slack /= size;
    return result;
  }
  Value result = blank();
  double psi = 0.0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double share = slack_.share(row, i);
    if (share == 0.0) continue;
    psi += share * smooth_values_[to_signed(i)] / unit_;
    result.by_rho += share * smooth_gradients_.col(to_signed(i)) / unit_;
    for (int j = 0; j < static_cast<int>(rows_[i].peaks().size()); ++j) {
      const double factor = share * peak_factor(i, j);
      result.by_slack[peak_variable(i, j)] = factor;
      psi += factor * slack[peak_variable(i, j)];
    }
  }
  result.value = slack_.constraint(row, psi, slack.head(slack_.variables()));
  for (int k = 0; k < slack_.variables(); ++k) result.by_slack[k] = slack_.by_slack(row, k);
  return result;
}

SmoothProgram::Value SmoothProgram::equality(int row) const {
  return signal_value(equality_places_[to_index(row)]);
}

std::vector<WatchedResult> SmoothProgram::describe(const std::vector<Extremes>& extremes,
                                                   const std::vector<Extremes>& initial,
                                                   const Eigen::VectorXd& rho) const {
  std::vector<WatchedResult> results;
  if (extremes.size() != rows_.size() || initial.size() != rows_.size()) return results;
  Scenario nominal = ensemble_.scenarios().front();
  nominal.values.clear();
  const std::vector<double> parameters = nominal.parameters(rho);
  // Scenarios of different objectives watch the same bounds, and terms of their own.
  std::vector<const WatchedSignal*> watched;
  const auto place_of = [&](const WatchedSignal& signal) {
    const auto is_same = [&signal](const WatchedSignal* other) {
      return other->element == signal.element &&
             codesign::describe(*other) == codesign::describe(signal);
    };
    const auto found = std::find_if(watched.begin(), watched.end(), is_same);
    if (found != watched.end()) return static_cast<std::size_t>(found - watched.begin());
    watched.push_back(&signal);
    results.push_back(describe_bounds(signal, parameters));
    return results.size() - 1;
  };
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::vector<WatchedSignal>& own = ensemble_.scenarios()[i].system->whole_study().watched;
    for (std::size_t k = 0; k < own.size(); ++k) {
      const std::size_t place = place_of(own[k]);
      widen(rows_[i].layout().entries()[k], extremes[i], initial[i], static_cast<int>(i),
            &results[place]);
      results[place].violation =
          std::max(results[place].violation,
                   rows_[i].violation(k, extremes[i], ensemble_.scenarios()[i].parameters(rho)));
    }
  }
  for (std::size_t k = 0; k < results.size(); ++k)
    results[k].tolerance = watched[k]->tolerance.value_or(tolerance_of_range(results[k]));
  return results;
}

double SmoothProgram::violation(const std::vector<Extremes>& extremes,
                                const Eigen::VectorXd& rho) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < extremes.size(); ++i) {
    const std::vector<double> parameters = ensemble_.scenarios()[i].parameters(rho);
    for (std::size_t k = 0; k < rows_[i].layout().entries().size(); ++k)
      largest = std::max(largest, rows_[i].violation(k, extremes[i], parameters));
  }
  return largest;
}

}  // namespace codesign
