// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit_variables.h"

#include "description/tuned_parameters.h"

namespace codesign {
namespace {

void append(double number, Eigen::VectorXd* vector) {
  vector->conservativeResize(vector->size() + 1);
  (*vector)[vector->size() - 1] = number;
}

/// The unit of a joint's coordinate or effort; empty for an unknown joint.
std::string unit_of(const RobotDescription* robot, const std::string& joint, const char* turning, const char* sliding) {
  if (!robot) return "";
  for (const JointDescription& each : robot->joints)
    if (each.name == joint) return each.type == JointType::kPrismatic ? sliding : turning;
  return "";
}

double at(const Eigen::VectorXd& x, int column, double known) { return column < 0 ? known : x[column]; }

}  // namespace

FitVariables::FitVariables(const Study& study, const RobotDescription* robot)
    : study_(study), names_(tuned_names(study)), start_(start_of(study)) {
  for (int k : study.tuned) {
    const Parameter& parameter = study.parameters[static_cast<std::size_t>(k)];
    units_.push_back(parameter.unit);
    append(parameter.lower, &lower_);
    append(parameter.upper, &upper_);
  }
  for (const JointCalibration& joint : study.identification->joints) {
    SensorColumns columns;
    columns.scale = add(joint.joint + "/effort_scale", joint.effort_scale, "");
    columns.delay = add(joint.joint + "/delay", joint.delay, "s");
    columns.offset = add(joint.joint + "/offset", joint.offset, unit_of(robot, joint.joint, "N m", "N"));
    columns_.push_back(columns);
  }
  for (const RecordingDescription& recording : study.identification->data)
    for (const StartPosition& start : recording.starts) {
      const std::string name = recording.element.substr(recording.element.find('.') + 1) + ".start." + start.joint;
      start_columns_.push_back({recording.element, start.joint, add(name, start.position, unit_of(robot, start.joint, "rad", "m"))});
    }
}

int FitVariables::start_column(const std::string& recording, const std::string& joint) const {
  for (const StartColumn& start : start_columns_)
    if (start.recording == recording && start.joint == joint) return start.column;
  return -1;
}

int FitVariables::add(const std::string& name, const FittedNumber& number, const std::string& unit) {
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

std::vector<double> FitVariables::parameters(const Eigen::VectorXd& x) const { return parameters_at(study_, x.head(tuned())); }

FitVariables::SensorColumns FitVariables::columns(const std::string& joint) const {
  const int k = find(joint);
  return k < 0 ? SensorColumns() : columns_[static_cast<std::size_t>(k)];
}

EffortSensor FitVariables::sensor(const std::string& joint, const Eigen::VectorXd& x) const {
  EffortSensor sensor;
  const int k = find(joint);
  if (k < 0) return sensor;
  const JointCalibration& calibration = study_.identification->joints[static_cast<std::size_t>(k)];
  const SensorColumns& columns = columns_[static_cast<std::size_t>(k)];
  sensor.scale = at(x, columns.scale, calibration.effort_scale.value);
  sensor.delay = at(x, columns.delay, calibration.delay.value);
  sensor.offset = at(x, columns.offset, calibration.offset.value);
  sensor.start_scale = calibration.effort_scale.value;
  return sensor;
}

}  // namespace codesign
