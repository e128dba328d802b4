// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "equations/compiled_system.h"

namespace codesign {

/// The Jacobian and the linear solver that SUNDIALS is given.
enum class SundialsMatrix {
  kDenseDifferences,  ///< a residual only: SUNDIALS forms the Jacobian by differences and factors
                      ///< it densely
  kSparseExact        ///< the exact Jacobian on its pattern, KLU
};

struct SundialsResult {
  bool ok = false;
  double psi = 0.0;
  Eigen::VectorXd gradient;
  long steps = 0;
};

/// The equations of a system, doc/theory.md (14), integrated by SUNDIALS IDAS as a user of SUNDIALS
/// would set it up, without any part of our integrators: unknowns (q, v, s, z, psi), z not in the
/// error test, no projection, staggered sensitivities with an exact sensitivity residual, evaluated
/// in one pass for up to eight parameters.
class SundialsPeer {
 public:
  SundialsPeer(std::shared_ptr<const CompiledSystem> system, SundialsMatrix matrix);
  ~SundialsPeer();

  /// psi and, if asked for, its gradient at the start values. The absolute tolerance is 0.01 times
  /// the relative one: of the factors 0.1, 0.01 and 0.001 this one makes SUNDIALS fastest at equal
  /// accuracy.
  SundialsResult run(double relative_tolerance, bool with_gradient);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace codesign
