// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/run_recorder.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "description/study.h"
#include "elements/design.h"
#include "equations/compiled_system.h"
#include "integration/simulation_of.h"
#include "integration/stop_watch.h"
#include "jobs/csv_writer.h"
#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/shown_signals.h"
#include "jobs/smoothing_watch.h"
#include "math/arrays.h"
#include "math/cpu_timer.h"
#include "mechanism/motor_sides.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kIntervals = 1000;  // even, for Simpson's rule
constexpr int kRowEvery = 2;
constexpr int kPoseEvery = 250;

/// One signal over the run.
struct Watched {
  double smallest = 0.0, smallest_time = 0.0, largest = 0.0, largest_time = 0.0;
  double simpson = 0.0;  ///< sum of values times 1, 4, 2, 4, ..., 1

  void observe(int index, double time, double value) {
    if (index == 0 || value < smallest) smallest = value, smallest_time = time;
    if (index == 0 || value > largest) largest = value, largest_time = time;
    const bool is_end = index == 0 || index == kIntervals;
    simpson += (is_end ? 1.0 : index % 2 == 1 ? 4.0 : 2.0) * value;
  }
  double integral(double duration) const { return simpson * duration / (3.0 * kIntervals); }
};

/// Poses of all links at a few instants.
class PoseLog {
 public:
  void observe(const Frame& frame) {
    times_.push_back(frame.time);
    links_.push_back(frame.links);
  }

  Json json(const std::vector<std::string>& names) const {
    Json links = Json::object();
    for (std::size_t i = 0; i < names.size(); ++i) {
      Json poses = Json::array();
      for (const std::vector<LinkSample>& samples : links_) poses.push_back(pose(samples[i]));
      links[names[i]] = std::move(poses);
    }
    return {{"times", times_}, {"links", links}};
  }

 private:
  static Json pose(const LinkSample& link) {
    const Eigen::Vector3d& p = link.position;
    const Eigen::Quaterniond& q = link.orientation;
    return Json::array({p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()});
  }

  std::vector<double> times_;
  std::vector<std::vector<LinkSample>> links_;
};

Json signal_json(const ShownSignal& shown, const Watched& watched) {
  Json object = {{"name", shown.signal.text},    {"unit", shown.unit},
                 {"smallest", watched.smallest}, {"smallest_time", watched.smallest_time},
                 {"largest", watched.largest},   {"largest_time", watched.largest_time}};
  if (shown.lower) object["lower"] = *shown.lower;
  if (shown.upper) object["upper"] = *shown.upper;
  return object;
}

/// Adds the integrals of the powers among the signals: powers of the mechanism as `energy`,
/// friction of joints as `friction_energy`.
void add_energies(const std::vector<ShownSignal>& shown, const std::vector<Watched>& watched,
                  double duration, Json* summary) {
  Json whole = Json::object(), friction = Json::object();
  const std::string power = "_power";
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const SignalTerm* only = shown[k].unit == "W" ? shown[k].signal.only_term() : nullptr;
    if (!only) continue;
    const SignalTerm& term = *only;
    const double energy = watched[k].integral(duration);
    if (is_of_mechanism(term))
      whole[term.quantity.substr(0, term.quantity.rfind(power))] = energy;
    else if (term.quantity == "friction_power")
      friction[term.object] = energy;
  }
  (*summary)["energy"] = whole;
  (*summary)["friction_energy"] = friction;
}

std::vector<SignalDescription> signals_in(const std::vector<ShownSignal>& shown) {
  std::vector<SignalDescription> signals;
  signals.reserve(shown.size());
  for (const ShownSignal& signal : shown) signals.push_back(signal.signal);
  return signals;
}

}  // namespace

LimitWatch::LimitWatch(const Problem& problem, const std::vector<double>& parameters,
                       const FrameNames& names)
    : LimitWatch(problem, parameters, names, study_of(problem).limits) {}

LimitWatch::LimitWatch(const Problem& problem, const std::vector<double>& parameters,
                       const FrameNames& names, const LimitOptions& enforced) {
  const SolverOptions& solver = study_of(problem).solver;
  for (const JointDescription& joint : robot_of(problem).joints) {
    const auto found = std::find(names.joints.begin(), names.joints.end(), joint.name);
    if (!joint.limit || found == names.joints.end()) continue;
    const auto watch = [&](const char* limit, const Quantity& bound, double least = 0.0) {
      const double at = bound.at(parameters),
                   margin = solver.absolute_tolerance + solver.relative_tolerance * std::abs(at);
      watched_.push_back({to_index(found - names.joints.begin()), joint.name, limit, at,
                          std::max(margin, least), -1});
    };
    if (has_stops(joint)) {
      const double range = joint.limit->upper.at(parameters) - joint.limit->lower.at(parameters),
                   least = enforced.position ? kStopGivesWay * range : 0.0;
      watch("lower", joint.limit->lower, least);
      watch("upper", joint.limit->upper, least);
    }
    if (joint.limit->bounds_velocity()) watch("velocity", joint.limit->velocity);
    // The voltage of a motor is bounded, not its effort.
    if (joint.limit->bounds_effort() && (!enforced.effort || joint.has_winding()))
      watch("effort", joint.limit->effort);
  }
}

