// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The parts of System that find what acts on joints and links.
#include <algorithm>

#include "math/arrays.h"
#include "mechanism/topology.h"
#include "system/system.h"

namespace codesign {

// A load must not depend on what it determines: on accelerations and reactions, nor on controllers
// that may read these.
void System::resolve_load_signals() {
  const auto resolve_function = [this](const LoadFunction& function) {
    if (!function.of_signals) return Signal();
    Signal signal = resolve_named(*function.of_signals);
    for (const SignalReference& term : signal)
      if (!is_of_motion(term.kind))
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

void System::collect_loads() {
  for (std::size_t p = 0; p < topology_.pairs.size(); ++p) {
    const Pair& pair = topology_.pairs[p];
    const bool contact = pair.friction_joint >= 0 && slips_isotropically(pair.kind);
    if (contact) contacts_.push_back(static_cast<int>(p));
    for (std::size_t e = 0; e < has_coordinate_[p].size(); ++e) {
      JointLoad load;
      load.pair = static_cast<int>(p);
      load.element = static_cast<int>(e);
      load.reaction_friction = pair.friction_joint >= 0 && !contact;
      load.directional = load.reaction_friction &&
                         robot_.joints[to_index(pair.friction_joint)].friction->is_directional;
      if (e < pair.chain.size()) {
        const JointDescription& joint = robot_.joints[to_index(pair.chain[e].joint)];
        load.constant_friction = !joint.dry_friction.is_zero();
        load.spring = joint.spring.has_value();
        load.passive = !joint.damping.is_zero() || load.spring;
        load.stop = study().limits.position && has_stops(joint);
        load.saturated = study().limits.effort && joint.limit && joint.limit->bounds_effort();
        for (std::size_t k = 0; k < study().loads.size(); ++k)
          if (study().loads[k].joint == joint.name) load.given.push_back(static_cast<int>(k));
      }
      for (std::size_t c = 0; c < topology_.couplings.size(); ++c)
        if (const Coupling& drive = topology_.couplings[c];
            drive.motion >= 0 && drive.terms.front().pair == load.pair &&
            drive.terms.front().element == load.element)
          load.drive = static_cast<int>(c);
      for (std::size_t c = 0; c < controllers_.size(); ++c)
        if (controllers_[c].pair == load.pair && controllers_[c].element == load.element)
          load.controllers.push_back(static_cast<int>(c));
      const bool driven = !load.controllers.empty() || !load.given.empty() || load.drive >= 0;
      if (!load.reaction_friction && !load.constant_friction && !load.passive && !load.stop &&
          !driven)
        continue;
      if (!has_coordinate_[p][e]) refuse_load(load.pair, load.element);
      loads_.push_back(load);
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

void System::collect_rotors() {
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
    const JointDescription& joint = robot_.joints[j];
    if (!joint.actuator || joint.actuator->rotor_inertia.is_zero()) continue;
    const auto refuse = [&joint](const std::string& fault, const std::string& value) {
      throw InputError({joint.actuator->where, joint.element() + " <codesign:actuator>", fault,
                        value,
                        "a link with <inertial>, which holds the rotor's mass and its inertia as "
                        "if it did not spin"});
    };
    const int pair = topology_.joint_pair[j], body = topology_.link_body[to_index(joint.parent)];
    if (pair < 0)
      refuse("the joint moves only a link without <inertial>",
             robot_.links[to_index(joint.child)].name);
    if (body == Topology::kMassless)
      refuse("the parent link, which carries the rotor, has no <inertial>",
             robot_.links[to_index(joint.parent)].name);
    const std::vector<ChainElement>& chain = topology_.pairs[to_index(pair)].chain;
    for (std::size_t e = 0; e < chain.size(); ++e) {
      if (chain[e].joint != static_cast<int>(j)) continue;
      if (!has_coordinate_[to_index(pair)][e]) refuse_load(pair, static_cast<int>(e));
      rotors_.push_back({pair, static_cast<int>(e), body});
    }
  }
}

const FrictionLaw& System::friction_law(int pair) const {
  return *robot_.joints[to_index(topology_.pairs[to_index(pair)].friction_joint)].friction->model;
}

void System::add_bristle(int pair, int element, int size) {
  const FrictionLaw& law = friction_law(pair);
  if (!law.bristle) return;
  bristles_.push_back({law, pair, element, layout_.states, size});
  layout_.states += bristles_.back().states();
}

void System::collect_bristles() {
  for (const JointLoad& load : loads_)
    if (load.reaction_friction) add_bristle(load.pair, load.element, 1);
  for (int contact : contacts_)
    add_bristle(contact, -1, topology_.pairs[to_index(contact)].kind->slip_coordinates);
}

const BristleContact* System::bristle(int pair, int element) const {
  for (const BristleContact& contact : bristles_)
    if (contact.pair == pair && contact.element == element) return &contact;
  return nullptr;
}

}  // namespace codesign
