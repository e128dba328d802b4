// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/system.h"

#include <algorithm>
#include <utility>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "mechanism/motor_sides.h"
#include "mechanism/signal_catalog.h"
#include "system/tree_kinematics.h"

namespace codesign {
namespace {

constexpr const char* kOfBalls =
    "in a ball joint of three hinges, each at right angles to the next, and where the first and "
    "the third are parallel (proper Euler angles) an initial_state of the second whose position or "
    "guess is no multiple of pi";

/// Whether a signal needs the wrenches that joints transmit. Where a spring gives the torque of a
/// gear, this torque does not.
bool depends_on_reactions(const SignalTerm& term, const RobotDescription& robot) {
  const int joint = joint_named(robot, term.object);
  if (term.quantity == "gear_torque" && joint >= 0 && robot.joints[to_index(joint)].motor >= 0)
    return false;
  const auto& facts = signal_table::kFacts;
  return std::any_of(facts.begin(), facts.end(), [&term](const SignalFacts& one) {
    return one.quantity == term.quantity && one.needs == SignalNeeds::kReactions;
  });
}

}  // namespace

System::System(const RobotDescription& robot, const Study& study, ReactionSharing sharing,
               const std::vector<int>& drives)
    : robot_(with_motor_sides(with_start(robot, study), study)),
      study_(std::make_shared<const Study>(study)),
      motion_(study_.get()),
      topology_(derive_topology(robot_)),
      sharing_(std::move(sharing)) {
  add_drives(drives);
  refuse_unsupported();
  choose_forest();
  lay_out();
  find_coordinates();
  check_couplings();
  resolve_objective();
  resolve_load_signals();
  resolve_controllers();
  check_signals();
  collect_elastic_gears();
  collect_windings();
  collect_loads();
  collect_link_loads();
  collect_rotors();
  collect_bristles();
  collect_stuck();
}

std::vector<double> System::parameters() const { return start_parameters(study()); }

std::vector<double> System::parameters(const Eigen::VectorXd& rho) const {
  return parameters_at(study(), rho);
}

void System::add_drives(const std::vector<int>& drives) {
  for (std::size_t k = 0; k < study().motion.size(); ++k) {
    const GivenMotion& motion = study().motion[k];
    const int joint = joint_named(robot_, motion.joint);
    if (topology_.joint_pair[to_index(joint)] < 0)
      throw InputError({motion.where, "motion." + motion.joint,
                        "the joint moves only a link without <inertial>, so that its motion has no "
                        "effect",
                        motion.joint, "a joint whose child link has an <inertial>"});
    Coupling drive = drive_of(robot_, topology_, joint);
    drive.motion = static_cast<int>(k);
    drive.where = motion.where;
    topology_.couplings.push_back(std::move(drive));
  }
  for (int joint : drives) topology_.couplings.push_back(drive_of(robot_, topology_, joint));
  drives_ = static_cast<int>(drives.size());
}

void System::choose_forest() {
  if (study().solver.coordinates != CoordinatesKind::kJoint) return;
  if (const SignalDescription* signal = mechanism_friction())
    throw InputError({study().solver.coordinates_where, "solver.coordinates",
                      "a controller that reads the friction of the whole mechanism: not available "
                      "in joint coordinates",
                      signal->text, "auto or absolute"});
  layout_.forest = tree_forest(topology_, cut_pairs());
}

CoordinatesKind System::best_coordinates() const {
  // In joint coordinates motions can be polynomials, which idas follows exactly in a few steps too
  // long for its quadratures.
  const bool is_possible =
      study().solver.integrator != IntegratorKind::kIdas && !mechanism_friction();
  return is_possible ? CoordinatesKind::kJoint : CoordinatesKind::kAbsolute;
}

/// The inputs of all controllers.
std::vector<const SignalDescription*> System::controller_inputs() const {
  std::vector<const SignalDescription*> inputs;
  for (const ControllerDescription& controller : study().controllers) {
    inputs.push_back(&controller.input);
    for (const FeedbackTerm& term : controller.feedback) inputs.push_back(&term.signal);
  }
  return inputs;
}

/// An input that reads friction of all joints, which would have to be known before the wrenches on
/// which it depends; null if there is none.
const SignalDescription* System::mechanism_friction() const {
  for (const SignalDescription* input : controller_inputs())
    for (const SignalTerm& term : input->terms)
      if (depends_on_reactions(term, robot_) && joint_named(robot_, term.object) < 0) return input;
  return nullptr;
}

/// Pairs that have rows in joint coordinates too: those that share reactions, (23), and those whose
/// reactions a controller reads, which are then multipliers and known before the wrenches of the
/// other joints, to which the controller contributes. And joints that cut long chains.
std::vector<bool> System::cut_pairs() const {
  std::vector<bool> cut(topology_.pairs.size(), false);
  for (int pair : sharing_.pairs) cut[to_index(pair)] = true;
  for (const SignalDescription* input : controller_inputs())
    for (const SignalTerm& term : input->terms)
      if (depends_on_reactions(term, robot_))
        if (const int pair = topology_.joint_pair[to_index(joint_named(robot_, term.object))];
            pair >= 0)
          cut[to_index(pair)] = true;
  cut_long_chains(topology_, &cut);
  return cut;
}

void System::lay_out_bodies() {
  layout_.bodies = static_cast<int>(topology_.bodies.size());
  layout_.n = kBodySize * layout_.bodies;
  if (!layout_.has_forest()) return;
  layout_.n = 0;
  int norms = 0;
  for (int body = 0; body < layout_.bodies; ++body) {
    const bool free = layout_.is_free(body);
    layout_.body_column.push_back(layout_.n);
    layout_.body_norm_row.push_back(free ? norms++ : -1);
    layout_.n += free ? kBodySize
                      : forest_coordinates(
                            topology_.pairs[to_index(layout_.forest.pair_above[to_index(body)])]);
  }
}

void System::lay_out() {
  lay_out_bodies();
  for (std::size_t p = 0; p < topology_.pairs.size(); ++p) {
    layout_.pair_row.push_back(layout_.m);
    if (layout_.is_cut(static_cast<int>(p))) layout_.m += topology_.pairs[p].kind->rows;
  }
  layout_.couplings = static_cast<int>(topology_.couplings.size());
  layout_.m += layout_.couplings + layout_.norms();
  sharing_layout_ = SharingLayout(sharing_, topology_, layout_);
  layout_.sharing = sharing_layout_.size();
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
    const int pair = topology_.joint_pair[j];
    const bool of_spring = robot_.joints[j].motor >= 0 || robot_.joints[j].is_motor;
    if (pair >= 0 && layout_.is_cut(pair) && robot_.joints[j].has_gear_torque() && !of_spring)
      ++layout_.gears;
  }
  layout_.m += layout_.sharing + layout_.gears;
}

