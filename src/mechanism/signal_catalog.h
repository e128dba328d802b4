// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "description/motion_study.h"
#include "description/robot.h"
#include "description/signal_table.h"

namespace codesign {

/// Whether a term is a quantity of the whole mechanism, such as `mechanism/total_energy`. The
/// quantity distinguishes it from a joint, link or controller named `mechanism`; check_signal()
/// rejects the terms that stay ambiguous.
bool is_of_mechanism(const SignalTerm& term);
/// An element between two links, for_each_link_element_kind().
struct LinkElement {
  SignalOwner kind;
  int index;  ///< in the list of its kind in RobotDescription
};
/// The element between links that a term is a quantity of: one has the name of the object, and its
/// kind the quantity.
std::optional<LinkElement> find_link_element(const SignalTerm& term, const RobotDescription& robot);
/// Whether a term is a reaction force or torque of a joint. The quantity distinguishes the joint
/// from a link of the same name.
bool is_reaction(const SignalTerm& term);

/// Checks that the object of each term exists and has the quantity and component.
/// @throws InputError naming the term, the allowed ones and the nearest known name.
void check_signal(const SignalDescription& signal, const RobotDescription& robot,
                  const std::vector<ControllerDescription>& controllers,
                  const std::string& element);

/// The signals recorded by default: position and velocity of every joint that moves a mass;
/// friction, normal force and sliding velocity of every joint with friction; loss and torque of
/// every gear that loses; gap and normal force of every contact; the output of each controller.
std::vector<std::string> default_signals(const RobotDescription& robot,
                                         const std::vector<ControllerDescription>& controllers);

/// The signals that a study uses, each once: the signals of its objective and constraints, then the
/// signals of its controllers.
std::vector<SignalDescription> signals_of(const MotionStudy& study);

}  // namespace codesign
