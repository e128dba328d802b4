// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <vector>

#include "description/formula.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "math/taylor_quadrature.h"
#include "reading/study/study_blocks.h"
#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Kind = ReferenceDescription::Kind;

/// A position whose velocity jumps asks for an infinite effort: between straight pieces, and where
/// the position is held before the first way-point and after the last.
void refuse_jumps(const ReferenceDescription& function, double duration, const YamlValue& value) {
  if (function.kind != Kind::kWaypoints) return;
  const WaypointsDescription& points = function.waypoints;
  if (points.interpolation == Interpolation::kLinear)
    value.fail(
        "the velocity of a position with linear interpolation jumps at each way-point",
        "interpolation: monotone, quintic or cubic; or `velocity` with linear interpolation");
  if (points.velocities.empty()) return;
  const auto moves = [](const Quantity& velocity) {
    return !velocity.is_constant() || velocity.nominal() != 0.0;
  };
  if ((points.times.front() > 0.0 && moves(points.velocities.front())) ||
      (points.times.back() < duration && moves(points.velocities.back())))
    value.fail(
        "the position is held before the first way-point and after the last, so that its velocity "
        "jumps there",
        "way-points from 0 to the duration of the study, or zero as the first and last velocity");
}

/// A velocity that jumps asks for an infinite effort, too.
void refuse_jumping_velocity(const ReferenceDescription& velocity, const Study& study,
                             const YamlValue& value) {
  if (velocity.kind != Kind::kExpression) return;
  const TimeExpression& expression = velocity.expression;
  const std::vector<double> parameters = start_parameters(study);
  std::vector<double> numbers;
  for (const int used : expression.formula->dependencies())
    numbers.push_back(used == expression.time ? 0.0 : parameters.at(to_index(used)));
  const auto series = [&](double t) {
    return time_series(*expression.formula, expression.time, numbers, t);
  };
  if (const std::optional<double> jump = find_jump(series, study.duration))
    value.fail("the velocity jumps at " + readable(*jump, 6) + " s, which takes an infinite effort",
               "a velocity without jumps, such as way-points with interpolation: linear");
}

/// The position with this velocity, from the start that `initial_state` gives, else from zero.
ReferenceDescription integral_of(ReferenceDescription velocity, const std::string& joint,
                                 const Study& study, const YamlValue& value) {
  refuse_jumping_velocity(velocity, study, value);
  ReferenceDescription position;
  position.integral.duration = study.duration;
  position.kind = Kind::kIntegral;
  position.integral.rate = std::make_shared<const ReferenceDescription>(std::move(velocity));
  for (const InitialJointState& initial : study.initial_state)
    if (initial.joint == joint && initial.position) position.integral.start = *initial.position;
  return position;
}

void refuse_start(const std::string& joint, bool by_velocity, const Study& study,
                  const YamlValue& value) {
  for (const InitialJointState& initial : study.initial_state)
    if (initial.joint == joint &&
        (initial.velocity || initial.guess || (initial.position && !by_velocity)))
      value.fail("the motion of the joint is given, so that initial_state." + joint +
                     " contradicts or repeats it",
                 by_velocity
                     ? "initial_state." + joint + ": {position: ...}, the start of the motion"
                     : "no initial_state." + joint);
}

/// The form that a run gives takes the place of the other one, which only the study gives: its path
/// is not below that of the run.
void replace_other_form(const YamlValue& motion, std::optional<YamlValue>* position,
                        std::optional<YamlValue>* velocity) {
  if (!*position || !*velocity) return;
  const auto is_of_run = [&motion](const YamlValue& form) {
    return form.path().compare(0, motion.path().size(), motion.path()) == 0;
  };
  if (is_of_run(**position) != is_of_run(**velocity))
    (is_of_run(**position) ? velocity : position)->reset();
}

void refuse_controllers(const std::string& joint, const Study& study, const YamlValue& value) {
  for (const ControllerDescription& controller : study.controllers)
    if (controller.output == joint)
      value.fail("the motion of the joint is given, so that the controller \"" + controller.name +
                     "\", which drives it, has no effect on it",
                 "another output of the controller, or no motion of this joint");
}

}  // namespace

void read_motion(const YamlValue& study_value, const RobotDescription& robot,
                 const ParameterTable& table, const TrajectoryLoader& loader, Study* study) {
  const auto motions = study_value.find("motion");
  if (!motions) return;
  for (const auto& [name, value] : motions->entries()) {
    constexpr const char* kForms = "{position: FUNCTION} or {velocity: FUNCTION}";
    if (!value.is_map()) value.fail("a motion must be a map", kForms);
    value.require_keys({}, {"position", "velocity"});
    auto position = value.find("position"), velocity = value.find("velocity");
    replace_other_form(value, &position, &velocity);
    if (position.has_value() == velocity.has_value())
      value.fail("a motion has either a position or a velocity", kForms);
    GivenMotion motion;
    motion.where = value.where();
    motion.joint = scalar_joint(name, robot, value).name;
    refuse_start(name, velocity.has_value(), *study, value);
    refuse_controllers(name, *study, value);
    motion.position = read_reference(position ? *position : *velocity, table, loader);
    if (position)
      refuse_jumps(motion.position, study->duration, *position);
    else
      motion.position = integral_of(std::move(motion.position), name, *study, *velocity);
    study->motion.push_back(std::move(motion));
  }
}

}  // namespace codesign
