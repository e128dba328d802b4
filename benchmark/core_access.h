// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Access of the benchmarks to the derivatives and to the parts of a step. No other file of
// benchmark/ depends on how the core stores them.

#include <memory>
#include <vector>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// The variables of a derivative of the equations: (q, s), v or z.
enum class Variable { kPosition, kVelocity, kRate };

/// Calls visit(variable, row, column, value) for every stored derivative of the equations; the
/// integrand g is the row below them. Columns are those of (q, s), of v, or of z.
template <class Visit>
void for_each_derivative(const CompiledSystem& system, const Linearization<double>& derivatives,
                         const Visit& visit) {
  const auto matrix = [&visit](Variable variable, const Sparsity& pattern,
                               const std::vector<double>& values) {
    for (int row = 0; row < pattern.rows; ++row)
      for (int k = pattern.first(row); k < pattern.first(row + 1); ++k)
        visit(variable, row, pattern.column(k), values[static_cast<std::size_t>(k)]);
  };
  matrix(Variable::kPosition, system.patterns().position, derivatives.position);
  matrix(Variable::kVelocity, system.patterns().velocity, derivatives.velocity);
  matrix(Variable::kRate, system.patterns().rate, derivatives.rate);
}

/// A workspace for the derivatives of a system's equations.
class LinearizedSystem {
 public:
  explicit LinearizedSystem(const CompiledSystem& system) : system_(system) {
    values_.resize(system.patterns());
  }

  void evaluate(Equations<double>* equations, const State<double>& state) {
    equations->linearize(state, &values_);
  }
  template <class Visit>
  void for_each(const Visit& visit) const {
    for_each_derivative(system_, values_, visit);
  }

 private:
  const CompiledSystem& system_;
  Linearization<double> values_;
};

/// The parts of a Rosenbrock step, each of which can be called repeatedly at one state of a run, to
/// be timed.
class StepProbe {
 public:
  /// Runs `system` at its start values up to `time` [s].
  StepProbe(std::shared_ptr<const CompiledSystem> system, double time, double h);
  ~StepProbe();

  const Status& status() const;
  const State<double>& state() const;
  int matrix_size() const;
  int stages() const;

  void residual();
  void linearize();
  /// The same without machine code.
  void interpret_residual();
  void interpret_linearize();
  /// Numerical factorization of the stage matrix (16).
  void factor();
  /// One solve with that factorization.
  void solve();
  /// All stages: one factorization, then per stage a residual, products and a solve.
  void attempt();
  /// attempt(), then projection and the derivatives at the end.
  void step();
  /// Returns to the state that the constructor reached.
  void rewind();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace codesign
