// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/robot.h"
#include "mechanism/pair_geometry.h"
#include "mechanism/topology.h"

namespace codesign {

// Loops whose motion is planar and that are held in this plane only, theory (23c). The joints
// around such a loop turn about the normal of the plane and slide across it, so that the normal is
// the same vector of a body in all positions: it is found with all joints at zero.

/// Whether a pair is a loop that is held in the plane of its motion only.
inline bool is_in_plane(const RobotDescription& robot, const Pair& pair) {
  return pair.chain.size() == 1 && robot.joints[to_index(pair.chain[0].joint)].in_plane;
}

/// The joints around a loop: those of the tree from its predecessor to its successor, then the loop
/// itself, reversed. Fixed joints are left out. @param link_parent_joint as of Topology
std::vector<ChainElement> joints_around(const RobotDescription& robot,
                                        const std::vector<int>& link_parent_joint, int loop);

/// The axis of the first joint that turns: of the loop itself if it does, else of the joints around
/// it. Unit vector in the axes of the base link of body i. @param pair with Pair::around, one of
/// which turns
template <class T>
Vector3<T> plane_normal(const RobotDescription& robot, const Topology& topology, const Pair& pair,
                        const std::vector<T>& parameters) {
  const auto turns = [&](const ChainElement& element) {
    return robot.joints[to_index(element.joint)].law().turns_in_plane();
  };
  if (turns(pair.chain[0])) return chain_geometry(robot, topology, pair.chain, parameters).axes[0];
  std::size_t k = 0;
  while (!turns(pair.around[k])) ++k;
  return chain_geometry(robot, topology, pair.around, parameters).axes[k];
}

/// What keeps a loop from being planar.
struct PlaneFault {
  std::string message;  ///< empty if it is planar
  std::string value;    ///< by how much
};

/// The first joint around a loop that moves out of the plane by more than 1e-3 rad, or by how much
/// the loop misses itself across its plane, more than 1e-3 rad or 1e-3 m. @param pair with
/// Pair::around
PlaneFault find_plane_fault(const RobotDescription& robot, const Topology& topology,
                            const Pair& pair, const std::vector<double>& parameters);

/// Whether a pair is a loop that could be held in its plane only, at these parameters.
bool could_be_in_plane(const RobotDescription& robot, const Topology& topology, Pair pair,
                       const std::vector<double>& parameters);

/// @throws InputError if find_plane_fault() finds one at the default parameters.
void require_planar(const RobotDescription& robot, const Topology& topology, const Pair& pair);

}  // namespace codesign
