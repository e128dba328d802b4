// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/linear_study.h"

#include <complex>
#include <memory>
#include <utility>

#include "control/reference.h"

namespace codesign {
namespace {

/// Adds inputs to a study, one named parameter each.
class InputWriter {
 public:
  InputWriter(LinearStudy* to, double t, bool at_rest) : to_(to), t_(t), at_rest_(at_rest) {}

  /// A number that is an input from now on. @param of the function whose value it is.
  Quantity input(const std::string& name, double value, const ReferenceDescription& of = {}) {
    to_->inputs.push_back(name);
    return number(value, of);
  }

  /// A function of time that keeps its value, which is no input.
  ReferenceDescription held(const ReferenceDescription& of) {
    if (of.kind == ReferenceDescription::Kind::kConstant) return of;
    return ReferenceDescription(number(Reference<double>(of, design_).at(t_).value, of));
  }

  /// A function whose value, rate and acceleration at the time are inputs.
  ReferenceDescription function(const std::string& name, const ReferenceDescription& of) {
    const ReferenceMotion<double> now = Reference<double>(of, design_).at(t_);
    const double moves = at_rest_ ? 0.0 : 1.0;
    ReferenceDescription moving;
    moving.kind = ReferenceDescription::Kind::kWaypoints;
    const Quantity value = input(name, now.value, of);
    moving.waypoints.times = {t_, t_ + 1.0};
    moving.waypoints.positions = {value, value};
    moving.waypoints.velocities = {input(name + "_rate", moves * now.rate), 0.0};
    moving.waypoints.accelerations = {input(name + "_acceleration", moves * now.acceleration), 0.0};
    return moving;
  }
  ReferenceDescription constant(const ReferenceDescription& of) const {
    return {Reference<double>(of, design_).at(t_).value};
  }
  void set_design(const std::vector<double>& design) { design_ = design; }

 private:
  Quantity number(double value, const ReferenceDescription& of) {
    Parameter parameter;
    parameter.name = "input_" + std::to_string(to_->functions.size());
    parameter.value = value;
    const int index = static_cast<int>(to_->study.parameters.size());
    to_->study.parameters.push_back(parameter);
    to_->study.used_parameters.insert(index);
    to_->parameters.push_back(value);
    to_->functions.push_back(of);
    const ExpressionScope scope{[index](const std::string&) { return index; },
                                [&parameter] { return std::vector<std::string>{parameter.name}; }};
    return {value, std::make_shared<const Expression>(parameter.name, scope)};
  }

  LinearStudy* to_;
  double t_;
  bool at_rest_;
  std::vector<double> design_;
};

void add_inputs(std::size_t c, InputWriter* writer, LinearStudy* to) {
  ControllerDescription& controller = to->study.controllers[c];
  if (controller.kind->has_error())
    controller.setpoint = writer->function(controller.name + "/setpoint", controller.setpoint);
  for (std::size_t k = 0; k < controller.feedback.size(); ++k)
    controller.feedback[k].reference = ReferenceDescription(
        writer->input(controller.name + "/reference[" + std::to_string(k) + "]",
                      writer->constant(controller.feedback[k].reference).constant.nominal(),
                      controller.feedback[k].reference));
  to->disturbances.push_back(-1);
  if (controller.output.empty()) return;
  to->disturbances.back() = static_cast<int>(to->inputs.size());
  ControllerDescription beside;
  beside.name = controller.name + " disturbance";
  beside.kind = ControllerKind::kStateFeedback;
  beside.output = controller.output;
  beside.where = controller.where;
  beside.feedforward = ReferenceDescription(writer->input(controller.name + "/disturbance", 0.0));
  to->study.controllers.push_back(beside);
}

bool is_given(const LoadFunction& function) {
  return function.of_signals || function.of_time.kind != ReferenceDescription::Kind::kConstant ||
         !function.of_time.constant.is_zero();
}

/// A load of the same kind beside each load, which is zero.
void add_load(std::size_t k, InputWriter* writer, LinearStudy* to) {
  const LoadDescription load = to->study.loads[k];
  const std::string name = "loads[" + std::to_string(k) + "]/";
  const std::string force = name + "force/", torque = name + "torque/";
  LoadDescription beside = load;
  beside.effort = {};
  beside.force = beside.torque = {};
  if (!load.joint.empty()) beside.effort.of_time = writer->input(name + "effort", 0.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string component(1, "xyz"[axis]);
    if (is_given(load.force[axis]))
      beside.force[axis].of_time = writer->input(force + component, 0.0);
    if (is_given(load.torque[axis]))
      beside.torque[axis].of_time = writer->input(torque + component, 0.0);
  }
  to->study.loads.push_back(beside);
}

void remove_coefficients(FrictionDescription* friction) {
  friction->model = FrictionModel::kBrownMcPhee;
  for (Quantity* number : {&friction->mu_static, &friction->mu_dynamic,
                           &friction->mu_static_backward, &friction->mu_dynamic_backward})
    *number = Quantity(0.0);
}

}  // namespace

LinearStudy with_inputs(Study study, const std::vector<double>& parameters, double t,
                        bool at_rest) {
  LinearStudy result{std::move(study), parameters, parameters.size(), {}, {}, {}, t};
  Study& of = result.study;
  InputWriter writer(&result, t, at_rest);
  writer.set_design(parameters);
  const std::size_t controllers = of.controllers.size(), loads = of.loads.size();
  for (std::size_t c = 0; c < controllers; ++c) {
    ControllerDescription& controller = of.controllers[c];
    controller.realization.quantization = 0.0;
    if (controller.i.at(parameters) == 0.0) controller.i = Quantity(0.0);
    add_inputs(c, &writer, &result);
  }
  for (std::size_t k = 0; k < loads; ++k) add_load(k, &writer, &result);
  for (std::size_t c = 0; c < controllers; ++c)
    if (of.controllers[c].kind->input == ControlInput::kFeedback)
      of.controllers[c].feedforward = writer.held(of.controllers[c].feedforward);
  if (at_rest)
    for (GivenMotion& motion : of.motion) motion.position = writer.held(motion.position);
  return result;
}

template <class T>
std::vector<T> LinearStudy::parameters_at(std::vector<T> design) const {
  std::vector<T> values;
  for (const ReferenceDescription& function : functions)
    values.push_back(Reference<T>(function, design).at(time).value);
  design.insert(design.end(), values.begin(), values.end());
  return design;
}
template std::vector<double> LinearStudy::parameters_at(std::vector<double>) const;
template std::vector<std::complex<double>> LinearStudy::parameters_at(
    std::vector<std::complex<double>>) const;
template std::vector<Lanes<8>> LinearStudy::parameters_at(std::vector<Lanes<8>>) const;

RobotDescription without_friction(RobotDescription robot) {
  for (ContactDescription& contact : robot.contacts)
    if (contact.friction) remove_coefficients(&*contact.friction);
  for (JointDescription& joint : robot.joints) {
    if (joint.friction) remove_coefficients(&*joint.friction);
    joint.dry_friction = Quantity(0.0);
    if (!joint.actuator || !joint.actuator->gear) continue;
    remove_losses(&*joint.actuator->gear);
  }
  return robot;
}

void remove_losses(GearDescription* gear) {
  gear->efficiency.reset();
  gear->backdrive_efficiency.reset();
  gear->coulomb = Quantity(0.0);
  gear->slip.model = FrictionModel::kBrownMcPhee;
}

}  // namespace codesign
