// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/sampled_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linear/period_map.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kMostSamples = 10000;
constexpr double kSame = 1e-9;  // of a sample time

/// The number of samples of `longest` in the common period.
int common_samples(const std::vector<double>& times, double longest) {
  for (int count = 1; count <= kMostSamples; ++count) {
    const double period = count * longest;
    if (std::all_of(times.begin(), times.end(), [&](double time) {
          const double samples = period / time;
          return std::abs(samples - std::round(samples)) <= kSame * samples;
        }))
      return count;
  }
  return 0;
}

class PatternWriter {
 public:
  explicit PatternWriter(double period) : period_(period) {}

  void add(double time, const ControlEvent& event, double sample_time) {
    if (time >= period_ - kSame * sample_time) return;
    for (SamplePattern::Instant& instant : instants_)
      if (std::abs(instant.time - time) <= kSame * sample_time) {
        instant.events.push_back(event);
        return;
      }
    instants_.push_back({std::max(0.0, time), {event}});
  }

  // As ControlClock: outputs come into effect before samples of the same instant.
  std::vector<SamplePattern::Instant> sorted() {
    std::sort(instants_.begin(), instants_.end(),
              [](const auto& one, const auto& other) { return one.time < other.time; });
    for (SamplePattern::Instant& instant : instants_)
      std::stable_partition(instant.events.begin(), instant.events.end(), [](const auto& event) {
        return event.kind == ControlEvent::Kind::kApply;
      });
    return std::move(instants_);
  }

 private:
  double period_;
  std::vector<SamplePattern::Instant> instants_;
};

void add_events(int controller, const ControlRealization& realization, int samples,
                PatternWriter* writer) {
  const double time = realization.sample_time;
  const std::int64_t first = first_sample(realization);
  for (int k = 0; k < samples; ++k)
    writer->add(time * k, {ControlEvent::Kind::kSample, controller, first + k}, time);
  if (!(realization.delay > 0.0)) return;
  for (int k = -realization.queued(); k < samples; ++k) {
    const double at = time * k + realization.delay;
    if (at >= -kSame * time)
      writer->add(at, {ControlEvent::Kind::kApply, controller, first + k}, time);
  }
}

}  // namespace

std::int64_t first_sample(const ControlRealization& realization) {
  return 2 * static_cast<std::int64_t>(std::max(1, realization.queued()));
}

SamplePattern sample_pattern(const MotionStudy& study) {
  SamplePattern pattern;
  std::vector<double> times;
  const ControllerDescription* slowest = nullptr;
  for (const ControllerDescription& controller : study.controllers) {
    if (!controller.realization.is_sampled()) continue;
    times.push_back(controller.realization.sample_time);
    if (!slowest || times.back() > slowest->realization.sample_time) slowest = &controller;
  }
  pattern.samples.assign(study.controllers.size(), 0);
  if (!slowest) return pattern;
  const double longest = slowest->realization.sample_time;
  const int count = common_samples(times, longest);
  if (count == 0)
    throw InputError({slowest->where, "controllers." + slowest->name + ".sample_time",
                      "the sample times of the study have no common period, over which poles of "
                      "sampled loops are defined",
                      to_decimal(longest),
                      "sample times with a common multiple within " + std::to_string(kMostSamples) +
                          " samples"});
  pattern.period = count * longest;
  PatternWriter writer(pattern.period);
  for (std::size_t c = 0; c < study.controllers.size(); ++c) {
    const ControlRealization& realization = study.controllers[c].realization;
    if (!realization.is_sampled()) continue;
    pattern.samples[c] = static_cast<int>(std::round(pattern.period / realization.sample_time));
    add_events(static_cast<int>(c), realization, pattern.samples[c], &writer);
  }
  pattern.instants = writer.sorted();
  return pattern;
}

namespace {

PeriodMap<double> period_map(LinearMotion* motion, const SamplePattern& pattern, int opened) {
  const StateSpace& flow = motion->flow();
  return {flow.A,
          flow.B,
          motion->system(),
          motion->motions(),
          pattern,
          opened,
          [motion](const std::vector<ControlEvent>& events) { return motion->jump(events); }};
}

}  // namespace

StateSpace sampled_motion(LinearMotion* motion, const SamplePattern& pattern) {
  const PeriodMap<double> map = period_map(motion, pattern, -1);
  StateSpace result = motion->flow();
  result.period = pattern.period;
  result.A = map.by_states();
  result.B = map.by_inputs();
  return result;
}

StateSpace sampled_loop(LinearMotion* motion, const SamplePattern& pattern, int controller) {
  const PeriodMap<double> map = period_map(motion, pattern, controller);
  const std::string& name = motion->system().study().controllers[to_index(controller)].name;
  const auto samples = to_index(pattern.samples[to_index(controller)]);
  return {pattern.period,
          motion->flow().states,
          std::vector<std::string>(samples, name + "/disturbance"),
          std::vector<std::string>(samples, name + "/output"),
          map.by_states(),
          map.by_opened(),
          map.output(),
          map.direct()};
}

namespace {

/// Adds a piece, or a place of one alike.
void add_piece(PeriodPiece piece, double alike, PeriodPieces* pieces) {
  for (const PeriodPiece& other : pieces->different)
    if (std::abs(other.time - piece.time) <= alike) piece.time = other.time;
  const auto found = std::find_if(pieces->different.begin(), pieces->different.end(),
                                  [&piece](const PeriodPiece& other) {
                                    return other.time == piece.time && other.jump == piece.jump;
                                  });
  pieces->order.push_back(static_cast<int>(found - pieces->different.begin()));
  if (found == pieces->different.end()) pieces->different.push_back(std::move(piece));
}

}  // namespace

PeriodPieces period_pieces(
    const System& system, Eigen::Index motions, Eigen::Index states, const SamplePattern& pattern,
    const std::function<Eigen::MatrixXcd(const std::vector<ControlEvent>&)>& jump) {
  constexpr double kRounding = 1e-14;  // of the period
  const double alike = kRounding * pattern.period;
  const Eigen::MatrixXcd unit = Eigen::MatrixXcd::Identity(states, states + 1);
  PeriodPieces pieces;
  for (std::size_t k = 0; k < pattern.instants.size(); ++k) {
    const bool is_last = k + 1 == pattern.instants.size();
    PeriodPiece piece{
        unit, (is_last ? pattern.period : pattern.instants[k + 1].time) - pattern.instants[k].time};
    piece.jump.bottomRows(states - motions) = jump(pattern.instants[k].events);
    add_piece(std::move(piece), alike, &pieces);
  }
  PeriodPiece end{unit, 0.0};
  renumber_queues(system, pattern, motions, &end.jump);
  if (end.jump != unit) add_piece(std::move(end), alike, &pieces);
  return pieces;
}

}  // namespace codesign
