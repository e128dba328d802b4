// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/controller.h"

#include <algorithm>
#include <optional>

#include "description/motion_study.h"
#include "math/arrays.h"
#include "mechanism/topology.h"

namespace codesign {
namespace {

bool reads(const Signal& signal, SignalKind kind, int controller) {
  return std::any_of(signal.begin(), signal.end(), [&](const SignalReference& term) {
    return term.kind == kind && term.controller == controller;
  });
}

class Resolver {
 public:
  Resolver(const MotionStudy& study, const RobotDescription& robot, const Topology& topology)
      : study_(study), robot_(robot), topology_(topology), controllers_(study.controllers.size()) {}

  std::vector<Controller> resolve(const std::vector<Signal>& observed, int* states) {
    for (std::size_t k = 0; k < controllers_.size(); ++k) resolve_signals(k);
    // From the last to the first: a controller reads only earlier controllers, so that all readers
    // of a rate are known before the rate is provided.
    for (std::size_t k = controllers_.size(); k-- > 0;) provide_rate(k);
    for (std::size_t k = 0; k < controllers_.size(); ++k)
      if (needs_integral(static_cast<int>(k), observed)) controllers_[k].state = (*states)++;
    for (std::size_t k = 0; k < controllers_.size(); ++k) place_states(k, states);
    for (std::size_t k = 0; k < controllers_.size(); ++k) provide_output_rate(k);
    for (std::size_t k = 0; k < controllers_.size(); ++k) grow_tree(k);
    return std::move(controllers_);
  }

 private:
  std::string element(std::size_t k) const { return "controllers." + study_.controllers[k].name; }

  Signal readable(const SignalDescription& description, std::size_t k,
                  const std::string& key) const {
    Signal signal =
        resolve_signal(description, robot_, topology_, study_.controllers, study_.parameters);
    for (const SignalReference& term : signal)
      if (term.controller >= static_cast<int>(k) || reads_effort(term, k))
        throw InputError({study_.controllers[k].where, element(k) + key,
                          "a controller cannot read an effort, a reaction of a joint that it "
                          "drives, itself or a later controller",
                          description.text,
                          "controllers defined before it, currents of motors with an inductance"});
    return signal;
  }

  /// Whether a term contains the output of the k-th controller or of a later one. A reaction does
  /// if one of them drives its joint.
  bool reads_effort(const SignalReference& term, std::size_t k) const {
    if (facts_of(term.kind).needs == SignalNeeds::kEfforts) return !is_state(term);
    if (term.kind != SignalKind::kReactionForce && term.kind != SignalKind::kReactionTorque)
      return false;
    const auto drives = [&](const ControllerDescription& controller) {
      for (std::size_t j = 0; j < robot_.joints.size(); ++j)
        if (robot_.joints[j].name == controller.output && topology_.joint_pair[j] == term.pair)
          return true;
      return false;
    };
    return std::any_of(study_.controllers.begin() + to_signed(k), study_.controllers.end(), drives);
  }

  /// Whether a term is the current of a winding with an inductance, which follows the voltage.
  bool is_state(const SignalReference& term) const {
    if (term.kind != SignalKind::kCurrent || study_.rigid_gears || study_.postures > 0)
      return false;
    const int joint = topology_.pairs[to_index(term.pair)].chain[to_index(term.element)].joint;
    const JointDescription& of = robot_.joints[to_index(joint)];
    const int motor = of.motor >= 0 ? of.motor : joint;
    const JointDescription& moved = robot_.joints[to_index(motor)];
    return moved.has_winding() && moved.actuator->winding->has_state() &&
           std::none_of(study_.motion.begin(), study_.motion.end(),
                        [&of](const GivenMotion& motion) { return motion.joint == of.name; });
  }

