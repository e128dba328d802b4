// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// What acts on the coordinates and links of a system: loads, rotors, friction with states.
#include <algorithm>
#include <utility>

#include "description/study.h"
#include "math/arrays.h"
#include "system/system.h"

namespace codesign {

// A load must not depend on what it determines: on accelerations and reactions, nor on controllers
// that may read these.
void System::resolve_load_signals() {
  const auto resolve_function = [this](const LoadFunction& function) {
    if (!function.of_signals) return Signal();
    Signal signal = resolve_named(*function.of_signals);
    for (const SignalReference& term : signal)
      if (facts_of(term.kind).needs != SignalNeeds::kMotion)
        throw InputError({function.of_signals->where, "loads",
                          "a load cannot depend on accelerations, efforts, reactions, friction, "
                          "powers and outputs of controllers, which depend on the loads",
                          function.of_signals->text,
                          "positions, velocities, orientations, energies, lengths, speeds and "
                          "forces of springs, setpoints, parameters and the time t"});
    return signal;
  };
  for (const LoadDescription& load : study().loads) {
    LoadSignals& signals = load_signals_.emplace_back();
    signals.effort = resolve_function(load.effort);
    for (std::size_t k = 0; k < 3; ++k) {
      signals.force[k] = resolve_function(load.force[k]);
      signals.torque[k] = resolve_function(load.torque[k]);
    }
  }
}

void System::collect_elastic_gears() {
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
    const int motor = robot_.joints[j].motor;
    if (motor < 0) continue;
    const CouplingTerm of_joint = drive_of(robot_, topology_, static_cast<int>(j)).terms.front();
    const CouplingTerm of_motor = drive_of(robot_, topology_, motor).terms.front();
    elastic_gears_.push_back(
        {{of_joint.pair, of_joint.element}, {of_motor.pair, of_motor.element}});
  }
}

CoordinateIndex System::motor_of(int pair, int element) const {
  const CoordinateIndex joint{pair, element};
  for (const ElasticGear& gear : elastic_gears_)
    if (gear.joint == joint) return gear.motor;
  return joint;
}

void System::add_elastic_gear(JointLoad* load) const {
  const CoordinateIndex at{load->pair, load->element};
  for (std::size_t k = 0; k < elastic_gears_.size(); ++k) {
    const bool is_motor = elastic_gears_[k].motor == at;
    if (!is_motor && !(elastic_gears_[k].joint == at)) continue;
    load->parts.emplace_back(ElasticGearSide{static_cast<int>(k), is_motor});
    return;
  }
}

/// What acts along the coordinate of a joint but the bearing's friction, gears and efforts; sets
/// what is known of its gear's torque.
void System::add_loads_of(const JointDescription& joint, bool slips_in_contact, int* unknowns,
                          JointLoad* load) const {
  // The load of one coordinate would be that of a cylindrical joint's turn alone.
  if (joint.has_pose() && !(joint.damping.is_zero() && joint.dry_friction.is_zero()))
    refuse_load(load->pair, load->element);
  if (!joint.damping.is_zero() || joint.spring)
    load->parts.emplace_back(PassiveLoad{joint.spring.has_value()});
  if (!joint.dry_friction.is_zero()) load->parts.emplace_back(DryFriction{});
  if (study().limits.position && has_stops(joint)) load->parts.emplace_back(StopLoad{});
  // Behind an elastic gear the losses are the motor's, and the spring gives the torque.
  load->has_gear_torque = joint.has_gear_torque() && joint.motor < 0;
  if (!load->has_gear_torque) return;
  if (slips_in_contact)
    throw InputError({joint.actuator->where, joint.element() + " <codesign:actuator>",
                      "the joint is folded into one that slips in several directions with "
                      "friction, which the efficiency of a gear does not know",
                      topology_.pairs[to_index(load->pair)].name,
                      "no efficiency, or no <codesign:friction>"});
  if (layout_.is_cut(load->pair) && !joint.is_motor) load->gear_unknown = (*unknowns)++;
}

