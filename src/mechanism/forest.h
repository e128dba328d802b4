// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace codesign {

struct Pair;
struct Topology;

/// Which pairs of a mechanism give joint coordinates, doc/theory.md (56). Every body hangs on at
/// most one pair, by which it moves relative to its parent, the pair's body i; bodies that hang on
/// none are free. All lists are empty if no body hangs on a pair.
struct Forest {
  std::vector<int> pair_above;  ///< per body: the pair on which it hangs; -1: the body is free
  std::vector<int> body_below;  ///< per pair: the body that hangs on it; -1: the pair is cut
  /// per pair: a single joint whose several coordinates belong to one element of its chain
  std::vector<bool> has_several;
  std::vector<int> order;  ///< bodies that hang on a pair, parents before children

  bool empty() const { return order.empty(); }
};

/// The number of joint coordinates of a pair of the forest: one per joint of its chain, all of a
/// single joint.
int forest_coordinates(const Pair& pair);

/// The forest of the URDF tree: every pair of tree joints whose coordinates are scalars. Ball
/// joints and floating joints are cut, and so are all loops. @param cut per pair: whether it is cut
/// although it could give coordinates
Forest tree_forest(const Topology& topology, const std::vector<bool>& cut);

/// Cuts chains of many coordinates so that no body has more than ten between it and a free body or
/// the ground, decision 82; leaves mechanisms whose mass matrix is small.
void cut_long_chains(const Topology& topology, std::vector<bool>* cut);

}  // namespace codesign
