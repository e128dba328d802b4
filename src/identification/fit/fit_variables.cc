// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/fit_variables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "mechanism/mass_properties.h"

namespace codesign {
namespace {

void append(double number, Eigen::VectorXd* vector) {
  vector->conservativeResize(vector->size() + 1);
  (*vector)[vector->size() - 1] = number;
}

/// The unit of a joint's coordinate or effort; empty for an unknown joint.
std::string unit_of(const RobotDescription* robot, const std::string& joint, const char* turning,
                    const char* sliding) {
  if (!robot) return "";
  for (const JointDescription& each : robot->joints)
    if (each.name == joint) return each.is_slide() ? sliding : turning;
  return "";
}

/// Of the divergence of free inertias, as a share of one residual. A minimum on the border of the
/// possible inertias costs at most four times as much per link.
constexpr double kWeakPrior = 0.05;

/// The relative deviation that the study states of a name; infinite if it states none.
double stated(const std::vector<PriorDescription>& priors, const std::string& name) {
  const auto found =
      std::find_if(priors.begin(), priors.end(),
                   [&name](const PriorDescription& prior) { return prior.parameter == name; });
  return found == priors.end() ? std::numeric_limits<double>::infinity() : found->deviation;
}

double at(const Eigen::VectorXd& x, int column, double known) {
  return column < 0 ? known : x[column];
}

}  // namespace

EffortResidual effort_residual(const EffortSensor& sensor, const RecordedEffort& recorded,
                               double time, double effort) {
  const RecordedEffort::Sample r = recorded.at(time + sensor.delay);
  EffortResidual residual;
  residual.by_effort = sensor.start_scale / sensor.scale;
  residual.value = residual.by_effort * (effort + sensor.offset) - sensor.start_scale * r.value;
  residual.by_scale = -residual.by_effort * (effort + sensor.offset) / sensor.scale;
  residual.by_delay = -sensor.start_scale * r.slope;
  return residual;
}

FitVariables::FitVariables(const Study& study, const RobotDescription* robot,
                           std::vector<RecordedSetting> settings)
    : study_(study),
      settings_(std::move(settings)),
      names_(tuned_names(study)),
      start_(start_of(study)) {
  for (int k : study.tuned) {
    const Parameter& parameter = study.parameters[to_index(k)];
    units_.push_back(parameter.unit);
    append(parameter.lower, &lower_);
    append(parameter.upper, &upper_);
  }
  for (const JointCalibration& joint : study.identification->joints) {
    SensorColumns columns;
    columns.scale = add(joint.joint + "/effort_scale", joint.effort_scale, "");
    columns.delay = add(joint.joint + "/delay", joint.delay, "s");
    columns.offset =
        add(joint.joint + "/offset", joint.offset, unit_of(robot, joint.joint, "N m", "N"));
    columns_.push_back(columns);
  }
  for (const RecordingDescription& recording : study.identification->data)
    for (const StartPosition& start : recording.starts) {
      const std::string name =
          recording.element.substr(recording.element.find('.') + 1) + ".start." + start.joint;
      start_columns_.push_back(
          {recording.element, start.joint,
           add(name, start.position, unit_of(robot, start.joint, "rad", "m"))});
    }
}

int FitVariables::start_column(const std::string& recording, const std::string& joint) const {
  for (const StartColumn& start : start_columns_)
    if (start.recording == recording && start.joint == joint) return start.column;
  return -1;
}

int FitVariables::add(const std::string& name, const FittedNumber& number,
                      const std::string& unit) {
  if (!number.is_fitted) return -1;
  names_.push_back(name);
  units_.push_back(unit);
  append(number.value, &start_);
  append(number.lower, &lower_);
  append(number.upper, &upper_);
  return static_cast<int>(start_.size()) - 1;
}

int FitVariables::find(const std::string& joint) const {
  const std::vector<JointCalibration>& joints = study_.identification->joints;
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (joints[k].joint == joint) return static_cast<int>(k);
  return -1;
}

std::vector<double> FitVariables::parameters(const Eigen::VectorXd& x) const {
  std::vector<double> parameters = parameters_at(study_, x.head(tuned()));
  for (const RecordedSetting& setting : settings_)
    parameters[to_index(setting.parameter)] = setting.value;
  return parameters;
}

FitPrior FitVariables::prior() const {
  const std::vector<PriorDescription>& priors = study_.identification->priors;
  FitPrior prior;
  Eigen::VectorXd deviations =
      Eigen::VectorXd::Constant(size(), std::numeric_limits<double>::infinity());
  for (Eigen::Index k = 0; k < tuned(); ++k)
    if (start_[k] != 0.0) deviations[k] = stated(priors, names_[to_index(k)]) * std::abs(start_[k]);
  if (deviations.array().isFinite().any()) {
    prior.deviations = deviations;
    prior.known = start_;
  }
  for (const auto& [link, columns] : free_inertias(names_))
    prior.inertias.push_back({columns, RelativeInertia(start_(columns)), kWeakPrior,
                              stated(priors, kFreeInertiaParts[0]),
                              stated(priors, kFreeInertiaParts[1]),
                              stated(priors, kFreeInertiaParts[2])});
  return prior;
}

FitVariables::SensorColumns FitVariables::columns(const std::string& joint) const {
  const int k = find(joint);
  return k < 0 ? SensorColumns() : columns_[to_index(k)];
}

EffortSensor FitVariables::sensor(const std::string& joint, const Eigen::VectorXd& x) const {
  EffortSensor sensor;
  const int k = find(joint);
  if (k < 0) return sensor;
  const JointCalibration& calibration = study_.identification->joints[to_index(k)];
  const SensorColumns& columns = columns_[to_index(k)];
  sensor.scale = at(x, columns.scale, calibration.effort_scale.value);
  sensor.delay = at(x, columns.delay, calibration.delay.value);
  sensor.offset = at(x, columns.offset, calibration.offset.value);
  sensor.start_scale = calibration.effort_scale.value;
  return sensor;
}

std::vector<std::pair<std::string, std::array<int, 10>>> free_inertias(
    const std::vector<std::string>& names) {
  std::vector<std::pair<std::string, std::array<int, 10>>> found;
  const std::string first = std::string("_") + kLogCholeskyNames[0];
  for (const std::string& name : names) {
    if (name.size() <= first.size() ||
        name.compare(name.size() - first.size(), first.size(), first) != 0)
      continue;
    const std::string link = name.substr(0, name.size() - first.size());
    std::array<int, 10> columns{};
    bool is_whole = true;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto place = std::find(names.begin(), names.end(), link + "_" + kLogCholeskyNames[k]);
      is_whole = is_whole && place != names.end();
      columns[k] = static_cast<int>(place - names.begin());
    }
    if (is_whole) found.emplace_back(link, columns);
  }
  return found;
}

}  // namespace codesign