  void resolve_signals(std::size_t k) {
    const ControllerDescription& description = study_.controllers[k];
    Controller& controller = controllers_[k];
    controller.kind = description.kind;
    if (description.kind->has_error() || description.kind->input == ControlInput::kObserved)
      controller.input = readable(description.input, k, ".input");
    for (const std::string& name : description.observer.efforts)
      controller.efforts.push_back(place_of(name));
    for (const FeedbackTerm& term : description.feedback)
      controller.feedback.push_back(readable(term.signal, k, ".feedback"));
    if (description.output.empty()) return;
    const auto joint = std::find_if(
        robot_.joints.begin(), robot_.joints.end(),
        [&description](const JointDescription& j) { return j.name == description.output; });
    if (joint == robot_.joints.end()) return;
    if (joint->has_winding() && controller.kind->load != ControlLoad::kNone)
      throw InputError({description.where, element(k) + ".type",
                        "the law computes an effort, and the motor of the joint is moved by a "
                        "voltage, since its <codesign:actuator> has a resistance",
                        controller.kind->name,
                        "pid, state_feedback or basis, whose output is then a voltage; or an "
                        "actuator without resistance"});
    const SignalDescription output{
        joint->name + "/velocity", {{1.0, joint->name, "velocity", ""}}, description.where};
    const Signal resolved = resolve_signal(output, robot_, topology_, study_.controllers, {});
    controller.pair = resolved.front().pair;
    controller.element = resolved.front().element;
  }

  int place_of(const std::string& name) const {
    const auto found = std::find_if(
        study_.controllers.begin(), study_.controllers.end(),
        [&name](const ControllerDescription& controller) { return controller.name == name; });
    return static_cast<int>(found - study_.controllers.begin());
  }

  void provide_rate(std::size_t k) {
    const ControllerDescription& description = study_.controllers[k];
    if (!description.kind->has_error()) return;
    // A sampled or filtered PID needs only the error.
    const ControlRealization& realization = description.realization;
    const bool by_error =
        description.kind->is_pid && (realization.is_sampled() || realization.derivative_filter);
    bool wanted = description.kind->reads_rate && !description.d.is_zero() && !by_error;
    for (const Controller& other : controllers_)
      wanted =
          wanted || reads(other.input_rate, SignalKind::kControllerErrorRate, static_cast<int>(k));
    if (!wanted) return;
    refuse_sampled_rate(k);
    controllers_[k].has_error_rate = true;
    if (!passes_steps(description.filters)) return;
    refuse_kinked_integral(k);
    controllers_[k].input_rate =
        differentiate(controllers_[k].input, description.input, element(k) + ".input");
  }

  /// Whether the output of filters jumps with their input, so that its rate contains the input's.
  static bool passes_steps(const std::vector<FilterDescription>& filters) {
    return std::all_of(filters.begin(), filters.end(),
                       [](const FilterDescription& filter) { return filter.kind->passes_steps; });
  }

  /// Between samples the output of a sampled filter has no rate.
  void refuse_sampled_rate(std::size_t k) const {
    const ControllerDescription& description = study_.controllers[k];
    if (description.filters.empty() || !description.realization.is_sampled()) return;
    throw InputError({description.filters.front().where, element(k) + ".filter",
                      "a sampled filter gives no rate of its signal, which this controller needs",
                      description.filters.front().kind->name,
                      "a pid, whose rate is a difference; or a continuous controller"});
  }

  /// The rate of an integral is the error only if nothing clamps or samples it.
  bool is_plain_integral(const SignalReference& term) const {
    if (term.kind != SignalKind::kControllerIntegral) return true;
    const ControlRealization& realization =
        study_.controllers[to_index(term.controller)].realization;
    return realization.antiwindup == AntiWindup::kNone && !realization.is_sampled();
  }

  void refuse_kinked_integral(std::size_t k) const {
    for (const SignalReference& term : controllers_[k].input)
      if (!is_plain_integral(term))
        throw InputError(
            {study_.controllers[k].where, element(k) + ".input",
             "the time derivative of the integral of a sampled or clamped controller is not "
             "available",
             study_.controllers[k].input.text,
             "sums of joint or link positions and velocities; or a derivative_filter"});
  }

