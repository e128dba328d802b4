// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_setup.h"

#include <idas/idas_ls.h>

#include <algorithm>
#include <limits>

#include "integration/idas_handles.h"

namespace codesign {
namespace {

// Absolute tolerance that excludes multipliers from convergence tests.
constexpr double kAnyMultiplier = 1e10;

/// The part of the multipliers, the last in y.
Span<double> multipliers_of(const CompiledSystem& system, const VectorHandle& y) {
  const int m = system.layout().m;
  const Span<double> all = span_of(y.get());
  return all.subspan(all.size() - m, m);
}

// With redundant constraints, multipliers that are not unique vary by rounding divided by the
// compliance: Newton's convergence test must not include them.
void set_tolerances(const IdasMemory& memory, const CompiledSystem& system, int size) {
  const SolverOptions& options = system.study().solver;
  const VectorHandle absolute = make_vector(size, memory.context);
  N_VConst(options.absolute_tolerance, absolute.get());
  const Span<double> multipliers = multipliers_of(system, absolute);
  if (system.compliance() > 0.0) std::fill(multipliers.begin(), multipliers.end(), kAnyMultiplier);
  require(IDASVtolerances(memory.ida, options.relative_tolerance, absolute.get()),
          "IDASVtolerances");
}

}  // namespace

void set_up_idas(const IdasMemory& memory, const CompiledSystem& system, IdasEquations* equations,
                 IdasNewton* newton, const IdasVectors& vectors) {
  const SolverOptions& options = system.study().solver;
  void* const ida = memory.ida;
  const VectorHandle differential = make_vector(equations->size(), memory.context);
  N_VConst(1.0, differential.get());
  const Span<double> multipliers = multipliers_of(system, differential);
  std::fill(multipliers.begin(), multipliers.end(), 0.0);
  require(keep_last_message(ida, memory.context, memory.message), "keep_last_message");
  set_order_floor(vectors.y, &equations->order_floor());
  require(IDAInit(ida, IdasEquations::residual, 0.0, vectors.y, vectors.y_dot), "IDAInit");
  require(IDASetUserData(ida, equations), "IDASetUserData");
  set_tolerances(memory, system, equations->size());
  require(IDASetId(ida, differential.get()), "IDASetId");
  require(IDASetSuppressAlg(ida, SUNTRUE), "IDASetSuppressAlg");
  require(IDASetInitStep(ida, options.initial_step), "IDASetInitStep");
  // A shorter step would be lost in rounding when added to the time.
  require(IDASetMinStep(ida, std::numeric_limits<double>::epsilon() * system.study().duration),
          "IDASetMinStep");
  require(IDASetMaxStep(ida, options.maximum_step), "IDASetMaxStep");
  require(IDASetLinearSolver(ida, newton->solver(), newton->matrix()), "IDASetLinearSolver");
  require(IDASetJacFn(ida, IdasEquations::jacobian), "IDASetJacFn");
  require(IDAQuadInit(ida, IdasEquations::integrand, vectors.integrals), "IDAQuadInit");
  // A smooth motion takes steps over which an objective may change much.
  require(IDAQuadSStolerances(ida, options.relative_tolerance, options.absolute_tolerance),
          "IDAQuadSStolerances");
  require(IDASetQuadErrCon(ida, SUNTRUE), "IDASetQuadErrCon");
}

}  // namespace codesign
