// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_CONTINUATION_H_
#define MECHANISM_CODESIGN_INTEGRATION_CONTINUATION_H_

#include <memory>
#include <vector>

#include "assembly/assembly.h"
#include "integration/projection.h"

namespace codesign {

/// The state behind an instant at which inputs jump or the design changes, doc/theory.md (55). Positions, velocities and extra states stay;
/// where the design moves geometry, the tree coordinates stay as far as the loops allow it. Accelerations and reactions follow anew.
class Continuation {
 public:
  explicit Continuation(const CompiledSystem& system) : system_(system) {}

  /// @param parameters of the design behind the instant, all named ones. @param interpolated whether `state` is dense output, which the
  /// constraints hold for only within the tolerance: it is then projected, (17).
  /// @param equations hold the design before; after success the one behind, else that before.
  /// @param state of the run at the instant; receives the one behind it. After a failure it is not to be used.
  /// @returns kInvalidDesign for impossible constants, a status of Assembly::solve_from() or Assembly::solve_rates(), kAssemblyFailed also
  /// where a joint's coordinate cannot be computed.
  Status cross(const std::vector<double>& parameters, bool interpolated, Assembly* assembly, Equations<double>* equations,
               State<double>* state);

 private:
  Status change_design(const std::vector<double>& parameters, Assembly* assembly, Equations<double>* equations, State<double>* state);

  const CompiledSystem& system_;
  std::unique_ptr<Projection> projection_;  ///< made when first needed: most runs are never interrupted
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_CONTINUATION_H_