  void place_states(std::size_t k, int* states) {
    const ControlRealization& realization = study_.controllers[k].realization;
    ControllerStates& places = controllers_[k].states;
    const bool sampled = realization.is_sampled(), pid = controllers_[k].kind->is_pid;
    bool filtered = false;
    for (std::size_t input = 0; input < filtered_inputs(study_.controllers[k]); ++input)
      filtered = filtered || !filters_of(study_.controllers[k], input).empty();
    const bool observes = controllers_[k].kind->input == ControlInput::kObserved;
    if (sampled || realization.derivative_filter || filtered || observes) refuse_rates(k);
    for (std::size_t input = 0; input < filtered_inputs(study_.controllers[k]); ++input) {
      places.inputs.emplace_back();
      for (const FilterDescription& filter : filters_of(study_.controllers[k], input)) {
        places.inputs.back().push_back({*states, filter.kind->order});
        *states += filter.kind->order;
      }
    }
    if (realization.derivative_filter) places.filter = (*states)++;
    if (sampled && pid && !study_.controllers[k].d.is_zero()) places.last = (*states)++;
    if (sampled) places.held = (*states)++;
    if (sampled && realization.rate_limit) places.computed = (*states)++;
    if (realization.queued() > 0) places.queue = *states;
    *states += realization.queued();
    if (realization.time_constant) places.lag = (*states)++;
    if (!observes) return;
    places.estimate = *states;
    places.estimates = study_.controllers[k].observer.order();
    *states += places.estimates;
  }

  /// A sampled controller must not read accelerations and forces: its output determines them at the
  /// instant of the sample. The same holds for a filter, whose state begins at its input.
  void refuse_rates(std::size_t k) const {
    const auto is_rate = [this](const SignalReference& term) {
      const SignalNeeds needs = facts_of(term.kind).needs;
      return needs != SignalNeeds::kMotion && needs != SignalNeeds::kControl && !is_state(term);
    };
    const auto check = [&](const Signal& signal, const SignalDescription& description) {
      if (std::any_of(signal.begin(), signal.end(), is_rate))
        throw InputError({study_.controllers[k].where, element(k),
                          "an observer, or a controller with sample_time, filter or "
                          "derivative_filter, cannot read accelerations, forces and powers",
                          description.text,
                          "positions, velocities, orientations, energies and controllers"});
    };
    check(controllers_[k].input, study_.controllers[k].input);
    for (std::size_t term = 0; term < controllers_[k].feedback.size(); ++term)
      check(controllers_[k].feedback[term], study_.controllers[k].feedback[term].signal);
  }

  /// The signals for the rate of a continuous output, (54); controllers behind a lag need none.
  void provide_output_rate(std::size_t k) {
    const ControllerDescription& description = study_.controllers[k];
    Controller& controller = controllers_[k];
    controller.has_output_rate = description.realization.time_constant.has_value();
    if (controller.has_output_rate || description.realization.is_sampled()) return;
    std::vector<Signal> rates;
    const auto add = [&rates](const Signal& signal) {
      std::optional<Signal> rate = differentiate(signal);
      if (rate) rates.push_back(std::move(*rate));
      return rate.has_value();
    };
    const auto is_free = [](const Signal& signal) {
      return std::all_of(signal.begin(), signal.end(),
                         [](const SignalReference& term) { return term.controller < 0; });
    };
    if (controller.kind->is_pid) {
      const bool twice = !description.d.is_zero() && !description.realization.derivative_filter;
      if (twice && !description.filters.empty()) return;
      if (!is_free(controller.input) || !add(controller.input) ||
          (twice && !add(Signal(rates.front()))))
        return;
    } else if (controller.kind->input == ControlInput::kFeedback) {
      for (const Signal& signal : controller.feedback)
        if (!is_free(signal) || !add(signal)) return;
    } else {
      return;
    }
    controller.output_rate = std::move(rates);
    controller.has_output_rate = true;
  }

