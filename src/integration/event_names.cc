// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/event_names.h"

#include <algorithm>
#include <array>
#include <map>

#include "codegen/recording.h"
#include "description/study.h"
#include "elements/joint_load.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "text/fingerprint.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// The names of a switch, as in Event.
struct SwitchName {
  std::string element, object, expression;
};

std::string joint_at(const System& system, int pair, int element) {
  const Pair& of = system.topology().pairs[to_index(pair)];
  const int joint = element >= 0 ? of.chain[to_index(element)].joint : of.friction_joint;
  return joint >= 0 ? system.robot().joints[to_index(joint)].name : of.name;
}

/// Finds the place in the study from which the equations have recorded an expression: of signals,
/// or of the time.
class FormulaPlaces {
 public:
  explicit FormulaPlaces(const System& system) : system_(system), study_(system.study()) {}

  /// @param part of a loss its kink.
  SwitchName find(const SourceId& source, int part) {
    if (const auto* term = source.as<ResolvedTerm>()) return of_loss(*term, part);
    formula_ = source.as<ResolvedFormula>();
    of_time_ = source.as<Expression>();
    if (system_.until() != nullptr) look(*system_.until(), "until", "");
    look_at_loads();
    look_at_controllers();
    look_at_terms(system_.integral(), study_.integral, "objective.integral[");
    for (std::size_t k = 0; k < system_.watched().size(); ++k) {
      look(system_.watched()[k], study_.watched[k].element, "");
      look(study_.watched[k].reference, study_.watched[k].element + ".reference", "");
    }
    for (const GivenMotion& motion : study_.motion)
      look(motion.position, "motion." + motion.joint, motion.joint);
    return name_;
  }

 private:
  /// Terminal terms are read at one instant, and have no events.
  SwitchName of_loss(const ResolvedTerm& term, int part) const {
    constexpr std::array<const char*, 3> kKinks{"", " + scale", " - scale"};  // of LossKink
    const std::string text = study_.integral[to_index(term.description)].signal.text;
    return {"objective.integral[" + std::to_string(term.description) + "].loss", "",
            part < 0 ? term.loss->name : text + " > reference" + kKinks.at(to_index(part))};
  }

  void look(const Signal& signal, const std::string& element, const std::string& object) {
    if (formula_ && signal.formula.get() == formula_) take(element, object);
  }
  void look(const ReferenceDescription& of, const std::string& element, const std::string& object) {
    if (of_time_ && of.expression.formula.get() == of_time_) take(element, object);
    if (of.integral.rate) look(*of.integral.rate, element, object);
  }
  void take(const std::string& element, const std::string& object) {
    if (name_.element.empty()) name_ = {element, object, ""};
  }

  void look_at_loads() {
    constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
    for (std::size_t k = 0; k < study_.loads.size(); ++k) {
      const LoadDescription& load = study_.loads[k];
      const LoadSignals& signals = system_.load_signals()[k];
      const std::string element = "loads[" + std::to_string(k) + "].";
      look(signals.effort, element + "effort", load.joint);
      look(load.effort.of_time, element + "effort", load.joint);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string component = std::string("/") + kAxes[axis];
        look(signals.force[axis], element + "force" + component, load.link);
        look(load.force[axis].of_time, element + "force" + component, load.link);
        look(signals.torque[axis], element + "torque" + component, load.link);
        look(load.torque[axis].of_time, element + "torque" + component, load.link);
      }
    }
  }

  void look_at_controllers() {
    for (std::size_t k = 0; k < study_.controllers.size(); ++k) {
      const ControllerDescription& of = study_.controllers[k];
      const Controller& resolved = system_.controllers()[k];
      const std::string element = "controllers." + of.name;
      look(of.setpoint, element + ".setpoint", of.output);
      look(resolved.input, element + ".input", of.output);
      look(of.feedforward, element + ".feedforward", of.output);
      for (std::size_t term = 0; term < of.feedback.size(); ++term) {
        const std::string place = element + ".feedback[" + std::to_string(term) + "]";
        look(of.feedback[term].reference, place + ".reference", of.output);
        look(resolved.feedback[term], place + ".signal", of.output);
      }
    }
  }

  void look_at_terms(const std::vector<ResolvedTerm>& resolved,
                     const std::vector<ObjectiveTerm>& terms, const std::string& list) {
    for (const ResolvedTerm& term : resolved) {
      const std::string element = list + std::to_string(term.description) + "]";
      look(term.signal, element + ".signal", "");
      look(terms[to_index(term.description)].reference, element + ".reference", "");
    }
  }

  const System& system_;
  const MotionStudy& study_;
  const ResolvedFormula* formula_ = nullptr;
  const Expression* of_time_ = nullptr;
  SwitchName name_;
};

