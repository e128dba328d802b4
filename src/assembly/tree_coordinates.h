// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "equations/equations.h"
#include "system/system.h"
#include "system/tree_kinematics.h"

namespace codesign {

/// Coordinates and rates of the joints of the tree, TreeLayout::size entries each.
struct TreeCoordinates {
  VectorX<double> theta, rate;
};

/// The tree coordinates of a state, the inverse of body_coordinates(). The turns of a floating
/// joint are about x, then y, then z.
/// @param equations must hold the design; they load `state`. @param rest coordinates of joints
/// below which nothing has mass, kept.
/// @param result sized and filled. @returns the joint whose coordinate cannot be computed (a hinge
/// of a folded chain without a closed form, a floating joint turned by 90 degrees about y), or an
/// empty text.
std::string tree_coordinates(const System& system, const TreeLayout& tree,
                             const State<double>& state, const VectorX<double>& rest,
                             Equations<double>* equations, TreeCoordinates* result);

/// Flags per tree coordinate (TreeLayout order): whether the study gives its position, a guess of
/// it, or its rate; and whether it gives the rates of other coordinates of the same planar or
/// floating joint only: such a rate stays at zero where the loops allow it.
struct GivenStart {
  std::vector<bool> position, guess, velocity, velocity_beside;

  GivenStart() = default;
  /// @param tree a motor behind an elastic gear whose position is given does not follow its joint
  /// any more: it is taken out of TreeLayout::motors.
  GivenStart(const System& system, TreeLayout* tree);
};

/// Sets the tree coordinates [rad or m] and rates that the study gives (guesses excepted) to their
/// values at `parameters`; other entries of `theta` and `rate`, both of tree.size, keep their
/// values. A given rotation of a floating joint leaves its turning coordinates at zero:
/// JointDescription::start_rotation holds the rotation.
/// @param posture number of a posture of the study; between two of them positions are interpolated.
template <class T>
void set_given_start(const System& system, const TreeLayout& tree, const std::vector<T>& parameters,
                     double posture, VectorX<T>* theta, VectorX<T>* rate);

/// The extra states at the start, Study::initial_extra_states and then zeros, with 1 for the dwell
/// states of contacts that start stuck; resized to Layout::states.
template <class T>
void set_extra_states(const System& system, const std::vector<T>& parameters, VectorX<T>* s);

}  // namespace codesign
