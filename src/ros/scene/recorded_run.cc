// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/recorded_run.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "integration/simulation_of.h"
#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "observation/observer.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// Limit for the frames of all runs of a job [bytes].
constexpr double kMostMemory = 256e6;

double bytes_of_a_frame(const RobotDescription& robot, const Study& study) {
  const std::size_t pairs = robot.joints.size();
  return static_cast<double>(
      sizeof(Frame) + pairs * (sizeof(JointSample) + sizeof(FrictionSample) + sizeof(double)) +
      robot.links.size() * sizeof(LinkSample) +
      study.controllers.size() * sizeof(ControllerSample) +
      signals_of(study).size() * sizeof(double));
}

/// The link at which something that acts on a joint or link is shown; 0, the root, if none is.
std::size_t link_of(const std::string& object, const FrameNames& names,
                    const RobotDescription& robot) {
  std::string link = object;
  for (const JointDescription& joint : robot.joints)
    if (joint.name == object) link = robot.links[to_index(joint.child)].name;
  const auto found = std::find(names.links.begin(), names.links.end(), link);
  return found == names.links.end() ? 0 : to_index(found - names.links.begin());
}

}  // namespace

void check_recording(const Problem& problem, double rate, const std::string& element) {
  const double duration = study_of(problem).duration;
  if (duration > kLongestRun)
    throw InputError({{study_of(problem).file, 0},
                      "duration",
                      "the run is longer than ROS time can represent",
                      to_decimal(duration),
                      "at most " + to_decimal(kLongestRun) + " s"});
  const double runs = study_of(problem).ensemble.is_ensemble() ? 4.0 : 2.0;
  const double most = kMostMemory / (runs * bytes_of_a_frame(robot_of(problem), study_of(problem)));
  if (!(duration * rate <= most))
    throw InputError(
        {{element, 0},
         "rate",
         "a run of " + to_decimal(duration) + " s has too many samples to keep in memory",
         to_decimal(rate),
         "at most " + to_decimal(std::floor(1e3 * most / duration) / 1e3) + " samples per second"});
}

RecordedRun record_run(const std::shared_ptr<const CompiledSystem>& system,
                       const std::vector<double>& parameters, double rate,
                       const std::function<bool()>& stop) {
  RecordedRun run;
  Simulation simulation = simulation_of(system, parameters, signals_of(system->whole_study()));
  run.names = simulation.names();
  run.link_parents = link_parents(system->robot());
  double duration = system->whole_study().duration;
  const auto stopped = [&stop] { return stop && stop(); };
  run.status = simulation.start();
  if (run.status.ok()) run.status = find_end(&simulation, &duration);
  const auto count = std::max<std::int64_t>(std::llround(duration * rate), 1);
  for (std::int64_t k = 0; run.status.ok() && k <= count; ++k) {
    const auto instant = [&](std::int64_t index) {
      return duration * static_cast<double>(index) / static_cast<double>(count);
    };
    if (k > 0) run.status = advance(&simulation, instant(k - 1), instant(k), stopped);
    if (!run.status.ok()) break;
    run.frames.emplace_back();
    simulation.sample(instant(k), &run.frames.back());
  }
  for (const Event& event : simulation.events().list)
    run.events.push_back({event, link_of(event.object, run.names, system->robot())});
  return run;
}

}  // namespace codesign
