// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "assembly/redundancy.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

class CompiledSystem;

/// A joint or loop that gets more freedom: codesign:spherical in place of a hinge, or
/// codesign:cylindrical in place of a hinge or slide.
struct Release {
  int joint = -1;  ///< in the description
  JointType type = JointType::kSpherical;
};

/// The smallest set of releases with which no self-stress loads a joint with friction, so that
/// rigid bodies determine all friction. Each of its freedoms removes one redundant constraint, so
/// that the mechanism gets no new motion. Loops come before joints of the tree. Sets of at most
/// three joints are compared; where these do not suffice, or are too many, the set is found one by
/// one and holds no release that is not needed. Empty if there is none.
/// @param state the position at which `redundancy` was found. @param equations must hold its
/// design.
std::vector<Release> releases_for_friction(const CompiledSystem& system,
                                           const Redundancy& redundancy, const State<double>& state,
                                           Equations<double>* equations);

/// What removes a warning of reactions that are not unique, checked by the rank of the constraints
/// that remain.
std::string advice_of(const RobotDescription& robot, const std::vector<Release>& releases);

/// That the loops may be held in their plane, which determines all reactions, if all loops that
/// share them are planar; else empty.
std::string plane_advice(const CompiledSystem& system, const ReactionSharing& sharing);

/// The names of joints: 'a', 'b'.
std::string name_list(const RobotDescription& robot, const std::vector<int>& joints);

/// By how much other distributions of the reactions than that of least norm change the normal
/// forces of Redundancy::chosen_joints, relative to the largest of these. Each distribution has the
/// least norm with other weights of the reactions, between 0.1 and 10, as bearings of other
/// stiffness have. -1 if there are no loads.
/// @param state with multipliers.
double effect_of_sharing(const CompiledSystem& system, const Redundancy& redundancy,
                         State<double> state, Equations<double>* equations);

/// `undetermined_reaction` for each signal that reads a component of a reaction that is not unique.
/// @param state the state at which `redundancy` was found. @param equations must hold its design.
Warnings warn_of_open_reactions(const CompiledSystem& system, const Redundancy& redundancy,
                                const State<double>& state,
                                const std::vector<SignalDescription>& signals,
                                Equations<double>* equations);

/// The same for signals that are not in the study, at the start of a compiled system at its own
/// parameters. None if the positions of the start cannot be found.
Warnings warn_of_open_reactions(const CompiledSystem& system,
                                const std::vector<SignalDescription>& signals);

}  // namespace codesign