void System::resolve_objective() {
  const auto resolve = [this](const std::vector<ObjectiveTerm>& terms,
                              std::vector<ResolvedTerm>* resolved) {
    for (std::size_t k = 0; k < terms.size(); ++k) {
      resolved->push_back({resolve_named(terms[k].signal), static_cast<int>(k), terms[k].loss});
    }
  };
  resolve(study().integral, &integral_);
  resolve(study().terminal, &terminal_);
  for (const WatchedSignal& watched : study().watched)
    if (!watched.linear) watched_.push_back(resolve_named(watched.signal));
  if (study().until) until_ = resolve_named(*study().until);
}

Signal System::resolve_named(const SignalDescription& signal) {
  Signal resolved =
      resolve_signal(signal, robot_, topology_, study().controllers, study().parameters);
  reads_time_ = reads_time_ || codesign::reads_time(resolved);
  return resolved;
}

void System::resolve_controllers() {
  std::vector<Signal> observed;
  for (const std::vector<ResolvedTerm>* terms : {&integral_, &terminal_})
    for (const ResolvedTerm& term : *terms) observed.push_back(term.signal);
  observed.insert(observed.end(), watched_.begin(), watched_.end());
  if (until_) observed.push_back(*until_);
  controllers_ =
      codesign::resolve_controllers(study(), robot_, topology_, observed, &layout_.states);
  for (const Controller& controller : controllers_) {
    const std::vector<Signal>& read = controller.feedback;
    reads_time_ = reads_time_ || codesign::reads_time(controller.input) ||
                  std::any_of(read.begin(), read.end(), codesign::reads_time);
  }
}

void System::check_signals() const {
  for (std::size_t k = 0; k < study().controllers.size(); ++k) {
    const ControllerDescription& description = study().controllers[k];
    check_readable(controllers_[k].input, description.input);
    for (std::size_t term = 0; term < description.feedback.size(); ++term)
      check_readable(controllers_[k].feedback[term], description.feedback[term].signal);
  }
  const auto check = [this](const std::vector<ResolvedTerm>& resolved,
                            const std::vector<ObjectiveTerm>& terms) {
    for (const ResolvedTerm& term : resolved)
      check_readable(term.signal, terms[to_index(term.description)].signal);
  };
  check(integral_, study().integral);
  check(terminal_, study().terminal);
  for (std::size_t k = 0; k < watched_.size(); ++k)
    check_readable(watched_[k], study().watched[k].signal);
  if (until_) check_readable(*until_, *study().until);
}

bool System::begins_controllers() const {
  return std::any_of(controllers_.begin(), controllers_.end(),
                     [](const Controller& controller) { return controller.has_start(); });
}

