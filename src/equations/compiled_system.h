// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_COMPILED_SYSTEM_H_
#define MECHANISM_CODESIGN_EQUATIONS_COMPILED_SYSTEM_H_

#include <memory>

#include "sparse/sparsity.h"
#include "system/system.h"

namespace codesign {

class EquationCode;
class LazyEquationCode;

/// A system with what all evaluations of its equations share: the sparsity of their derivatives, and their machine code. Immutable,
/// thread-safe.
class CompiledSystem final : public System {
 public:
  /// @param sharing how redundant constraints share reactions; theory (23).
  /// @throws InputError for a mechanism or a study without equations of motion.
  CompiledSystem(const RobotDescription& robot, const Study& study, ReactionSharing sharing = {});
  ~CompiledSystem();

  const AssemblyPlan& plan() const { return plan_; }
  const ByVariable<Sparsity>& patterns() const { return plan_.patterns; }

  /// The machine code of the equations, compiled by the first call; null where there is none. Thread-safe.
  const EquationCode* equation_code() const;

 private:
  const AssemblyPlan plan_;
  const std::unique_ptr<LazyEquationCode> code_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_COMPILED_SYSTEM_H_
