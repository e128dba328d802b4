// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mechanism/topology.h"

namespace codesign {

/// The kind of the single joint that is equivalent to a chain of joints across massless links, from
/// the axes at the default parameters.
/// @throws InputError if no PairKind is equivalent to the chain.
PairKind fold_chain(const RobotDescription& robot, const Topology& topology,
                    const std::vector<ChainElement>& chain);

/// Whether a chain of several joints can be folded into one: an equivalent PairKind exists at the
/// default parameters, and every joint with a load of its own (damping, a spring, a rotor, a
/// coupling) still has a coordinate in closed form.
bool folds(const RobotDescription& robot, const Topology& topology,
           const std::vector<ChainElement>& chain);

}  // namespace codesign
