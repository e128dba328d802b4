// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/sampled_motion.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "math/arrays.h"
#include "math/dense.h"
#include "math/linear_systems.h"
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

/// A multiple of the queue's length, above every number of a sample that still waits.
std::int64_t first_sample(const ControlRealization& realization) {
  return 2 * static_cast<std::int64_t>(std::max(1, realization.queued()));
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

/// The map of [x | u | w] over one period, w only where a loop is opened.
class PeriodMap {
 public:
  PeriodMap(LinearMotion* motion, const SamplePattern& pattern, int opened)
      : motion_(*motion), pattern_(pattern), opened_(opened) {
    const StateSpace& flow = motion_.flow();
    states_ = flow.A.rows();
    inputs_ = flow.B.cols();
    total_ = states_ + inputs_ + (opened >= 0 ? 1 : 0);
    map_ = Eigen::MatrixXd::Identity(total_, total_);
    rate_ = Eigen::MatrixXd::Zero(total_, total_);
    rate_.topLeftCorner(states_, states_) = flow.A;
    rate_.block(0, states_, states_, inputs_) = flow.B;
    output_.setZero(total_);
  }

  void run() {
    for (std::size_t k = 0; k < pattern_.instants.size(); ++k) {
      cross(pattern_.instants[k].events);
      const bool is_last = k + 1 == pattern_.instants.size();
      const double end = is_last ? pattern_.period : pattern_.instants[k + 1].time;
      flow(end - pattern_.instants[k].time);
    }
    renumber_queues();
  }
  Eigen::MatrixXd columns(Eigen::Index first, Eigen::Index count) const {
    return map_.block(0, first, states_, count);
  }
  Eigen::RowVectorXd output() const { return output_.head(states_); }
  Eigen::Index states() const { return states_; }
  Eigen::Index inputs() const { return inputs_; }

 private:
  void apply(const std::vector<ControlEvent>& events) {
    if (events.empty()) return;
    const Eigen::MatrixXd after = motion_.jump(events);
    Eigen::MatrixXd jump = Eigen::MatrixXd::Identity(total_, total_);
    jump.block(motion_.motions(), 0, after.rows(), after.cols()) = after;
    map_ = product(jump, map_);
  }

  int place_of(const ControlEvent& event) const {
    const auto c = to_index(event.controller);
    const ControllerStates& states = motion_.system().controllers()[c].states;
    const int queued = motion_.system().study().controllers[c].realization.queued();
    return queued == 0 ? states.held : states.queue + static_cast<int>(event.sample % queued);
  }

  void cross(const std::vector<ControlEvent>& events) {
    std::vector<ControlEvent> waiting;
    for (const ControlEvent& event : events) {
      waiting.push_back(event);
      if (event.controller != opened_ || event.kind != ControlEvent::Kind::kSample) continue;
      apply(waiting);
      waiting.clear();
      const Eigen::Index place = motion_.motions() + place_of(event);
      output_ = map_.row(place);
      map_(place, total_ - 1) += 1.0;
    }
    apply(waiting);
  }

  void flow(double time) {
    if (!(time > 0.0)) return;
    const auto known = flows_.find(time);
    if (known == flows_.end()) flows_[time] = matrix_exponential(rate_ * time);
    map_ = product(flows_[time], map_);
  }

  // Sample k writes to place k mod the length; the next period begins with another place.
  void renumber_queues() {
    const System& system = motion_.system();
    for (std::size_t c = 0; c < system.controllers().size(); ++c) {
      const int queued = system.study().controllers[c].realization.queued();
      if (queued == 0) continue;
      const Eigen::Index first = motion_.motions() + system.controllers()[c].states.queue;
      const Eigen::MatrixXd places = map_.middleRows(first, queued);
      for (int k = 0; k < queued; ++k)
        map_.row(first + k) = places.row((k + pattern_.samples[c]) % queued);
    }
  }

  LinearMotion& motion_;
  const SamplePattern& pattern_;
  const int opened_;
  Eigen::Index states_ = 0, inputs_ = 0, total_ = 0;
  Eigen::MatrixXd map_, rate_;
  Eigen::RowVectorXd output_;
  std::map<double, Eigen::MatrixXd> flows_;
};

}  // namespace

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
  if (times.empty()) return pattern;
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

StateSpace sampled_motion(LinearMotion* motion, const SamplePattern& pattern) {
  PeriodMap map(motion, pattern, -1);
  map.run();
  StateSpace result = motion->flow();
  result.period = pattern.period;
  result.A = map.columns(0, map.states());
  result.B = map.columns(map.states(), map.inputs());
  return result;
}

StateSpace sampled_loop(LinearMotion* motion, const SamplePattern& pattern, int controller) {
  PeriodMap map(motion, pattern, controller);
  map.run();
  const std::string& name = motion->system().study().controllers[to_index(controller)].name;
  return {
      pattern.period,     motion->flow().states,        {name + "/disturbance"},
      {name + "/output"}, map.columns(0, map.states()), map.columns(map.states() + map.inputs(), 1),
      map.output(),       Eigen::MatrixXd::Zero(1, 1)};
}

}  // namespace codesign
