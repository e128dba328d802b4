// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mechanism/constants.h"

namespace codesign {

/// Joint points, axes, coordinates and coefficients of a pair at `parameters`.
/// @param centre_i, centre_j centres of mass of the two bodies in the frames of their base links [m]; zero for the ground.
/// @param constants overwritten, its memory is used again.
template <class T>
void pair_constants(const RobotDescription& robot, const Topology& topology, const Pair& pair, const Vector3<T>& centre_i,
                    const Vector3<T>& centre_j, const std::vector<T>& parameters, PairConstants<T>* constants);
template <class T>
PairConstants<T> pair_constants(const RobotDescription& robot, const Topology& topology, const Pair& pair, const Vector3<T>& centre_i,
                                const Vector3<T>& centre_j, const std::vector<T>& parameters) {
  PairConstants<T> constants;
  pair_constants(robot, topology, pair, centre_i, centre_j, parameters, &constants);
  return constants;
}

}  // namespace codesign