void System::find_coordinates() {
  for (const PairConstants<double>& pair :
       evaluate_constants(robot_, topology_, parameters()).pairs) {
    layout_.turn_slot.push_back(static_cast<int>(layout_.initial_turns.size()));
    layout_.initial_turns.resize(layout_.initial_turns.size() + pair.coordinates.size(), 0.0);
    has_coordinate_.emplace_back();
    for (const CoordinateConstants<double>& c : pair.coordinates)
      has_coordinate_.back().push_back(c.kind != CoordinateConstants<double>::Kind::kNone);
  }
  layout_.drop_slot = static_cast<int>(layout_.initial_turns.size());
  layout_.initial_turns.resize(layout_.initial_turns.size() + to_index(sharing_layout_.misses),
                               0.0);
  for (const SharedRow& row : sharing_.dropped) {
    dropped_rows_.push_back(row.pair >= 0 ? layout_.pair_row[to_index(row.pair)] + row.within
                                          : layout_.coupling_row(row.coupling));
    layout_.initial_turns[to_index(
        layout_.drop_slot + sharing_layout_.miss_slot[to_index(dropped_rows_.back())])] = 1.0;
  }
  std::sort(dropped_rows_.begin(), dropped_rows_.end());
  layout_.sign_slot = static_cast<int>(layout_.initial_turns.size());
  if (layout_.has_forest())
    layout_.initial_turns.resize(layout_.initial_turns.size() + topology_.bodies.size(), 1.0);
}

void System::check_couplings() const {
  for (const Coupling& coupling : topology_.couplings)
    for (const CouplingTerm& term : coupling.terms)
      if (!has_coordinate_[to_index(term.pair)][to_index(term.element)])
        throw InputError(
            {coupling.where, coupling.element(),
             "a joint of a chain of links without <inertial> has no coordinate in closed form",
             robot_.joints[to_index(term.joint)].name, kOfBalls});
}

void System::check_effort_rate(const SignalReference& term,
                               const SignalDescription& description) const {
  for (const Coupling& drive : topology_.couplings)
    if (drive.motion >= 0 && drive.terms.front().pair == term.pair &&
        drive.terms.front().element == term.element)
      throw InputError(
          {description.where, "signal",
           "the motion of the joint is given, and the rate of the effort that it needs "
           "is not available",
           description.text, drive.name + "/effort"});
  // The current has a rate of its own.
  const std::vector<ChainElement>& chain = topology_.pairs[to_index(term.pair)].chain;
  if (to_index(term.element) < chain.size()) {
    const JointDescription& joint = robot_.joints[to_index(chain[to_index(term.element)].joint)];
    if (joint.has_winding() && joint.actuator->winding->has_state()) return;
  }
  for (std::size_t c = 0; c < controllers_.size(); ++c) {
    if (controllers_[c].pair != term.pair || controllers_[c].element != term.element ||
        controllers_[c].has_output_rate)
      continue;
    const ControllerDescription& controller = study().controllers[c];
    const bool sampled = controller.realization.is_sampled();
    throw InputError(
        {description.where, "signal",
         "the effort of the joint has no rate: the output of the controller \"" + controller.name +
             "\" " +
             (sampled ? "jumps at its samples" : "contains a signal whose rate is not available"),
         description.text,
         "give the controller a time_constant" +
             std::string(sampled ? "" : " or a derivative_filter")});
  }
}

void System::check_readable(const Signal& signal, const SignalDescription& description) const {
  for (const SignalReference& term : signal) {
    if (term.kind == SignalKind::kControllerIntegral &&
        controllers_[to_index(term.controller)].state < 0)
      throw InputError({description.where, "signal",
                        "the controller has no i gain, so that its error is not integrated",
                        description.text,
                        "an i gain, or the signal in the objective or in a later controller"});
    if (term.kind == SignalKind::kJointEffortRate) check_effort_rate(term, description);
    const bool coordinate = term.kind == SignalKind::kJointPosition ||
                            term.kind == SignalKind::kJointVelocity ||
                            term.kind == SignalKind::kJointAcceleration ||
                            term.kind == SignalKind::kJointSlidingVelocity;
    if (!coordinate || has_coordinate_[to_index(term.pair)][to_index(term.element)]) continue;
    throw InputError(
        {description.where, "signal",
         "a joint of this chain of links without <inertial> has no coordinate in closed form",
         description.text, kOfBalls});
  }
}

void System::refuse_unsupported() const {
  if (topology_.bodies.empty())
    throw InputError(
        {robot_.links[to_index(robot_.root)].where, "<robot name=\"" + robot_.name + "\">",
         "nothing moves: no link with an <inertial> hangs on a movable joint", "",
         "at least one link with <inertial> below a joint that is not fixed; <inertial "
         "codesign:density=\"...\"/> of an overlay computes it from shapes and meshes; "
         "or, if the whole model moves freely, base: floating in the study, or --base "
         "floating on the command line"});
}

}  // namespace codesign
