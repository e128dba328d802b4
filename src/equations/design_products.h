// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "control/reference.h"
#include "control/shaped_input.h"
#include "equations/transposed_code.h"
#include "math/span.h"

namespace codesign {

/// Sums the transposed products of TransposedCode over many evaluations of one variant and one design, and multiplies the sums with the
/// derivatives of the design's numbers by the tuned parameters, theory (18d). Functions of time have other derivatives at each instant;
/// they are evaluated with lanes of the parameters that appear in them. No allocation after the first start(); not thread-safe.
class DesignProducts {
 public:
  /// @param system, code must outlive the object.
  DesignProducts(const System& system, const TransposedCode& code);

  /// Begins with zero sums. @param parameters all named parameters (Study::parameters order).
  void start(const std::vector<double>& parameters);
  /// Adds an evaluation at time t [s]. @param results of the function's code, in the order of TransposedCode::Results. @param adjoint the
  /// products by (q, s), v and z are added to it.
  void add(EquationFunction function, double t, In<double> results, Out<double> adjoint);
  /// Adds the derivatives of all sums by the tuned parameters. @param numbers array kNumbers of the design. @param gradient p entries.
  void add_to(const std::vector<double>& numbers, Out<double> gradient);

 private:
  /// A function of time with lanes of up to eight of its tuned parameters.
  struct Lane {
    int function;  ///< index among Recording::timed_sources()
    std::vector<int> tuned;
    std::variant<Reference<Lanes<8>>, ShapedInput<Lanes<8>>> motion;
  };
  void add_timed(const TransposedCode::Results& of, double t, In<double> results);

  const System& system_;
  const TransposedCode& code_;
  std::vector<int> tuned_of_;  ///< per named parameter: its index among the tuned ones, or -1
  std::vector<double> parameters_, sums_, timed_, by_expression_, slots_;
  std::vector<Lanes<8>> seeded_;
  std::vector<Lane> lanes_;
  std::vector<std::array<double, Recording::kFunctionOrders>> orders_;  ///< workspace of add_timed(), per function of time
};

}  // namespace codesign
