// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// The texts of a generated model and of a study of it.
struct GeneratedCase {
  SourceText urdf, study;
};

/// An open chain of `links` slender bars under gravity, hinged about y and x in turn, with friction
/// that depends on the reactions: as many degrees of freedom as links.
GeneratedCase open_chain(int links);

/// The same chain with four parameters per link: length, mass, the hinge's pin radius and its
/// friction coefficient.
/// @param tuned how many of the 4 * links parameters are tuned: the first ones of length_0, mass_0,
/// radius_0, friction_0, length_1, ...
GeneratedCase parametric_chain(int links, int tuned);

/// A ladder of `loops` closed loops: loops + 1 posts hang on hinges with friction from the ground,
/// and each two neighbours are joined by a coupler, with a ball joint to the one and a universal
/// joint to the other. One degree of freedom, no redundant constraint.
GeneratedCase ladder(int loops);

/// `loops` four-bar linkages, each of which stands on the coupler of the one before: 3 * loops
/// links, `loops` degrees of freedom, and three redundant constraints in each loop, since all its
/// axes are parallel.
/// @param with_friction whether the cranks' hinges have friction; it depends on undetermined
/// reactions, theory (23).
GeneratedCase stacked_four_bars(int loops, bool with_friction);

/// A planar linkage of hinges and slides with friction in its crank, and its name.
struct PlanarCase {
  const char* name;
  GeneratedCase texts;
};

/// A four-bar, a slider-crank and a six-bar (a four-bar whose coupler moves an output by a rod),
/// each with revolute loops. @param held whether the loops are held in their plane only, theory
/// (23c)
std::vector<PlanarCase> planar_linkages(bool held);

/// Bricard's threefold symmetric ring: six bars, one of which is the ground, and six hinges, each
/// at right angles to the next. One degree of freedom, though counting says none: one constraint is
/// redundant.
GeneratedCase bricard_ring();

}  // namespace codesign