  bool needs_integral(int k, const std::vector<Signal>& observed) const {
    if (!study_.controllers[to_index(k)].i.is_zero()) return true;
    const auto integral = [k](const Signal& signal) {
      return reads(signal, SignalKind::kControllerIntegral, k);
    };
    return std::any_of(observed.begin(), observed.end(), integral) ||
           std::any_of(controllers_.begin(), controllers_.end(),
                       [&integral](const Controller& other) {
                         return integral(other.input) ||
                                std::any_of(other.feedback.begin(), other.feedback.end(), integral);
                       });
  }

  void grow_tree(std::size_t k) {
    Controller& controller = controllers_[k];
    const bool torque = controller.kind->load == ControlLoad::kDemanded;
    if (controller.kind->load == ControlLoad::kNone) return;
    controller.tree = driven_tree(topology_, controller.pair, torque, study_.controllers[k].where,
                                  element(k) + ".output");
    if (!torque) return;
    for (std::size_t other = 0; other < k; ++other)
      if (controllers_[other].kind->load == ControlLoad::kDemanded &&
          controllers_[other].pair == controller.pair)
        throw InputError({study_.controllers[k].where, element(k) + ".output",
                          "a joint can have only one computed torque", study_.controllers[k].output,
                          "a joint that " + study_.controllers[other].name + " does not drive"});
    for (DrivenTree::Node& node : controller.tree.nodes)
      for (std::size_t other = 0; other < controllers_.size(); ++other)
        if (controllers_[other].kind->load == ControlLoad::kDemanded &&
            controllers_[other].pair == node.pair)
          node.controller = static_cast<int>(other);
    for (DrivenTree::Node& node : controller.tree.nodes)
      node.rotor = node.moved && has_rotor(node.pair);
  }

  bool has_rotor(int pair) const {
    const int joint = topology_.pairs[to_index(pair)].chain.front().joint;
    const JointDescription& of = robot_.joints[to_index(joint)];
    // The law's model has rigid gears, whose rotors are those of the joints.
    if (of.is_motor) return false;
    return !of.armature.is_zero() || (of.actuator && !of.actuator->rotor_inertia.is_zero());
  }

  const MotionStudy& study_;
  const RobotDescription& robot_;
  const Topology& topology_;
  std::vector<Controller> controllers_;
};

}  // namespace

std::size_t filtered_inputs(const ControllerDescription& description) {
  return (description.kind->has_error() ? 1U : 0U) + description.feedback.size();
}

const std::vector<FilterDescription>& filters_of(const ControllerDescription& description,
                                                 std::size_t k) {
  const std::size_t own = description.kind->has_error() ? 1 : 0;
  return k < own ? description.filters : description.feedback[k - own].filters;
}

bool Controller::has_start() const {
  return states.filter >= 0 || states.held >= 0 || states.estimate >= 0 ||
         std::any_of(states.inputs.begin(), states.inputs.end(),
                     [](const std::vector<FilterPlace>& chain) { return !chain.empty(); });
}

std::vector<StatePlace> Controller::places(int queued) const {
  std::vector<StatePlace> all{{state, 1, "integral"}};
  for (const std::vector<FilterPlace>& chain : states.inputs)
    for (const FilterPlace& filter : chain)
      all.push_back({filter.state, filter.order, "feedback_filter"});
  for (const StatePlace& place :
       {StatePlace{states.filter, 1, "filter"}, StatePlace{states.last, 1, "last_error"},
        StatePlace{states.held, 1, "held"}, StatePlace{states.computed, 1, "computed"},
        StatePlace{states.queue, queued, "queue"}, StatePlace{states.lag, 1, "lag"},
        StatePlace{states.estimate, states.estimates, "estimate"}})
    all.push_back(place);
  return all;
}

std::vector<Controller> resolve_controllers(const MotionStudy& study, const RobotDescription& robot,
                                            const Topology& topology,
                                            const std::vector<Signal>& observed, int* states) {
  return Resolver(study, robot, topology).resolve(observed, states);
}

}  // namespace codesign
