// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "equations/equation_function.h"
#include "sparse/sparsity.h"
#include "system/system.h"

namespace codesign {

class EquationVariant;
class EquationVariants;

/// A System with everything that is made once for its equations and shared by all designs and
/// threads: the sparsity patterns of their derivatives, and their machine code. Immutable and
/// thread-safe. make_system() builds one from a model and a study.
class CompiledSystem final : public System {
 public:
  /// @param sharing which redundant rows are dropped and which share reactions, theory (23); by
  /// default none.
  /// @param drives joints whose motion is prescribed, see System::System().
  /// @throws InputError for a mechanism or a study without equations of motion, as
  /// System::System().
  CompiledSystem(const RobotDescription& robot, const Study& study, ReactionSharing sharing = {},
                 const std::vector<int>& drives = {});
  ~CompiledSystem();

  /// The patterns of G_q and G_s (position), G_v (velocity) and G_z (rate), with one more row for
  /// the integrand g.
  const ByVariable<Sparsity>& patterns() const { return patterns_; }

  /// Whether CompressedJacobian differentiates the equations in simulations: for trees of some size
  /// in joint coordinates it takes less time than a program for the derivatives, and much less to
  /// prepare. doc/decisions/0086-compressed-jacobian.md
  bool compresses_jacobian() const;
  /// Whether G_z alone costs less than the linearization: so it is if the Jacobian is compressed,
  /// and for the explicit pair, which asks for nothing else; the linearization then has a recording
  /// of its own.
  bool has_rates_apart() const;
  /// Whether the residual has switches, is_below(): then steps end where they change.
  bool has_switches() const;
  /// Whether the condition of Study::until holds in a mode of the residual.
  bool ends_run(const std::vector<bool>& mode) const;
  /// Whether a run begins with the explicit pair. With `method: auto` it does so unless there is
  /// dry friction, which is stiff wherever it sticks: a run that began explicitly would find this
  /// out in some fifty steps, and have made the programs of both methods.
  bool begins_explicitly() const;

  /// The k-th variant of the equations' code; null if fewer are known. The first one is recorded by
  /// the first call. Thread-safe.
  const EquationVariant* equation_variant(std::size_t k = 0,
                                          EquationPart part = EquationPart::kMotion) const;
  /// The variant for given outcomes of the first decisions and, before them, of the first switches;
  /// not yet among those known.
  std::unique_ptr<EquationVariant> record_variant(std::vector<bool> outcomes,
                                                  EquationPart part = EquationPart::kMotion,
                                                  std::vector<bool> mode = {}) const;
  /// Adds a variant to those known, unless it is one of them. @return its index. Thread-safe.
  std::size_t keep_variant(std::unique_ptr<EquationVariant> variant,
                           EquationPart part = EquationPart::kMotion) const;

 private:
  ByVariable<Sparsity> patterns_;
  /// Per EquationPart.
  std::array<std::unique_ptr<EquationVariants>, kEquationParts> variants_;
};

}  // namespace codesign
