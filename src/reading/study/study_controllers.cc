// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>

#include "mechanism/signal_catalog.h"
#include "reading/study/study_values.h"

namespace codesign {
namespace {

/// The data that the readers of one controller share.
struct Context {
  const RobotDescription& robot;
  const ParameterTable& table;
  const TrajectoryLoader& loader;
  const Study& study;
};

void read_gains(const YamlValue& gains, const ParameterTable& table,
                ControllerDescription* controller) {
  std::vector<std::string> known;
  std::string all;
  for (const char* letter = controller->kind->gains; *letter; ++letter)
    known.emplace_back(1, *letter);
  for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
  gains.require_keys({}, known);
  if (gains.entries().empty()) gains.fail("a controller needs at least one gain", all);
  if (const auto p = gains.find("p")) controller->p = read_quantity(*p, table);
  if (const auto i = gains.find("i")) controller->i = read_quantity(*i, table);
  if (const auto d = gains.find("d")) controller->d = read_quantity(*d, table);
}

/// A controller must not have the name of a joint or link, since signals would be ambiguous.
void refuse_taken_name(const std::string& name, const YamlValue& value,
                       const RobotDescription& robot) {
  const auto taken = [&name](const auto& item) { return item.name == name; };
  const bool joint = std::any_of(robot.joints.begin(), robot.joints.end(), taken);
  const bool link = std::any_of(robot.links.begin(), robot.links.end(), taken);
  if (joint || link)
    throw InputError(
        {value.where(), value.path(), "a joint or link has the same name", name, "another name"});
}

// A signal may use the controllers before this one, which allows cascades and excludes cycles.
SignalDescription read_signal(const YamlValue& value, const Context& context) {
  SignalDescription signal = parse_signal(value.text(), value.where(), value.path());
  use_parameters(signal, context.table);
  check_signal(signal, context.robot, context.study.controllers, value.path());
  return signal;
}

/// The position of the joint that the controller drives.
SignalDescription own_position(const ControllerDescription& controller) {
  return {controller.output + "/position",
          {{1.0, controller.output, "position", ""}},
          controller.where};
}

void read_with_input(const YamlValue& value, const Context& context,
                     ControllerDescription* controller) {
  value.require_keys({"type", "input", "setpoint", "gains"},
                     with_realization_keys(controller->kind, {"output"}));
  controller->input = read_signal(value.at("input"), context);
  controller->setpoint = read_reference(value.at("setpoint"), context.table, context.loader);
  read_gains(value.at("gains"), context.table, controller);
}

/// Such as gravity compensation and computed torque; the input is the position of the joint that
/// they drive.
void read_with_own_position(const YamlValue& value, const Context& context,
                            ControllerDescription* controller) {
  value.require_keys({"type", "setpoint", "output", "gains"},
                     with_realization_keys(controller->kind, {}));
  controller->input = own_position(*controller);
  controller->setpoint = read_reference(value.at("setpoint"), context.table, context.loader);
  read_gains(value.at("gains"), context.table, controller);
}

void read_state_feedback(const YamlValue& value, const Context& context,
                         ControllerDescription* controller) {
  value.require_keys({"type"}, with_realization_keys(controller->kind, {"output", "feedback",
                                                                        "feedforward", "gains"}));
  if (const auto feedforward = value.find("feedforward"))
    controller->feedforward = read_reference(*feedforward, context.table, context.loader);
  const auto feedback = value.find("feedback");
  const std::vector<YamlValue> terms = feedback ? feedback->items() : std::vector<YamlValue>{};
  if (terms.empty() && !value.find("feedforward"))
    value.fail("the controller does nothing",
               "feedback: at least one {signal, gain, reference}; or feedforward");
  for (const YamlValue& item : terms) {
    const std::optional<Quantity> found =
        initial_gain(controller->name, controller->feedback.size(), context.table, context.study);
    if (found)
      item.require_keys({"signal"}, {"reference", "filter"});
    else
      item.require_keys({"signal", "gain"}, {"reference", "filter"});
    FeedbackTerm term;
    term.signal = read_signal(item.at("signal"), context);
    term.gain = found ? *found : read_quantity(item.at("gain"), context.table);
    if (const auto reference = item.find("reference"))
      term.reference = read_reference(*reference, context.table, context.loader);
    if (const auto filter = item.find("filter"))
      term.filters = read_filters(*filter, context.table);
    controller->feedback.push_back(term);
  }
}

void read_basis_controller(const YamlValue& value, const Context& context,
                           ControllerDescription* controller) {
  value.require_keys({"type", "output", "coefficients"},
                     with_realization_keys(controller->kind, {"shape", "duration"}));
  controller->basis = read_basis(controller->name, value, context.table, context.study.duration);
}

/// Poles as numbers or pairs, one per state.
void read_observer_poles(const YamlValue& value, ObserverDescription* observer) {
  for (const YamlValue& item : value.items()) {
    std::vector<double> pole;
    if (item.is_list())
      for (const YamlValue& number : item.items()) pole.push_back(number.number());
    else
      pole = {item.number(), 0.0};
    if (pole.size() != 2 || !(pole[0] < 0.0))
      item.fail("an estimate decays only by poles on the left of the axis",
                "a number below 0 [1/s], or a pair [real part, imaginary part]");
    for (const double side : {1.0, -1.0}) {
      observer->real.push_back(pole[0]);
      observer->imaginary.push_back(side * pole[1]);
      if (pole[1] == 0.0) break;
    }
  }
  if (observer->real.size() != static_cast<std::size_t>(observer->order()))
    value.fail("found " + std::to_string(observer->real.size()) + " poles for " +
                   std::to_string(observer->order()) + " estimates",
               "position and velocity, with disturbance: true a third one; a pair as one entry");
}

Quantity read_observer_number(const YamlValue& value, const ParameterTable& table) {
  const Quantity quantity = read_quantity(value, table);
  if (!(quantity.nominal() > 0.0))
    value.fail("this must be positive at the parameters' start", "more than 0");
  return quantity;
}

void read_observer(const YamlValue& value, const Context& context,
                   ControllerDescription* controller) {
  value.require_keys({"type", "joint", "inertia"}, {"input", "disturbance", "poles", "bandwidth",
                                                    "process", "measurement", "sample_time"});
  ObserverDescription& observer = controller->observer;
  const YamlValue joint = value.at("joint");
  observer.joint = scalar_joint(joint.text(), context.robot, joint).name;
  const auto input = value.find("input");
  controller->input = input ? read_signal(*input, context)
                            : SignalDescription{observer.joint + "/position",
                                                {{1.0, observer.joint, "position", ""}},
                                                controller->where};
  observer.inertia = read_observer_number(value.at("inertia"), context.table);
  if (const auto disturbance = value.find("disturbance"))
    observer.has_disturbance = disturbance->boolean();
  const auto poles = value.find("poles"), bandwidth = value.find("bandwidth"),
             process = value.find("process"), measurement = value.find("measurement");
  const bool by_noise = process && measurement;
  if (static_cast<bool>(process) != static_cast<bool>(measurement) ||
      (poles ? 1 : 0) + (bandwidth ? 1 : 0) + (by_noise ? 1 : 0) != 1)
    value.fail("the gains of an observer follow from one of three",
               "poles; bandwidth; or process and measurement, for a Kalman filter");
  if (poles) read_observer_poles(*poles, &observer);
  if (bandwidth) observer.bandwidth = read_observer_number(*bandwidth, context.table);
  if (!by_noise) return;
  observer.process = read_observer_number(*process, context.table);
  observer.measurement = read_observer_number(*measurement, context.table);
  if (observer.has_disturbance && value.find("sample_time"))
    process->fail("a sampled Kalman filter with a disturbance has no gains in closed form",
                  "bandwidth or poles; or no sample_time; or no disturbance");
}

void read_law(const YamlValue& value, const Context& context, ControllerDescription* controller) {
  switch (controller->kind->input) {
    case ControlInput::kSignal:
      return read_with_input(value, context, controller);
    case ControlInput::kOwnPosition:
      return read_with_own_position(value, context, controller);
    case ControlInput::kFeedback:
      return read_state_feedback(value, context, controller);
    case ControlInput::kShape:
      return read_basis_controller(value, context, controller);
    case ControlInput::kObserved:
      return read_observer(value, context, controller);
  }
}

ControllerDescription read_controller(const std::string& name, const YamlValue& value,
                                      const Context& context) {
  const std::vector<ControllerKind>& laws = context.robot.laws.controllers;
  refuse_taken_name(name, value, context.robot);
  ControllerDescription controller;
  controller.name = name;
  controller.where = value.where();
  const std::string type = value.at("type").choice("controller type", names_of(laws));
  controller.kind = *std::find_if(laws.begin(), laws.end(),
                                  [&type](const ControllerKind& law) { return law->name == type; });
  if (const auto output = value.find("output"))
    controller.output = scalar_joint(output->text(), context.robot, *output).name;
  read_law(value, context, &controller);
  if (const auto filter = value.find("filter"))
    controller.filters = read_filters(*filter, context.table);
  read_realization(value, context.table, &controller);
  check_filters(controller);
  return controller;
}

/// A controller without a joint acts through later controllers that read its output.
void refuse_idle(const Study& study) {
  const auto reads = [](const SignalDescription& signal, const std::string& name) {
    return std::any_of(signal.terms.begin(), signal.terms.end(), [&name](const SignalTerm& term) {
      return term.object == name && term.quantity == "output";
    });
  };
  for (const ControllerDescription& controller : study.controllers) {
    if (!controller.output.empty() || controller.kind->input == ControlInput::kObserved) continue;
    const bool is_read = std::any_of(
        study.controllers.begin(), study.controllers.end(),
        [&](const ControllerDescription& other) {
          return reads(other.input, controller.name) ||
                 std::any_of(
                     other.feedback.begin(), other.feedback.end(),
                     [&](const FeedbackTerm& term) { return reads(term.signal, controller.name); });
        });
    if (!is_read)
      throw InputError(
          {controller.where, "controllers." + controller.name + ".output",
           "required key is missing: no later controller reads the output of this one either",
           controller.name,
           "output: a joint; or a later controller whose input has the term " + controller.name +
               "/output"});
  }
}

}  // namespace

void read_controllers(const YamlValue& study_value, const RobotDescription& robot,
                      const ParameterTable& table, const TrajectoryLoader& loader, Study* study) {
  const auto controllers = study_value.find("controllers");
  if (!controllers) return;
  for (const auto& [name, value] : controllers->entries())
    study->controllers.push_back(
        read_controller(name, value, Context{robot, table, loader, *study}));
  refuse_idle(*study);
  for (ControllerDescription& observer : study->controllers)
    for (const ControllerDescription& controller : study->controllers)
      if (controller.output == observer.observer.joint && !controller.output.empty())
        observer.observer.efforts.push_back(controller.name);
}

}  // namespace codesign
