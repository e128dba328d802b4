// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_COMPILED_SYSTEM_H_
#define MECHANISM_CODESIGN_EQUATIONS_COMPILED_SYSTEM_H_

#include <memory>

#include "sparse/sparsity.h"
#include "system/system.h"

namespace codesign {

class EquationCode;
class LazyEquationCode;

/// A System with everything that is made once for its equations and shared by all designs and threads: the sparsity patterns of their
/// derivatives, and their machine code. Immutable and thread-safe. make_system() builds one from a model and a study.
class CompiledSystem final : public System {
 public:
  /// @param sharing which redundant rows are dropped and which share reactions, theory (23); by default none.
  /// @param drives joints whose motion is prescribed, see System::System().
  /// @throws InputError for a mechanism or a study without equations of motion, as System::System().
  CompiledSystem(const RobotDescription& robot, const Study& study, ReactionSharing sharing = {}, const std::vector<int>& drives = {});
  ~CompiledSystem();

  /// The patterns, and the nonzero that each call of Formulas::assemble() adds to.
  const AssemblyPlan& plan() const { return plan_; }
  /// The patterns of G_q and G_s (position), G_v (velocity) and G_z (rate), with one more row for the integrand g.
  const ByVariable<Sparsity>& patterns() const { return plan_.patterns; }

  /// The machine code of the equations, recorded by the first call. Null on processors for which no code can be made, for very large
  /// systems, and for equations that could not be recorded. Thread-safe.
  const EquationCode* equation_code() const;

 private:
  const AssemblyPlan plan_;
  const std::unique_ptr<LazyEquationCode> code_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_COMPILED_SYSTEM_H_
