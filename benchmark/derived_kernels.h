// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "equations/compiled_system.h"
#include "mechanism/constants.h"

namespace codesign {

/// The operations of ConstraintKernels that the paper times, in its order: Phi_q, Phi_q v, Phi_q^T
/// lambda, (Phi_q v)_q v.
enum class KernelOperation { kJacobian, kProduct, kTransposedProduct, kCurvature };
constexpr int kKernelOperations = 4;

/// One of these operations on one mechanism's constraints as a program without loops, in machine
/// code where the processor can run it. Its results are those of ConstraintKernels, in the same
/// order; those that are always zero are not written.
class KernelProgram {
 public:
  /// The function of ConstraintKernels that was written by hand, recorded.
  static KernelProgram recorded(KernelOperation operation, const CompiledSystem& system,
                                const Constants<double>& constants);
  /// Derived from a recording of the constraints' values alone, as the library derives its
  /// equations.
  static KernelProgram derived(KernelOperation operation, const CompiledSystem& system,
                               const Constants<double>& constants);

  KernelProgram(KernelProgram&& other) noexcept;
  ~KernelProgram();

  int instructions() const;
  /// @param results must hold zeros where a result is always zero.
  void run(const double* q, const double* v, const double* lambda, double* results);

 private:
  struct Parts;
  explicit KernelProgram(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

/// The derived programs of all operations.
std::vector<KernelProgram> derived_kernels(const CompiledSystem& system,
                                           const Constants<double>& constants);

}  // namespace codesign
