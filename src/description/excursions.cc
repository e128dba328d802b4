// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/excursions.h"

#include <algorithm>
#include <cmath>

#include "description/formula.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"

namespace codesign {
namespace {

constexpr int kSamples = 16384;
constexpr double kHeight = 1e-3;  // of the range
constexpr double kWidth = 0.2;    // of the interval; a stage of a step falls into wider ones
constexpr int kHalvings = 20;     // of the distance between two samples
constexpr double kJump = 0.1;     // of the height, within the last of them

/// Samples at the ends of `kSamples` equal intervals; one that is no number is as the one before.
class Samples {
 public:
  Samples(const std::function<double(double)>& function, double duration)
      : function_(function), step_(duration / kSamples) {
    for (int k = 0; k <= kSamples; ++k) {
      const double value = function(k * step_);
      values_.push_back(std::isfinite(value) || values_.empty() ? value : values_.back());
    }
  }

  double operator[](int k) const { return values_[to_index(k)]; }
  double range() const {
    const auto [low, high] = std::minmax_element(values_.begin(), values_.end());
    return *high - *low;
  }

  /// The indices of the extrema that differ by more than `least` from the ones beside them, in turn
  /// maxima and minima, between the first and the last sample.
  std::vector<int> extrema(double least) const {
    std::vector<int> turns{0};
    int best = 0;
    double sign = 0.0;
    for (int k = 1; k <= kSamples; ++k) {
      const double change = (*this)[k] - (*this)[best];
      if (sign == 0.0 ? std::abs(change) > least : sign * change > 0.0) {
        sign = change > 0.0 ? 1.0 : -1.0;
        best = k;
      } else if (sign * change < -least) {
        turns.push_back(best);
        best = k;
        sign = -sign;
      }
    }
    turns.push_back(best);
    return turns;
  }

  struct Crossing {
    double time;
    bool is_jump;
  };
  /// Where the function has the value `level` between the extremum `from` and the sample `to`, or
  /// jumps over it.
  Crossing crossing(int from, int to, double level) const {
    const int step = to > from ? 1 : -1;
    const bool above = (*this)[from] > level;
    int k = from;
    while (k != to && ((*this)[k] > level) == above) k += step;
    double inside = (k - step) * step_, outside = k * step_;
    for (int halving = 0; halving < kHalvings; ++halving) {
      const double middle = 0.5 * (inside + outside);
      ((function_(middle) > level) == above ? inside : outside) = middle;
    }
    const double height = std::abs((*this)[from] - level);
    return {0.5 * (inside + outside),
            !(std::abs(function_(outside) - function_(inside)) <= kJump * height)};
  }

 private:
  const std::function<double(double)>& function_;
  const double step_;
  std::vector<double> values_;
};

/// The start values, changed by a tenth of the extent of each tuned parameter.
std::vector<double> beside_start(const MotionStudy& study) {
  std::vector<double> values = start_parameters(study);
  for (const int index : study.tuned) {
    const Parameter& parameter = study.parameters[to_index(index)];
    values[to_index(index)] += 0.1 * extent(parameter, parameter.value);
  }
  return values;
}

void add_excursions(const TimeExpression& expression, const std::vector<double>& parameters,
                    double duration, std::vector<double>* instants) {
  const std::vector<int>& used = expression.formula->dependencies();
  std::vector<double> numbers(used.size());
  const auto function = [&](double t) {
    for (std::size_t k = 0; k < used.size(); ++k)
      numbers[k] = used[k] == expression.time ? t : parameters[to_index(used[k])];
    return evaluate_formula<double>(expression.formula->steps(), numbers);
  };
  const std::vector<double> found = excursions_of(function, duration);
  instants->insert(instants->end(), found.begin(), found.end());
}

}  // namespace

std::vector<double> excursions_of(const std::function<double(double)>& function, double duration) {
  const Samples samples(function, duration);
  const double range = samples.range();
  if (!(range > 0.0)) return {};
  std::vector<double> instants;
  const std::vector<int> turns = samples.extrema(kHeight * range);
  for (std::size_t k = 1; k + 1 < turns.size(); ++k) {
    const double here = samples[turns[k]], before = here - samples[turns[k - 1]],
                 after = here - samples[turns[k + 1]];
    const double level = here - 0.5 * (std::abs(before) < std::abs(after) ? before : after);
    const Samples::Crossing begin = samples.crossing(turns[k], turns[k - 1], level),
                            end = samples.crossing(turns[k], turns[k + 1], level);
    if (!(end.time - begin.time < kWidth * duration)) continue;
    instants.push_back(0.5 * (begin.time + end.time));
    // A jump has a switch, which is located to rounding and moves with the design; a step that
    // ended beside it would hide that.
    for (const Samples::Crossing& edge : {begin, end})
      if (!edge.is_jump) instants.push_back(edge.time);
  }
  return instants;
}

std::vector<double> find_excursions(const MotionStudy& study) {
  std::vector<double> instants;
  const std::function<void(const ReferenceDescription&)> look =
      [&](const ReferenceDescription& reference) {
        if (reference.kind == ReferenceDescription::Kind::kLive) look(*reference.live.planned);
        if (reference.kind == ReferenceDescription::Kind::kIntegral) look(*reference.integral.rate);
        if (reference.kind != ReferenceDescription::Kind::kExpression) return;
        const std::vector<int>& used = reference.expression.formula->dependencies();
        const bool is_tuned = std::any_of(study.tuned.begin(), study.tuned.end(), [&](int index) {
          return std::find(used.begin(), used.end(), index) != used.end();
        });
        add_excursions(reference.expression, start_parameters(study), study.duration, &instants);
        if (is_tuned)
          add_excursions(reference.expression, beside_start(study), study.duration, &instants);
      };
  if (study.postures == 0) visit_functions(study, look);
  // The same instant is found several times, to the last halving.
  std::sort(instants.begin(), instants.end());
  const auto same = [&](double a, double b) { return b - a < 0.1 * study.duration / kSamples; };
  instants.erase(std::unique(instants.begin(), instants.end(), same), instants.end());
  return instants;
}

}  // namespace codesign
