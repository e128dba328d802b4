// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/motion/segment_system.h"

#include <algorithm>
#include <utility>

#include "description/excursions.h"
#include "description/study.h"
#include "identification/effort/compared_recordings.h"
#include "math/arrays.h"
#include "mechanism/motor_sides.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// [m/s or rad/s] a segment may begin in any motion, so that no speed indicates an unstable motion.
constexpr double kNoLimit = 1e9;

/// Builds the study of a segment.
class SegmentStudy {
 public:
  SegmentStudy(const CompiledSystem& of, const FitVariables& variables)
      : robot_(of.robot()), study_(of.whole_study()), variables_(variables) {
    study_.initial_state.clear();
    study_.integral.clear();
    study_.terminal.clear();
    study_.watched.clear();
    study_.constraints.clear();
    study_.ensemble = {};
    if (study_.controllers.empty())
      study_.limits.effort = false;  // recorded efforts were really applied, also beyond the limit
    if (!(study_.solver.maximum_speed > 0.0)) study_.solver.maximum_speed = kNoLimit;
    for (Eigen::Index k = 0; k < variables.tuned(); ++k) columns_.push_back(static_cast<int>(k));
  }

  void watch(const MotionOutput& output) {
    const SignalDescription of_joint{
        output.name(),
        {{1.0, output.joint, kMeasuredQuantityNames[to_index(static_cast<int>(output.quantity))],
          ""}},
        {}};
    study_.watched.push_back(
        compared_signal(output.signal ? *output.signal : of_joint, study_.duration));
  }

  void drive(const std::string& joint, std::shared_ptr<const SampledFunction> samples) {
    const EffortSensor sensor = variables_.sensor(joint, variables_.start());
    const FitVariables::SensorColumns columns = variables_.columns(joint);
    ControllerDescription controller;
    controller.name = "recorded effort of " + joint;
    controller.kind = ControllerKind::kStateFeedback;
    controller.output = joint;
    controller.gives_effort = true;
    ReferenceDescription& input = controller.feedforward;
    input.kind = ReferenceDescription::Kind::kSampled;
    input.sampled = {std::move(samples),
                     number(joint + "/effort_scale", sensor.scale, columns.scale),
                     number(joint + "/delay", sensor.delay, columns.delay),
                     number(joint + "/offset", sensor.offset, columns.offset)};
    study_.controllers.push_back(std::move(controller));
  }

  void start(const std::vector<std::string>& independent, const JointRecording& recording) {
    for (const std::string& joint : independent) {
      InitialJointState& initial = study_.initial_state.emplace_back();
      initial.joint = joint;
      initial.position = start_number(
          joint + "/position", recording.find(joint_of_motor(robot_, joint))->position.front());
    }
    for (InitialJointState& initial : study_.initial_state)
      initial.velocity = start_number(initial.joint + "/velocity", 0.0);
  }

  void start_integrals(const CompiledSystem& without) {
    for (const Controller& controller : without.controllers())
      if (controller.state >= 0)
        study_.initial_extra_states.push_back(start_number("integral", 0.0));
  }

  Study& study() { return study_; }
  const std::vector<int>& columns() const { return columns_; }
  int starts() const { return starts_; }

 private:
  Quantity parameter(const std::string& name, double value) {
    const int index = static_cast<int>(study_.parameters.size());
    Parameter& parameter = study_.parameters.emplace_back();
    parameter.name = name;
    parameter.value = value;
    const ExpressionScope scope{[index](const std::string&) { return index; },
                                [name] { return std::vector<std::string>{name}; }};
    return {value, std::make_shared<const Expression>("number", scope)};
  }

  /// A number of a sensor. @param column its entry of x, or -1 for a known one
  Quantity number(const std::string& name, double value, int column) {
    if (column >= 0) {
      study_.tuned.push_back(static_cast<int>(study_.parameters.size()));
      columns_.push_back(column);
    }
    return parameter(name, value);
  }

  Quantity start_number(const std::string& name, double value) {
    study_.tuned.push_back(static_cast<int>(study_.parameters.size()));
    ++starts_;
    return parameter("start of " + name, value);
  }

  const RobotDescription& robot_;
  Study study_;
  const FitVariables& variables_;
  std::vector<int> columns_;
  int starts_ = 0;
};

bool is_driven(const Study& study, const std::string& joint) {
  return has_given_motion(study, joint) ||
         std::any_of(
             study.controllers.begin(), study.controllers.end(),
             [&](const ControllerDescription& controller) { return controller.output == joint; });
}

bool has_velocities(const JointRecording& recording, const std::string& joint) {
  const std::vector<double>& velocity = recording.find(joint)->velocity;
  return std::any_of(velocity.begin(), velocity.end(), [](double number) { return number != 0.0; });
}

