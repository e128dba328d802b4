// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/problem_warnings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "control/reference.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "mechanism/fixed_base.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// Relative to the value, or to its standard deviation if that is larger.
constexpr double kEqual = 1e-6;

/// Whether an expression that is compared with a recording reads a parameter.
bool is_compared(const Study& study, const std::string& name) {
  if (!study.identification) return false;
  const auto reads = [&name](const SignalColumn& column) {
    const SignalFormula* formula = column.signal.formula.get();
    return formula &&
           std::find(formula->names.begin(), formula->names.end(), name) != formula->names.end();
  };
  for (const auto* list : {&study.identification->data, &study.identification->holdout})
    for (const RecordingDescription& recording : *list)
      if (std::any_of(recording.signals.begin(), recording.signals.end(), reads)) return true;
  return false;
}

/// Whether a number of the model, the study or the changes of a run depends on a parameter.
bool is_used(const Study& study, int index) {
  const std::vector<RunDescription>& runs = study.ensemble.runs;
  return study.used_parameters.count(index) > 0 ||
         is_compared(study, study.parameters[to_index(index)].name) ||
         std::any_of(runs.begin(), runs.end(), [index](const RunDescription& run) {
           return run.study && run.study->used_parameters.count(index) > 0;
         });
}

constexpr double kTolerated = 0.1;  // of the range of the way-points
// An extremum is found to about 1e-3 of its distance from the way-points.
constexpr int kSamplesPerInterval = 64;

/// A number with the time at which a function has it.
struct Extremum {
  double value, time;
  bool operator<(const Extremum& other) const { return value < other.value; }
};

/// The smallest and the largest value between the first and the last way-point.
std::pair<Extremum, Extremum> extremes_of(const Reference<double>& function,
                                          const std::vector<double>& times) {
  std::vector<Extremum> samples;
  for (std::size_t k = 0; k + 1 < times.size(); ++k)
    for (int i = 0; i <= kSamplesPerInterval; ++i) {
      const double time = times[k] + (times[k + 1] - times[k]) * i / kSamplesPerInterval;
      samples.push_back({function.at(time).value, time});
    }
  const auto [lowest, highest] = std::minmax_element(samples.begin(), samples.end());
  return {*lowest, *highest};
}

void check(const ReferenceDescription& reference, const std::vector<double>& parameters,
           const SourceLocation& where, const std::string& element, Warnings* warnings) {
  if (reference.kind == ReferenceDescription::Kind::kIntegral)
    return check(*reference.integral.rate, parameters, where, element, warnings);
  if (reference.kind != ReferenceDescription::Kind::kWaypoints) return;
  // One posture that is held is one way-point, without a curve.
  if (reference.waypoints.times.size() < 2) return;
  std::vector<double> positions;
  for (const Quantity& position : reference.waypoints.positions)
    positions.push_back(position.at(parameters));
  const auto [low, high] = std::minmax_element(positions.begin(), positions.end());
  const auto [lowest, highest] =
      extremes_of(Reference<double>(reference, parameters), reference.waypoints.times);
  const double below = *low - lowest.value, above = highest.value - *high;
  // Equal way-points have no range; rounding is not worth a warning.
  const double rounding = 1e-9 * std::max(std::abs(*low), std::abs(*high));
  if (!(std::max(below, above) > kTolerated * (*high - *low) + rounding)) return;
  const Extremum& far = below > above ? lowest : highest;
  append({warn("waypoint_overshoot",
               {where, element,
                "the curve reaches " + readable(far.value) + " at " + readable(far.time) +
                    " s, far beyond its way-points; leave out " +
                    "`interpolation` and velocities that are not needed, which keeps it between "
                    "them, or add way-points",
                readable(far.value), readable(*low) + " to " + readable(*high)})},
         warnings);
}

}  // namespace

