// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/dynamics/system.h"

#include <algorithm>

#include "mechanism_codesign/dynamics/equations.h"

namespace codesign {
namespace {

int constraint_rows(PairKind kind) {
  switch (kind) {
    case PairKind::kFixed:
      return 6;
    case PairKind::kRevolute:
    case PairKind::kPrismatic:
      return 5;
    case PairKind::kCylindrical:
    case PairKind::kUniversal:
    case PairKind::kTable:
      return 4;
    case PairKind::kSpherical:
    case PairKind::kPlanar:
    case PairKind::kTranslational:
      return 3;
    case PairKind::kDistance:
      return 1;
    case PairKind::kFree:
      return 0;
  }
  return 0;
}

bool zero(const Quantity& q) { return q.is_constant() && q.nominal() == 0.0; }

bool reads(const std::vector<ResolvedTerm>& terms, SignalKind kind, int controller) {
  return std::any_of(terms.begin(), terms.end(), [&](const ResolvedTerm& term) {
    return std::any_of(term.signal.begin(), term.signal.end(),
                       [&](const SignalReference& r) { return r.kind == kind && r.controller == controller; });
  });
}

}  // namespace

System::System(const RobotDescription& robot, const Study& study, double compliance)
    : robot_(robot), study_(study), topology_(derive_topology(robot_)), compliance_(compliance) {
  refuse_unsupported();
  lay_out();
  find_coordinates();
  check_couplings();
  resolve_objective();
  resolve_controllers();
  collect_loads();
  collect_bristles();
  record_pattern();
}

std::vector<double> System::parameters() const {
  std::vector<double> values;
  for (const Parameter& parameter : study_.parameters) values.push_back(parameter.value);
  return values;
}

void System::lay_out() {
  layout_.bodies = static_cast<int>(topology_.bodies.size());
  layout_.n = kBodySize * layout_.bodies;
  for (const Pair& pair : topology_.pairs) {
    layout_.pair_row.push_back(layout_.m);
    layout_.m += constraint_rows(pair.kind);
  }
  layout_.couplings = static_cast<int>(topology_.couplings.size());
  layout_.m += layout_.couplings + layout_.bodies;
}

void System::resolve_objective() {
  const auto resolve = [this](const std::vector<ObjectiveTerm>& terms, std::vector<ResolvedTerm>* resolved) {
    for (std::size_t k = 0; k < terms.size(); ++k) {
      resolved->push_back({resolve_signal(terms[k].signal, robot_, topology_, study_.controllers), static_cast<int>(k)});
      check_readable(resolved->back().signal, terms[k].signal);
    }
  };
  resolve(study_.integral, &integral_);
  resolve(study_.terminal, &terminal_);
}

void System::resolve_controllers() {
  for (std::size_t k = 0; k < study_.controllers.size(); ++k) {
    const ControllerDescription& description = study_.controllers[k];
    const std::string element = "controllers." + description.name;
    Controller controller;
    controller.input = resolve_signal(description.input, robot_, topology_, study_.controllers);
    check_readable(controller.input, description.input);
    for (const SignalReference& term : controller.input)
      if (term.controller >= static_cast<int>(k) || term.kind == SignalKind::kJointEffort)
        throw InputError({description.where, element + ".input", "a controller cannot read an effort, itself or a later controller",
                          description.input.text, "controllers defined before it"});
    const int index = static_cast<int>(k);
    const bool error_rate = reads(integral_, SignalKind::kControllerErrorRate, index);
    if (!zero(description.d) || error_rate) controller.input_rate = differentiate(controller.input, description.input, element + ".input");
    const bool integral =
        reads(integral_, SignalKind::kControllerIntegral, index) || reads(terminal_, SignalKind::kControllerIntegral, index);
    if (!zero(description.i) || integral) controller.state = layout_.states++;
    for (std::size_t joint = 0; joint < robot_.joints.size(); ++joint) {
      if (robot_.joints[joint].name != description.output) continue;
      SignalDescription output{description.output + "/velocity", {{1.0, description.output, "velocity", ""}}, description.where};
      const Signal resolved = resolve_signal(output, robot_, topology_, study_.controllers);
      controller.pair = resolved.front().pair;
      controller.element = resolved.front().element;
    }
    controllers_.push_back(controller);
  }
}

void System::collect_loads() {
  for (std::size_t p = 0; p < topology_.pairs.size(); ++p) {
    const Pair& pair = topology_.pairs[p];
    const bool contact = pair.friction_joint >= 0 && slips_isotropically(pair.kind);
    if (contact) contacts_.push_back(static_cast<int>(p));
    const std::size_t elements = pair.kind == PairKind::kCylindrical ? 2 : pair.chain.size();
    for (std::size_t e = 0; e < elements; ++e) {
      JointLoad load;
      load.pair = static_cast<int>(p);
      load.element = static_cast<int>(e);
      load.reaction_friction = pair.friction_joint >= 0 && !contact;
      if (e < pair.chain.size()) {
        const JointDescription& joint = robot_.joints[static_cast<std::size_t>(pair.chain[e].joint)];
        load.constant_friction = !zero(joint.dry_friction);
        load.spring = joint.spring.has_value();
        load.passive = !zero(joint.damping) || load.spring;
        load.stop = study_.limits.position && has_stops(joint);
        load.saturated = study_.limits.effort && joint.limit && joint.limit->bounds_effort();
      }
      for (std::size_t c = 0; c < controllers_.size(); ++c)
        if (controllers_[c].pair == load.pair && controllers_[c].element == load.element) load.controllers.push_back(static_cast<int>(c));
      if (!load.reaction_friction && !load.constant_friction && !load.passive && !load.stop && load.controllers.empty()) continue;
      if (!has_coordinate_[p][e]) refuse_load(load.pair, load.element);
      loads_.push_back(load);
    }
  }
}

void System::add_bristle(int pair, int element, int size) {
  const int joint = topology_.pairs[static_cast<std::size_t>(pair)].friction_joint;
  const FrictionModel model = robot_.joints[static_cast<std::size_t>(joint)].friction->model;
  if (model == FrictionModel::kBrownMcPhee) return;
  bristles_.push_back({model, pair, element, layout_.states, size});
  layout_.states += bristles_.back().states();
}

void System::collect_bristles() {
  for (const JointLoad& load : loads_)
    if (load.reaction_friction) add_bristle(load.pair, load.element, 1);
  for (int contact : contacts_)
    add_bristle(contact, -1, topology_.pairs[static_cast<std::size_t>(contact)].kind == PairKind::kTable ? 2 : 3);
}

const BristleContact* System::bristle(int pair, int element) const {
  for (const BristleContact& contact : bristles_)
    if (contact.pair == pair && contact.element == element) return &contact;
  return nullptr;
}

void System::find_coordinates() {
  for (const PairConstants<double>& pair : evaluate_constants(robot_, topology_, parameters()).pairs) {
    has_coordinate_.emplace_back();
    for (const CoordinateConstants<double>& c : pair.coordinates)
      has_coordinate_.back().push_back(c.kind != CoordinateConstants<double>::Kind::kNone);
  }
}

void System::refuse_load(int pair, int element) const {
  const ChainElement& in_chain = topology_.pairs[static_cast<std::size_t>(pair)].chain[static_cast<std::size_t>(element)];
  const JointDescription& joint = robot_.joints[static_cast<std::size_t>(in_chain.joint)];
  throw InputError({joint.where, "<joint name=\"" + joint.name + "\">",
                    "a controller, spring, damping, stop or stock friction on a joint without a scalar coordinate of its own",
                    topology_.pairs[static_cast<std::size_t>(pair)].name,
                    "revolute, continuous and prismatic joints; in a ball joint of three hinges those at right angles to each other"});
}

void System::check_couplings() const {
  for (const Coupling& coupling : topology_.couplings)
    for (const CouplingTerm& term : coupling.terms)
      if (!has_coordinate_[static_cast<std::size_t>(term.pair)][static_cast<std::size_t>(term.element)])
        throw InputError({coupling.where, coupling.element(),
                          "a joint of a chain of links without <inertial> has no coordinate in closed form",
                          robot_.joints[static_cast<std::size_t>(term.joint)].name,
                          "in a ball joint of three hinges, hinges at right angles to each other"});
}

void System::check_readable(const Signal& signal, const SignalDescription& description) const {
  for (const SignalReference& term : signal) {
    const bool coordinate = term.kind == SignalKind::kJointPosition || term.kind == SignalKind::kJointVelocity ||
                            term.kind == SignalKind::kJointAcceleration || term.kind == SignalKind::kJointSlidingVelocity;
    if (!coordinate || has_coordinate_[static_cast<std::size_t>(term.pair)][static_cast<std::size_t>(term.element)]) continue;
    throw InputError({description.where, "signal", "a joint of this chain of links without <inertial> has no coordinate in closed form",
                      description.text, "in a ball joint of three hinges, hinges at right angles to each other"});
  }
}

void System::record_pattern() {
  Equations<double> equations(*this);
  equations.set_design(parameters());
  State<double> state;
  state.resize(layout_);
  equations.load(state);
  PatternRecorder recorder;
  equations.assemble(&recorder);
  const int rows = layout_.columns() + 1;
  patterns_.position = PatternRecorder::build(recorder.calls().position, rows, layout_.positions(), &slots_.position);
  patterns_.velocity = PatternRecorder::build(recorder.calls().velocity, rows, layout_.n, &slots_.velocity);
  patterns_.rate = PatternRecorder::build(recorder.calls().rate, rows, layout_.columns(), &slots_.rate);
}

void System::refuse_unsupported() const {
  if (topology_.bodies.empty())
    throw InputError({{robot_.file, 0},
                      "<robot name=\"" + robot_.name + "\">",
                      "nothing moves: no link with an <inertial> hangs on a movable joint",
                      "",
                      ""});
}

}  // namespace codesign