/// Efforts of the study, losses of the gear, and controllers. @param joint null: a coordinate
/// beyond those of the chain
void System::add_efforts(const JointDescription* joint, JointLoad* load) const {
  for (std::size_t k = 0; joint && k < study().loads.size(); ++k)
    if (study().loads[k].joint == joint->name)
      load->parts.emplace_back(GivenEffort{static_cast<int>(k)});
  if (joint && joint->actuator && joint->actuator->gear && joint->motor < 0)
    load->parts.emplace_back(GearLoss{});
  ControllerEffort effort;
  effort.saturated =
      joint && study().limits.effort && joint->limit && joint->limit->bounds_effort();
  const CoordinateIndex at{load->pair, load->element};
  const Winding* winding = nullptr;
  for (std::size_t k = 0; k < windings_.size(); ++k) {
    if (!windings_[k].acts || !(CoordinateIndex{windings_[k].pair, windings_[k].element} == at))
      continue;
    winding = &windings_[k];
    load->parts.emplace_back(WindingTorque{static_cast<int>(k)});
  }
  for (std::size_t c = 0; c < controllers_.size(); ++c)
    if (motor_of(controllers_[c].pair, controllers_[c].element) == at &&
        (!winding || study().controllers[c].gives_effort))
      effort.controllers.push_back(static_cast<int>(c));
  if (!effort.controllers.empty()) load->parts.emplace_back(std::move(effort));
}

void System::collect_loads() {
  int unknowns = 0;
  for (std::size_t p = 0; p < topology_.pairs.size(); ++p) {
    const Pair& pair = topology_.pairs[p];
    const bool contact = pair.friction_joint >= 0 && slips_isotropically(pair.kind);
    if (contact) contacts_.push_back(static_cast<int>(p));
    for (std::size_t e = 0; e < has_coordinate_[p].size(); ++e) {
      JointLoad load;
      load.pair = static_cast<int>(p);
      load.element = static_cast<int>(e);
      if (pair.friction_joint >= 0 && !contact) {
        const FrictionDescription& f = *robot_.joints[to_index(pair.friction_joint)].friction;
        load.parts.emplace_back(BearingFriction{f.is_direct, f.is_directional, f.has_exponent});
      }
      const JointDescription* joint =
          e < pair.chain.size() ? &robot_.joints[to_index(pair.chain[e].joint)] : nullptr;
      if (joint) add_loads_of(*joint, contact, &unknowns, &load);
      add_elastic_gear(&load);
      add_efforts(joint, &load);
      if (load.parts.empty() && !load.has_gear_torque) continue;
      if (!has_coordinate_[p][e]) refuse_load(load.pair, load.element);
      loads_.push_back(std::move(load));
    }
  }
}

void System::collect_link_loads() {
  for (std::size_t k = 0; k < study().loads.size(); ++k) {
    const LoadDescription& load = study().loads[k];
    for (std::size_t joint = 0; joint < robot_.joints.size(); ++joint)
      if (robot_.joints[joint].name == load.joint && topology_.joint_pair[joint] < 0)
        throw InputError({load.where, "loads",
                          "the joint moves only a link without <inertial>, so a load on it has "
                          "nothing to act on",
                          load.joint, "a joint whose child link has an <inertial>"});
    for (std::size_t link = 0; link < robot_.links.size(); ++link) {
      if (robot_.links[link].name != load.link) continue;
      const int body = topology_.link_body[link];
      if (body == Topology::kGround)
        throw InputError({load.where, "loads",
                          "the link is part of the ground, which no load moves", load.link,
                          "a link that moves"});
      if (body == Topology::kMassless)
        throw InputError(
            {load.where, "loads",
             "the link has no <inertial>, so it is folded into a joint and cannot be loaded",
             load.link, "a link with <inertial>"});
      link_loads_.push_back(
          {static_cast<int>(k), body, static_cast<int>(link), load.in_link_frame});
    }
  }
}

/// Adds the rotor of a joint, or its armature, which no body carries.
void System::add_rotor(int joint, int body, bool is_armature) {
  const int pair = topology_.joint_pair[to_index(joint)];
  const std::vector<ChainElement>& chain = topology_.pairs[to_index(pair)].chain;
  for (std::size_t e = 0; e < chain.size(); ++e) {
    if (chain[e].joint != joint) continue;
    if (!has_coordinate_[to_index(pair)][e]) refuse_load(pair, static_cast<int>(e));
    rotors_.push_back({pair, static_cast<int>(e), body, is_armature});
  }
}

