// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "equations/compiled_system.h"
#include "integration/step_points.h"
#include "sensitivity/signal_watch.h"

namespace codesign {
namespace {

// Pieces of a step, at whose ends slopes are computed: at least so many, and so many in the
// duration of the study; more where show_turns() asks for them.
constexpr int kLeastPieces = 4, kPiecesPerStudy = 512;

/// How often a signal turns round, but for what is tiny beside it: a bound that holds it makes it
/// constant within the tolerances.
template <class Samples>
int turns_of(const Samples& samples) {
  constexpr double kTiny = 1e-6;
  double size = 0.0;
  for (const auto& sample : samples) size = std::max(size, std::abs(sample.value));
  int turns = 0;
  std::size_t last = 0;  // the sample at which it turned last
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (!(samples[i].slope * samples[i - 1].slope < 0.0)) continue;
    if (std::abs(samples[i].value - samples[last].value) > kTiny * size) ++turns;
    last = i;
  }
  return turns;
}

}  // namespace

/// Sets points_ to the ends of the pieces between `begin` and `end` and to the instants there, and
/// samples_ to `begin` and to them, taken inside of the step.
void SignalWatch::take_pieces(std::size_t k, const StepSpan& step, double begin, double end) {
  const std::vector<double>& instants = layout_.entries()[k].instants;
  const auto inside = [&](double time) {
    return std::min(std::max(time, step.from + step.slack), step.to - step.slack);
  };
  int pieces =
      step_parts((step.to - step.from) / system_.study().duration, kLeastPieces, kPiecesPerStudy);
  for (bool is_resolved = false; !is_resolved && status_.ok(); pieces *= 2) {
    points_.clear();
    for (int piece = 1; piece < pieces; ++piece)
      points_.push_back(step.from + (step.to - step.from) * piece / pieces);
    for (std::size_t i = curves_[k].next; i < instants.size() && instants[i] <= end + step.slack;
         ++i)
      points_.push_back(std::min(instants[i], end));
    points_.erase(std::remove_if(points_.begin(), points_.end(),
                                 [&](double t) { return t < begin || t > end; }),
                  points_.end());
    points_.push_back(end);
    std::sort(points_.begin(), points_.end());
    samples_.assign(1, sample(k, inside(begin)));
    for (const double point : points_) samples_.push_back(sample(k, inside(point)));
    is_resolved = show_turns(pieces, turns_of(samples_)) || 2 * pieces > kMostStepParts;
  }
}

}  // namespace codesign