void LimitWatch::observe(const Frame& frame) {
  for (Watched& watched : watched_) {
    const JointSample& sample = frame.joints[watched.sample];
    const double margin = watched.margin;
    if (watched.limit == "lower")
      note(&watched, sample.position, sample.position < watched.bound - margin, frame.time);
    if (watched.limit == "upper")
      note(&watched, sample.position, sample.position > watched.bound + margin, frame.time);
    if (watched.limit == "velocity")
      note(&watched, sample.velocity, std::abs(sample.velocity) > watched.bound + margin,
           frame.time);
    if (watched.limit == "effort")
      note(&watched, sample.effort, std::abs(sample.effort) > watched.bound + margin, frame.time);
  }
}

void LimitWatch::observe(const std::vector<StopExcess>& stops) {
  for (const StopExcess& stop : stops)
    for (Watched& watched : watched_)
      if (watched.joint == stop.joint && watched.limit == (stop.is_upper ? "upper" : "lower"))
        note(&watched, stop.worst, true, stop.time);
}

void LimitWatch::note(Watched* watched, double value, bool beyond, double time) {
  if (!beyond) return;
  if (watched->crossing < 0) {
    watched->crossing = static_cast<int>(crossings_.size());
    crossings_.push_back({watched->joint, watched->limit, watched->bound, value, time});
  }
  LimitCrossing& crossing = crossings_[to_index(watched->crossing)];
  const bool position = watched->limit == "lower" || watched->limit == "upper";
  const double excess = position ? std::abs(value - watched->bound) : std::abs(value);
  const double largest =
      position ? std::abs(crossing.worst - watched->bound) : std::abs(crossing.worst);
  if (excess > largest) crossing.worst = value;
  crossing.time = std::min(crossing.time, time);
}

std::string describe(const LimitCrossing& crossing) {
  return "joint '" + crossing.joint + "' exceeds its " + crossing.limit + " limit " +
         readable(crossing.bound) + " from t = " + readable(crossing.time) +
         " s; the worst value is " + readable(crossing.worst);
}

TransitionWatch::TransitionWatch(const Problem& problem, const std::vector<double>& parameters,
                                 const FrameNames& names) {
  const CompiledSystem& system = *system_of(problem);
  const RobotDescription& robot = system.robot();
  Design<double> design;
  design.set(system, parameters);
  const auto watch = [&](const JointDescription& joint, const FrictionDescription& friction,
                         double transition, const char* element) {
    const std::string name = joint_of_motor(robot, joint.name);
    const auto found = std::find(names.joints.begin(), names.joints.end(), name);
    // Bristles stick below their Stribeck velocity.
    if (found == names.joints.end() || friction.model->bristle) return;
    watched_.push_back({to_index(found - names.joints.begin()), &friction,
                        robot.joints[to_index(joint_named(robot, name))].element() + element,
                        transition});
  };
  for (std::size_t p = 0; p < system.topology().pairs.size(); ++p) {
    const Pair& pair = system.topology().pairs[p];
    const PairConstants<double>& numbers = design.constants.pairs[p];
    if (pair.friction_joint >= 0 && pair.friction_is_direct) {
      const JointDescription& joint = robot.joints[to_index(pair.friction_joint)];
      watch(joint, *joint.friction, numbers.friction.transition_velocity, " <codesign:friction>");
    }
    for (std::size_t e = 0; e < pair.chain.size(); ++e) {
      const JointDescription& joint = robot.joints[to_index(pair.chain[e].joint)];
      if (joint.actuator && joint.actuator->gear && joint.motor < 0)
        watch(joint, joint.actuator->gear->slip, numbers.dynamics[e].gear.slip.transition_velocity,
              " <codesign:actuator>");
    }
  }
}

void TransitionWatch::observe(const Frame& frame) {
  for (Watched& watched : watched_)
    watched.fastest = std::max(watched.fastest, std::abs(frame.joints[watched.sample].velocity));
}

Warnings TransitionWatch::warnings() const {
  constexpr double kRest = 1e-6;  // slower joints move by rounding errors
  Warnings all;
  for (const Watched& watched : watched_) {
    const bool rests = watched.fastest <= kRest * watched.transition;
    if (rests || watched.fastest >= watched.transition) continue;
    all.push_back(warn("transition_beyond_motion",
                       {watched.friction->where, watched.element,
                        "the joint never moves as fast as the transition velocity of its friction, "
                        "which acts like viscous friction below it; the fastest motion is " +
                            readable(watched.fastest),
                        to_decimal(watched.transition),
                        "a transition_velocity well below the motion; or model=\"lugre\", which "
                        "sticks"}));
  }
  return all;
}