void System::collect_rotors() {
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
    const JointDescription& joint = robot_.joints[j];
    if (joint.motor >= 0) continue;
    const bool turns = joint.actuator && !joint.actuator->rotor_inertia.is_zero(),
               has_armature = !joint.armature.is_zero();
    const int pair = topology_.joint_pair[j], body = topology_.link_body[to_index(joint.parent)];
    const auto refuse = [&joint](const std::string& fault, const std::string& value) {
      throw InputError({joint.actuator->where, joint.element() + " <codesign:actuator>", fault,
                        value,
                        "a link with <inertial>, which holds the rotor's mass and its inertia as "
                        "if it did not spin"});
    };
    if (pair < 0 && joint.actuator && (turns || has_armature || joint.actuator->gear))
      refuse("the joint moves only a link without <inertial>",
             robot_.links[to_index(joint.child)].name);
    if (turns && body == Topology::kMassless)
      refuse("the parent link, which carries the rotor, has no <inertial>",
             robot_.links[to_index(joint.parent)].name);
    if (turns) add_rotor(static_cast<int>(j), body, false);
    if (has_armature && pair >= 0) add_rotor(static_cast<int>(j), Topology::kGround, true);
  }
}

const FrictionLaw& System::friction_law(int pair) const {
  return *robot_.joints[to_index(topology_.pairs[to_index(pair)].friction_joint)].friction->model;
}

const FrictionLaw& System::gear_law(int pair, int element) const {
  const ChainElement& at = topology_.pairs[to_index(pair)].chain[to_index(element)];
  return *robot_.joints[to_index(at.joint)].actuator->gear->slip.model;
}

void System::add_bristle(BristleContact contact) {
  if (!contact.model->bristle) return;
  contact.first = layout_.states;
  bristles_.push_back(contact);
  layout_.states += contact.states();
}

void System::collect_bristles() {
  for (const JointLoad& load : loads_) {
    if (load.find<BearingFriction>())
      add_bristle({friction_law(load.pair), load.pair, load.element, 0, 1, false});
    if (load.find<GearLoss>())
      add_bristle({gear_law(load.pair, load.element), load.pair, load.element, 0, 1, true});
  }
  for (int contact : contacts_)
    add_bristle({friction_law(contact), contact, -1, 0,
                 topology_.pairs[to_index(contact)].kind->slip_coordinates, false});
}

void System::collect_stuck() {
  const auto joint_of = [this](const BristleContact& contact) {
    const Pair& pair = topology_.pairs[to_index(contact.pair)];
    const int own =
        contact.gear ? pair.chain[to_index(contact.element)].joint : pair.friction_joint;
    for (const JointDescription& joint : robot_.joints)
      if (joint.motor == own) return joint.name;
    return robot_.joints[to_index(own)].name;
  };
  for (std::size_t start = 0; start < study().initial_state.size(); ++start)
    for (const bool gear : {false, true})
      for (std::size_t k = 0; k < bristles_.size(); ++k)
        if (const InitialJointState& initial = study().initial_state[start];
            initial.stuck && bristles_[k].gear == gear && joint_of(bristles_[k]) == initial.joint)
          stuck_.push_back({k, start});
}

bool System::begins_steadily(std::size_t k) const {
  const auto holds = [k](const StuckContact& stuck) { return stuck.bristle == k; };
  return to_index(bristles_[k].first) >= study().initial_extra_states.size() &&
         std::none_of(stuck_.begin(), stuck_.end(), holds);
}

bool System::begins_bristles() const {
  for (std::size_t k = 0; k < bristles_.size(); ++k)
    if (bristles_[k].model->steady && begins_steadily(k)) return true;
  return false;
}

const BristleContact* System::bristle(int pair, int element, bool gear) const {
  for (const BristleContact& contact : bristles_)
    if (contact.pair == pair && contact.element == element && contact.gear == gear) return &contact;
  return nullptr;
}

void System::refuse_load(int pair, int element) const {
  const ChainElement& in_chain = topology_.pairs[to_index(pair)].chain[to_index(element)];
  const JointDescription& joint = robot_.joints[to_index(in_chain.joint)];
  throw InputError({joint.where, joint.element(),
                    "a controller, load, actuator, spring, damping, stop or stock friction on a "
                    "joint without a scalar coordinate of its own",
                    topology_.pairs[to_index(pair)].name,
                    "revolute, continuous and prismatic joints; in a ball joint of three hinges "
                    "those at right angles to each other"});
}

}  // namespace codesign
