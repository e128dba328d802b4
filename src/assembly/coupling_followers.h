// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "math/arrays.h"
#include "sparse/least_squares.h"
#include "system/tree_kinematics.h"

namespace codesign {

struct Posture;
class System;
template <class T>
class Equations;
template <class T>
struct ReferenceMotion;

/// The coordinates that follow others by couplings, doc/theory.md (8a): of each coupling the first
/// one, unless it belongs to a loop. The same for all designs.
class CouplingFollowers {
 public:
  /// @param system, tree must outlive this.
  CouplingFollowers(const System& system, const TreeLayout& tree);

  /// Whether a coordinate follows others.
  bool follows(int coordinate) const { return follows_[to_index(coordinate)]; }
  /// Sets the followers that have neither position nor guess, and the rates of those without a
  /// given one, to what the couplings imply at the posture's time.
  void follow(const Equations<double>& equations, Posture* posture) const;
  /// The motion that the k-th coupling has at a time [s]; at rest in zero if none is given.
  ReferenceMotion<double> given_motion(const Equations<double>& equations, std::size_t k,
                                       double time) const;
  /// Sets the flags of the followers whose couplings have a given motion.
  void mark_driven(std::vector<bool>* flags) const;
  /// Sets the first two lists of column preferences: followers, then the other coordinates, in both
  /// of them those that are not `given`.
  void by_preference(const std::vector<bool>& given, ColumnPreferences* lists) const;

 private:
  const System& system_;
  const TreeLayout& tree_;
  /// per coupling: the coordinate that follows the others; -1 for the drive of a loop
  std::vector<int> followers_;
  std::vector<bool> follows_;  ///< per coordinate: whether it is in followers_
};

}  // namespace codesign
