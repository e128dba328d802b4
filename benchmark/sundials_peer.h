// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_BENCHMARK_SUNDIALS_PEER_H_
#define MECHANISM_CODESIGN_BENCHMARK_SUNDIALS_PEER_H_

#include <Eigen/Core>
#include <memory>

#include "equations/compiled_system.h"

namespace codesign {

/// How SUNDIALS solves its linear systems.
enum class SundialsMatrix {
  kDenseDifferences,  ///< what one gets by giving it a residual only: its own difference Jacobian, dense LU
  kSparseExact        ///< the exact Jacobian on its pattern, KLU
};

struct SundialsResult {
  bool ok = false;
  double psi = 0.0;
  Eigen::VectorXd gradient;
  long steps = 0;
};

/// The equations of a system, doc/theory.md (14), given to SUNDIALS IDAS as a user of SUNDIALS would, without anything of our integrators:
/// unknowns (q, v, s, z, psi), z out of the error test, no projection, staggered sensitivities with an exact sensitivity residual in one
/// pass for up to eight parameters.
class SundialsPeer {
 public:
  SundialsPeer(std::shared_ptr<const CompiledSystem> system, SundialsMatrix matrix);
  ~SundialsPeer();

  /// psi and, if asked for, its gradient at the start values. The absolute tolerance is a hundredth of the relative one: of 0.1, 0.01 and
  /// 0.001 the one with which it is fastest at equal accuracy.
  SundialsResult run(double relative_tolerance, bool with_gradient);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_BENCHMARK_SUNDIALS_PEER_H_
