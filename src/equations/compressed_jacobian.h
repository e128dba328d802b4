// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "equations/compiled_equations.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "math/scalar.h"
#include "sparse/sparsity.h"
#include "system/state.h"

namespace codesign {

/// The derivatives of the residual, theory (14), without a program of their own: columns that share
/// no row are added up to one direction, and the tangents of the residual along kLanes such
/// directions are one pass over its program; Curtis, Powell and Reid, On the estimation of sparse
/// Jacobian matrices, J. Inst. Maths Applics 13 (1974). Exact to rounding. Serves systems with
/// CompiledSystem::compresses_jacobian(). No allocation after the first evaluation of a variant;
/// not thread-safe.
class CompressedJacobian {
 public:
  /// @param system must outlive this.
  explicit CompressedJacobian(const CompiledSystem& system);

  /// As CompiledEquations of the same name.
  void set_design(const std::vector<double>& parameters);
  void allow(bool machine_code) { tangents_.allow(machine_code); }
  void use_first_variant() { tangents_.use_first_variant(); }
  void hold(const std::vector<bool>& mode) { tangents_.hold(mode); }
  void release() { tangents_.release(); }

  /// All derivatives at a state.
  void linearize(const State<double>& state, Linearization<double>* derivatives);
  /// G_z alone; the other derivatives are not touched.
  void rates(const State<double>& state, Linearization<double>* derivatives);

 private:
  static constexpr int kLanes = 8;
  using Tangents = CompiledEquations<Lanes<kLanes>>;

  /// Columns in groups, and where the results have the nonzeros of the matrices.
  struct Compression {
    /// per pass the directions of q, v, s and z, kLanes numbers side by side per entry
    std::vector<std::array<LineVector, 4>> seeds;
    std::vector<Tangents::Pass> passes;  ///< along the seeds, with results in results_
    /// per nonzero its index in results_; empty for matrices that were not asked for
    ByVariable<std::vector<int>> places;
  };

  Compression compress(const ByVariable<const Sparsity*>& patterns) const;
  std::array<LineVector, 4> no_directions() const;
  void add_passes(Compression* compression);
  void gather(const std::vector<int>& places, std::vector<double>* values) const;

  const CompiledSystem& system_;
  const int rows_;  ///< of G, and one of g
  Tangents tangents_;
  std::vector<Lanes<kLanes>> parameters_;
  Compression all_, rates_;
  Tangents::Pass time_;
  LineVector results_;  ///< per pass and row kLanes numbers
};

}  // namespace codesign