SwitchName name_of(const System& system, const SwitchOrigin* origin) {
  if (!origin || !origin->source) return {"a law of the mechanism", "", "a switch"};
  const SourceId& source = *origin->source;
  if (const auto* load = source.as<JointLoad>()) {
    const std::string joint = joint_at(system, load->pair, load->element);
    return {"joint \"" + joint + "\"", joint,
            origin->part == kUpperStop ? "touch of the upper stop" : "touch of the lower stop"};
  }
  if (const auto* contact = source.as<ContactDescription>()) {
    const bool parts = origin->part % kContactParts == kContactParting;
    return {"contact \"" + contact->name + "\"", contact->name,
            parts ? "parting of bodies that still overlap" : "touch"};
  }
  if (const auto* bristle = source.as<BristleContact>()) {
    const std::string joint = joint_at(system, bristle->pair, bristle->element);
    return {"joint \"" + joint + "\"", joint,
            std::string(bristle->gear ? "gear: " : "") +
                (origin->part == kBristleCut ? "friction at its limit" : "end of the dwell")};
  }
  if (const auto* controller = source.as<Controller>()) {
    constexpr std::array<const char*, 3> kParts{"upper output_limit", "lower output_limit",
                                                "sign of the error beyond output_limit"};
    const auto c = to_index(controller - system.controllers().data());
    const ControllerDescription& of = system.study().controllers[c];
    return {"controllers." + of.name, of.output, kParts.at(to_index(origin->part))};
  }
  SwitchName name = FormulaPlaces(system).find(source, origin->part);
  if (name.element.empty()) name.element = "study";
  if (const auto* formula = source.as<ResolvedFormula>())
    name.expression = text_of(formula->steps, origin->part, formula->text);
  if (const auto* of_time = source.as<Expression>())
    name.expression = text_of(of_time->steps(), origin->part, of_time->text());
  return name;
}

bool rises(const EventLog::Entry& entry) {
  using Code = ExpressionStep::Code;
  using K = FunctionKind;
  const SwitchOrigin& origin = *entry.origin;
  const ExpressionSteps* steps = nullptr;
  if (origin.source) {
    if (const auto* formula = origin.source->as<ResolvedFormula>()) steps = &formula->steps;
    if (const auto* of_time = origin.source->as<Expression>()) steps = &of_time->steps();
  }
  if (!steps || origin.part < 0) return entry.becomes_true;
  const ExpressionStep& step = (*steps)[to_index(origin.part)];
  if (step.code == Code::kLessOrEqual || step.code == Code::kGreaterOrEqual)
    return !entry.becomes_true;  // they are recorded as the opposite of > and <
  if (step.code != Code::kCall) return entry.becomes_true;
  const K kind = expression_function_table()[to_index(step.index)].kind;
  const bool of_argument = kind == K::kMagnitude || kind == K::kSign || kind == K::kFloor;
  return of_argument && origin.compares_with_literal ? !entry.becomes_true : entry.becomes_true;
}

/// What Events::order says of one event.
std::string identity_of(const Event& event) {
  return event.element + '\n' + event.expression + (event.rising ? "\n+\n" : "\n-\n");
}

std::string order_of(const std::vector<Event>& events, double duration) {
  constexpr double kAtOnce = 1e-9;
  std::string text;
  for (std::size_t first = 0; first < events.size();) {
    std::vector<std::string> together;
    std::size_t k = first;
    for (; k < events.size() && events[k].time - events[first].time <= kAtOnce * duration; ++k)
      together.push_back(identity_of(events[k]));
    std::sort(together.begin(), together.end());
    for (const std::string& one : together) text += one;
    first = k;
  }
  return text.empty() ? "" : fingerprint(text);
}

}  // namespace

std::string describe_switch(const CompiledSystem& system, const SwitchOrigin* origin) {
  const SwitchName name = name_of(system, origin);
  return name.element + ", \"" + name.expression + "\"";
}

Events events_of(const CompiledSystem& system, const EventLog& log) {
  std::map<const SwitchOrigin*, SwitchName> known;
  Events events;
  events.count = log.count();
  for (const EventLog::Entry& entry : log.entries()) {
    const auto [name, is_new] = known.try_emplace(entry.origin);
    if (is_new) name->second = name_of(system, entry.origin);
    const SwitchName& of = name->second;
    events.list.push_back(
        {entry.time, of.element, of.object, of.expression, rises(entry), entry.is_jump});
  }
  events.order = order_of(events.list, system.study().duration);
  return events;
}

Warnings grazing_warnings(const CompiledSystem& system, const EventLog& log) {
  std::map<std::string, double> first;
  for (const EventLog::Entry& entry : log.touched())
    first.try_emplace(describe_switch(system, entry.origin), entry.time);
  Warnings warnings;
  for (const auto& [place, time] : first)
    warnings.push_back(
        warn("grazing_event",
             {{system.study().file, 0},
              place,
              "at t = " + readable(time) +
                  " s the guard is only touched, at a rate near zero: the instant of the "
                  "switch has no derivative there, and a gradient says nothing across it",
              "",
              "a motion that passes the switch, or misses it by more"}));
  return warnings;
}

}  // namespace codesign
