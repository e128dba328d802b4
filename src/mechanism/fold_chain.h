// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MECHANISM_FOLD_CHAIN_H_
#define MECHANISM_CODESIGN_MECHANISM_FOLD_CHAIN_H_

#include <vector>

#include "mechanism/topology.h"

namespace codesign {

/// The one joint that a chain of joints across massless links amounts to, judged at the default parameters.
/// @throws InputError if there is none in the family of PairKind.
PairKind fold_chain(const RobotDescription& robot, const Topology& topology, const std::vector<ChainElement>& chain);

/// Whether a chain of several joints amounts to one joint at the default parameters, in which every joint that carries a load of its own
/// (damping, a spring, a rotor, a coupling) still has a coordinate in closed form.
bool folds(const RobotDescription& robot, const Topology& topology, const std::vector<ChainElement>& chain);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MECHANISM_FOLD_CHAIN_H_