Warnings differing_nominals(const Study& study) {
  std::string values, identified;
  SourceLocation where;
  for (const UncertainQuantity& quantity : study.ensemble.uncertain) {
    if (!quantity.is_identified) continue;
    const double nominal = study.parameters[to_index(quantity.parameter)].value,
                 found = quantity.distribution.mean;
    if (std::abs(nominal - found) <= kEqual * std::max(std::abs(found), quantity.spread)) continue;
    values += (values.empty() ? "" : ", ") + quantity.name + " " + readable(nominal);
    identified += (identified.empty() ? "" : ", ") + readable(found);
    where = quantity.where;
  }
  if (values.empty()) return {};
  return {warn("nominal_differs", {where, "uncertain.from",
                                   "samples lie around the identified values, but nominal runs use "
                                   "other values; give identified_overlay.urdf as an overlay",
                                   values, identified})};
}

Warnings fixed_base(const RobotDescription& robot, const Study& study) {
  if (study.base_is_given || is_on_ground(robot)) return {};
  const double mass = mass_of_base(robot);
  if (!(mass > 0.0)) return {};
  const LinkDescription& root = robot.links[to_index(robot.root)];
  return {
      warn("fixed_base",
           {root.where, "<link name=\"" + root.name + "\">",
            "the root link is the ground, so that its mass, with what is fixed to it, does "
            "nothing; if the base moves (a drone, a walking robot), write base: floating in the "
            "study, or --base floating on the command line; if it stands, write base: fixed to "
            "silence this",
            readable(mass, 6) + " kg", "base: floating or base: fixed"})};
}

Warnings unused_parameters(const Study& study) {
  Warnings warnings;
  for (int index : study.tuned) {
    if (is_used(study, index)) continue;
    const Parameter& parameter = study.parameters[to_index(index)];
    warnings.push_back(
        warn("unused_parameter",
             {parameter.where, "parameter " + parameter.name,
              "nothing in the model or the study depends on this parameter, which is to be tuned; "
              "write ${" +
                  parameter.name + "} where it belongs, or take it out of the study's parameters",
              "", ""}));
  }
  for (const UncertainQuantity& quantity : study.ensemble.uncertain) {
    if (quantity.parameter < 0 || is_used(study, quantity.parameter)) continue;
    warnings.push_back(
        warn("unused_parameter",
             {quantity.where, "uncertain." + quantity.name,
              "nothing in the model or the study depends on this parameter, so all its samples are "
              "alike; write ${" +
                  quantity.name + "} where it belongs, or take it out of uncertain",
              "", ""}));
  }
  return warnings;
}

Warnings waypoint_overshoots(const Study& study) {
  Warnings warnings;
  const std::vector<double> parameters = start_parameters(study);
  const auto look_at = [&](const ReferenceDescription& reference, const SourceLocation& where,
                           const std::string& element) {
    check(reference, parameters, where, element, &warnings);
  };
  for (const ControllerDescription& controller : study.controllers) {
    const std::string element = "controllers." + controller.name;
    look_at(controller.setpoint, controller.where, element + ".setpoint");
    look_at(controller.feedforward, controller.where, element + ".feedforward");
    for (const FeedbackTerm& term : controller.feedback)
      look_at(term.reference, controller.where, element + ".feedback");
  }
  for (const GivenMotion& motion : study.motion)
    look_at(motion.position, motion.where, "motion." + motion.joint);
  for (const ObjectiveTerm& term : study.integral)
    look_at(term.reference, term.signal.where, "objective.integral");
  for (const ObjectiveTerm& term : study.terminal)
    look_at(term.reference, term.signal.where, "objective.terminal");
  for (const WatchedSignal& watched : study.watched)
    look_at(watched.reference, watched.where, watched.element + ".reference");
  for (const RunDescription& run : study.ensemble.runs)
    if (run.study) append(waypoint_overshoots(*run.study), &warnings);
  return warnings;
}

}  // namespace codesign