bool moves_mass(const CompiledSystem& of, const std::string& joint) {
  const std::vector<JointDescription>& joints = of.robot().joints;
  const auto found = std::find_if(joints.begin(), joints.end(), [&](const JointDescription& other) {
    return other.name == joint;
  });
  return found == joints.end() || of.topology().joint_pair[to_index(found - joints.begin())] >= 0;
}

void refuse_idas(const Study& study) {
  if (study.solver.integrator == IntegratorKind::kIdas)
    throw InputError({study.identification->where, "solver.integrator",
                      "residuals in motion are simulated by Rosenbrock methods only", "idas",
                      "rosenbrock, or residuals in effort"});
}

/// A segment that begins between two samples of a sampled controller would need the controller's
/// held and pending outputs, which are not recorded.
void refuse_sampled(const Study& study) {
  for (const ControllerDescription& controller : study.controllers)
    if (controller.realization.is_sampled())
      throw InputError({controller.where, "controllers." + controller.name + ".sample_time",
                        "residuals in motion are simulated with continuous controllers only",
                        to_decimal(controller.realization.sample_time),
                        "no sample_time, or residuals in effort"});
}

}  // namespace

const std::vector<double>& MotionOutput::recorded(const JointRecording& in) const {
  if (!signal) return in.find(joint)->of(quantity);
  return std::find_if(
             in.signals.begin(), in.signals.end(),
             [this](const SignalSamples& samples) { return samples.signal.text == signal->text; })
      ->values;
}

std::vector<double> SegmentSystem::parameters(const FitVariables& variables,
                                              const Eigen::VectorXd& x,
                                              const Eigen::VectorXd& start) const {
  std::vector<double> all = variables.parameters(x);
  for (const std::string& joint : inputs) {
    const EffortSensor sensor = variables.sensor(joint, x);
    all.insert(all.end(), {sensor.scale, sensor.delay, sensor.offset});
  }
  all.insert(all.end(), start.begin(), start.end());
  return all;
}

std::vector<MotionOutput> motion_outputs(const CompiledSystem& of,
                                         const std::vector<MeasuredJoint>& joints,
                                         const std::vector<JointRecording>& recordings) {
  std::vector<MotionOutput> outputs;
  for (const MeasuredJoint& joint : joints) {
    if (!moves_mass(of, joint.name)) continue;  // for example the frame of a tool
    if (std::any_of(recordings.begin(), recordings.end(), [&](const JointRecording& each) {
          return each.find(joint.name)->is_prescribed;
        }))
      continue;
    outputs.push_back({joint.name, MeasuredQuantity::kPosition});
    if (std::all_of(recordings.begin(), recordings.end(),
                    [&](const JointRecording& each) { return has_velocities(each, joint.name); }))
      outputs.push_back({joint.name, MeasuredQuantity::kVelocity});
    if (joint.with_effort && is_driven(of.whole_study(), joint.name))
      outputs.push_back({joint.name, MeasuredQuantity::kEffort});
  }
  for (const SignalDescription& signal : require_same_signals(recordings))
    outputs.push_back({"", MeasuredQuantity::kPosition, signal});
  return outputs;
}

SegmentSystem make_segment_system(const CompiledSystem& of, const FitVariables& variables,
                                  const std::vector<MeasuredJoint>& joints,
                                  const std::vector<std::string>& independent,
                                  const std::vector<MotionOutput>& outputs,
                                  const JointRecording& recording) {
  refuse_idas(of.whole_study());
  refuse_sampled(of.whole_study());
  SegmentSystem result;
  result.outputs = outputs;
  // Functions of time use the clock of the recording. Where there are none, the times begin at
  // zero, where they are more exact.
  const Study& study = of.whole_study();
  if (study.controllers.empty() && study.motion.empty() && study.loads.empty())
    result.epoch = recording.times.front();
  SegmentStudy segment(of, variables);
  segment.study().duration = recording.times.back() - result.epoch;
  segment.study().excursions = find_excursions(segment.study());
  std::vector<double> times = recording.times;
  for (double& time : times) time -= result.epoch;
  for (const MeasuredJoint& joint : joints) {
    if (!joint.with_effort || !moves_mass(of, joint.name) ||
        is_driven(of.whole_study(), joint.name))
      continue;
    segment.drive(joint.name, std::make_shared<const SampledFunction>(
                                  times, recording.find(joint.name)->effort));
    result.inputs.push_back(joint.name);
  }
  for (const MotionOutput& output : outputs) segment.watch(output);
  segment.start(independent, recording);
  result.system = std::make_shared<const CompiledSystem>(of.robot(), segment.study(), of.sharing());
  segment.start_integrals(*result.system);
  if (!segment.study().initial_extra_states.empty())
    result.system =
        std::make_shared<const CompiledSystem>(of.robot(), segment.study(), of.sharing());
  result.columns = segment.columns();
  result.starts = segment.starts();
  return result;
}

}  // namespace codesign
