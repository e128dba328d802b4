// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>

#include "mechanism/signal_catalog.h"
#include "reading/study/entry_keys.h"
#include "reading/study/study_values.h"

namespace codesign {
namespace {

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
SignalDescription read_signal(const YamlValue& value, const EntryContext& in) {
  SignalDescription signal = parse_signal(value.text(), value.where(), value.path());
  use_parameters(signal, in.table);
  check_signal(signal, in.robot, in.study.controllers, value.path());
  return signal;
}

/// @param has_gain whether the term gives its gain; else the gain is a parameter, initial_gain().
EntryKeys<FeedbackTerm> feedback_keys(bool has_gain) {
  using Term = FeedbackTerm;
  EntryKeys<Term> keys{
      required_key<Term>("signal", [](const YamlValue& value, const EntryContext& in,
                                      Term* term) { term->signal = read_signal(value, in); }),
      optional_key<Term>("reference",
                         [](const YamlValue& value, const EntryContext& in, Term* term) {
                           term->reference = read_reference(value, in.table, in.loader);
                         }),
      optional_key<Term>("filter", [](const YamlValue& value, const EntryContext& in, Term* term) {
        term->filters = read_filters(value, in.table);
      })};
  if (has_gain)
    keys.push_back(
        required_key<Term>("gain", [](const YamlValue& value, const EntryContext& in, Term* term) {
          term->gain = read_quantity(value, in.table);
        }));
  return keys;
}

void read_feedback(const YamlValue& value, const EntryContext& in,
                   ControllerDescription* controller) {
  for (const YamlValue& item : value.items()) {
    const std::optional<Quantity> gain =
        initial_gain(controller->name, controller->feedback.size(), in.table, in.study);
    FeedbackTerm term;
    if (gain) term.gain = *gain;
    read_entry(item, feedback_keys(!gain), in, &term);
    controller->feedback.push_back(std::move(term));
  }
}

void read_output(const YamlValue& value, const EntryContext& in,
                 ControllerDescription* controller) {
  controller->output = scalar_joint(value.text(), in.robot, value).name;
}
void read_setpoint(const YamlValue& value, const EntryContext& in,
                   ControllerDescription* controller) {
  controller->setpoint = read_reference(value, in.table, in.loader);
}
EntryKey<ControllerDescription> gains_key() {
  return {"gains", true,
          [](const YamlValue& value, const EntryContext& in, ControllerDescription* controller) {
            read_gains(value, in.table, controller);
          }};
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
  Quantity quantity = read_quantity(value, table);
  if (!(quantity.nominal() > 0.0))
    value.fail("this must be positive at the parameters' start", "more than 0");
  return quantity;
}

/// A number of an observer that must be positive.
template <class Member>
EntryKey<ControllerDescription> observer_number(const char* name, bool is_required, Member member) {
  return {name, is_required,
          [member](const YamlValue& value, const EntryContext& in, ControllerDescription* of) {
            of->observer.*member = read_observer_number(value, in.table);
          }};
}

ControllerKeys observer_keys() {
  using O = ObserverDescription;
  return {{"type", true, nullptr},
          {"joint", true,
           [](const YamlValue& value, const EntryContext& in, ControllerDescription* of) {
             of->observer.joint = scalar_joint(value.text(), in.robot, value).name;
           }},
          observer_number("inertia", true, &O::inertia),
          {"input", false,
           [](const YamlValue& value, const EntryContext& in, ControllerDescription* of) {
             of->input = read_signal(value, in);
           }},
          {"disturbance", false,
           [](const YamlValue& value, const EntryContext&, ControllerDescription* of) {
             of->observer.has_disturbance = value.boolean();
           }},
          {"poles", false,
           [](const YamlValue& value, const EntryContext&, ControllerDescription* of) {
             read_observer_poles(value, &of->observer);
           }},
          observer_number("bandwidth", false, &O::bandwidth),
          observer_number("process", false, &O::process),
          observer_number("measurement", false, &O::measurement)};
}

/// Without an input the observer has the position of its joint; its gains follow from one choice.
void complete_observer(const YamlValue& value, ControllerDescription* controller) {
  const ObserverDescription& observer = controller->observer;
  if (!value.find("input"))
    controller->input = {
        observer.joint + "/position", {{1.0, observer.joint, "position", ""}}, controller->where};
  const bool has_process = value.find("process").has_value(),
             has_measurement = value.find("measurement").has_value(),
             by_noise = has_process && has_measurement;
  if (has_process != has_measurement ||
      (value.find("poles") ? 1 : 0) + (value.find("bandwidth") ? 1 : 0) + (by_noise ? 1 : 0) != 1)
    value.fail("the gains of an observer follow from one of three",
               "poles; bandwidth; or process and measurement, for a Kalman filter");
  if (by_noise && observer.has_disturbance && value.find("sample_time"))
    value.at("process").fail(
        "a sampled Kalman filter with a disturbance has no gains in closed form",
        "bandwidth or poles; or no sample_time; or no disturbance");
}

/// The keys of a controller by what its law works on; the type has been read.
ControllerKeys law_keys(ControlInput input) {
  const ControllerKeys type{{"type", true, nullptr}}, output{{"output", true, read_output}};
  switch (input) {
    case ControlInput::kSignal:
      return {
          {"type", true, nullptr},
          {"output", false, read_output},
          {"input", true,
           [](const YamlValue& value, const EntryContext& in, ControllerDescription* controller) {
             controller->input = read_signal(value, in);
           }},
          {"setpoint", true, read_setpoint},
          gains_key()};
    case ControlInput::kOwnPosition:
      return with(with(type, output),
                  ControllerKeys{{"setpoint", true, read_setpoint}, gains_key()});
    case ControlInput::kFeedback:
      return {
          {"type", true, nullptr},
          {"output", false, read_output},
          {"feedforward", false,
           [](const YamlValue& value, const EntryContext& in, ControllerDescription* controller) {
             controller->feedforward = read_reference(value, in.table, in.loader);
           }},
          {"gains", false, nullptr},  // declare_gains() has read them
          {"feedback", false, read_feedback}};
    case ControlInput::kShape:  // read_basis() reads the shape
      return with(with(type, output), ControllerKeys{{"coefficients", true, nullptr},
                                                     {"shape", false, nullptr},
                                                     {"duration", false, nullptr}});
    case ControlInput::kObserved:
      return observer_keys();
  }
  return {};
}

/// What follows from several keys.
void complete(const YamlValue& value, const EntryContext& in, ControllerDescription* controller) {
  // Gravity compensation and computed torque have the position of the joint that they drive.
  if (controller->kind->input == ControlInput::kOwnPosition)
    controller->input = {controller->output + "/position",
                         {{1.0, controller->output, "position", ""}},
                         controller->where};
  if (controller->kind->input == ControlInput::kFeedback && controller->feedback.empty() &&
      !value.find("feedforward"))
    value.fail("the controller does nothing",
               "feedback: at least one {signal, gain, reference}; or feedforward");
  if (controller->kind->input == ControlInput::kShape)
    controller->basis = read_basis(controller->name, value, in.table, in.study.duration);
  if (controller->kind->input == ControlInput::kObserved) complete_observer(value, controller);
}

ControllerDescription read_controller(const std::string& name, const YamlValue& value,
                                      const EntryContext& in) {
  const std::vector<ControllerKind>& laws = in.robot.laws.controllers;
  refuse_taken_name(name, value, in.robot);
  ControllerDescription controller;
  controller.name = name;
  controller.where = value.where();
  const std::string type = value.at("type").choice("controller type", names_of(laws));
  controller.kind = *std::find_if(laws.begin(), laws.end(),
                                  [&type](const ControllerKind& law) { return law->name == type; });
  read_entry(value, with(law_keys(controller.kind->input), realization_keys(controller.kind)), in,
             &controller);
  complete(value, in, &controller);
  check_realization(value, controller);
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

std::vector<EntryForm> forms_of_controllers() {
  std::vector<EntryForm> forms{{"controllers.NAME.feedback[]", feedback_keys(true)}};
  for (const ControllerKind& kind : standard_laws().controllers)
    forms.emplace_back("controllers.NAME", with(law_keys(kind->input), realization_keys(kind)));
  return forms;
}

void read_controllers(const YamlValue& study_value, const RobotDescription& robot,
                      const ParameterTable& table, const TrajectoryLoader& loader, Study* study) {
  const auto controllers = study_value.find("controllers");
  if (!controllers) return;
  for (const auto& [name, value] : controllers->entries())
    study->controllers.push_back(
        read_controller(name, value, EntryContext{robot, table, loader, *study}));
  refuse_idle(*study);
  for (ControllerDescription& observer : study->controllers)
    for (const ControllerDescription& controller : study->controllers)
      if (controller.output == observer.observer.joint && !controller.output.empty())
        observer.observer.efforts.push_back(controller.name);
}

}  // namespace codesign