RunSummary record_run(const Problem& problem, const std::vector<double>& parameters,
                      const std::vector<SignalDescription>& signals, int samples,
                      const RowSink& sink, const std::atomic<bool>* cancel) {
  std::vector<SignalDescription> all = signals;
  for (SignalDescription& torque : SmoothingWatch::signals(problem))
    all.push_back(std::move(torque));
  Simulation simulation = simulation_of(system_of(problem), parameters, all);
  LimitWatch watch(problem, parameters, simulation.names());
  TransitionWatch transitions(problem, parameters, simulation.names());
  SmoothingWatch smoothing(problem, parameters, simulation.names());
  std::vector<double> row;
  const auto observer = [&](const Frame& frame) {
    watch.observe(frame);
    transitions.observe(frame);
    smoothing.observe(frame, signals.size());
    row.assign(1, frame.time);
    row.insert(row.end(), frame.signals.begin(), frame.signals.begin() + to_signed(signals.size()));
    sink(row);
    return true;
  };
  RunSummary summary;
  const int postures = study_of(problem).postures;
  const CpuTimer timer;
  summary.status = codesign::simulate(&simulation, study_of(problem).duration,
                                      postures > 0 ? postures : samples, observer, cancel);
  summary.end = simulation.time();
  summary.statistics = simulation.statistics();
  summary.sample_seconds = std::max(0.0, timer.seconds() - summary.statistics.cpu_seconds);
  summary.methods = simulation.methods();
  summary.events = simulation.events();
  summary.warnings = simulation.warnings();
  if (summary.status.ok()) append(transitions.warnings(), &summary.warnings);
  if (summary.status.ok()) append(smoothing.warnings(), &summary.warnings);
  watch.observe(simulation.stops());
  const Study& study = study_of(problem);
  const bool has_term = std::any_of(study.watched.begin(), study.watched.end(), is_term);
  if (summary.status.ok() && has_objective(study) && !has_term &&
      simulation.time() >= (simulation.has_ended() ? 0.0 : simulation.end()))
    summary.objective = simulation.objective();
  summary.crossings = watch.crossings();
  return summary;
}

std::vector<std::string> column_names(const std::vector<SignalDescription>& signals) {
  std::vector<std::string> names = {"time"};
  for (const SignalDescription& signal : signals) names.push_back(signal.text);
  return names;
}

DesignRecord record_design(const Problem& problem, const std::vector<double>& parameters,
                           const std::atomic<bool>* cancel) {
  const double duration = study_of(problem).duration;
  const std::vector<ShownSignal> shown = shown_signals(problem, parameters);
  const std::vector<SignalDescription> signals = signals_in(shown);
  Simulation simulation = simulation_of(system_of(problem), parameters, signals);
  LimitWatch limits(problem, parameters, simulation.names());
  std::vector<Watched> watched(shown.size());
  const int postures = study_of(problem).postures;
  PoseLog poses;
  std::ostringstream text;
  CsvWriter csv(text, column_names(signals));
  int index = 0;
  const auto observer = [&](const Frame& frame) {
    limits.observe(frame);
    for (std::size_t k = 0; k < shown.size(); ++k)
      watched[k].observe(index, frame.time, frame.signals[k]);
    if (postures > 0 || index % kPoseEvery == 0) poses.observe(frame);
    if (postures > 0 || index % kRowEvery == 0) {
      std::vector<double> row(1, frame.time);
      row.insert(row.end(), frame.signals.begin(), frame.signals.end());
      csv.write(row);
    }
    ++index;
    return true;
  };
  DesignRecord record;
  record.status =
      simulate(&simulation, duration, postures > 0 ? postures : kIntervals + 1, observer, cancel);
  record.csv = text.str();
  record.summary = {{"status", to_json(record.status)}, {"signals", Json::array()}};
  for (std::size_t k = 0; k < shown.size(); ++k)
    record.summary["signals"].push_back(signal_json(shown[k], watched[k]));
  // If the run ends early, the integrals would not cover the whole study.
  if (record.status.ok() && postures == 0)
    add_energies(shown, watched, simulation.time(), &record.summary);
  limits.observe(simulation.stops());
  record.summary["limits_exceeded"] = to_json(limits.crossings());
  record.summary["machine_numbers"] = to_json(machine_numbers_of(problem, parameters));
  add_events(simulation.events(), &record.summary);
  record.summary["poses"] = poses.json(simulation.names().links);
  return record;
}

}  // namespace codesign
