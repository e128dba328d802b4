// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MECHANISM_SIGNAL_CATALOG_H_
#define MECHANISM_CODESIGN_MECHANISM_SIGNAL_CATALOG_H_

#include <string>
#include <vector>

#include "description/robot.h"
#include "description/study.h"

namespace codesign {

/// Whether a joint has one coordinate, and so a scalar position, velocity, acceleration and effort.
bool has_scalar_position(const JointDescription& joint);

/// Whether a joint or loop has friction, annotated or as `<dynamics friction>`.
bool has_friction(const JointDescription& joint);

/// Whether a term reads the whole mechanism, such as `mechanism/total_energy`. Joints, links and controllers may bear that name too: the
/// quantity tells which is meant, and where it does not, check_signal() refuses the term.
bool is_of_mechanism(const SignalTerm& term);

/// Whether a term reads what a joint exerts on its child: the quantity tells it from a link of the same name.
bool is_reaction(const SignalTerm& term);

/// Checks that every term of a signal names something that exists and has that quantity.
/// @throws InputError naming the term, what is allowed and the nearest known name.
void check_signal(const SignalDescription& signal, const RobotDescription& robot, const std::vector<ControllerDescription>& controllers,
                  const std::string& element);

/// What is worth plotting of any run: position and velocity of every joint that moves a mass, friction, normal force and sliding velocity
/// where there is friction, and each controller's output.
std::vector<std::string> default_signals(const RobotDescription& robot, const std::vector<ControllerDescription>& controllers);

/// The signals that a study itself reads, each once: those of its objective, then those of its controllers.
std::vector<SignalDescription> signals_of(const Study& study);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MECHANISM_SIGNAL_CATALOG_H_
