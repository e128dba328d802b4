// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "equations/compiled_system.h"
#include "integration/stage_matrix.h"
#include "mechanism_codesign/status.h"

namespace codesign {

class Assembly;

/// Computes the state after an instant at which inputs jump or the design changes, doc/theory.md
/// (55). Positions, velocities and extra states stay; if the design changes the geometry, the tree
/// coordinates stay as far as the loops allow it. Accelerations and reactions are computed again.
class Continuation {
 public:
  explicit Continuation(const CompiledSystem& system) : system_(system) {}

  /// @param parameters all named parameters of the design after the instant. @param interpolated
  /// whether `state` is dense output, which satisfies the constraints only within the tolerance: it
  /// is then projected, (17).
  /// @param equations hold the previous design; after success the new design, else still the
  /// previous one.
  /// @param state of the run at the instant; receives the state after it. Do not use it after a
  /// failure.
  /// @returns kInvalidDesign for impossible constants, a status of Assembly::solve_from() or
  /// RateSolution::solve(), kAssemblyFailed also if a joint's coordinate cannot be computed.
  Status cross(const std::vector<double>& parameters, bool interpolated, Assembly* assembly,
               Equations<double>* equations, State<double>* state);

 private:
  Status change_design(const std::vector<double>& parameters, Assembly* assembly,
                       Equations<double>* equations, State<double>* state);

  const CompiledSystem& system_;
  /// made when first needed, since most runs have no such instant
  std::unique_ptr<Projection> projection_;
};

}  // namespace codesign
