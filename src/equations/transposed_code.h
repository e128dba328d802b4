// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <variant>
#include <vector>

#include "codegen/derivatives.h"
#include "control/reference.h"
#include "control/shaped_input.h"
#include "equations/equation_variant.h"
#include "math/arrays.h"

namespace codesign {

/// The products of the transposed derivatives of recorded functions with given weights of their
/// results, theory (18e), by reverse accumulation on their recording. A product by
/// the state goes down to the state; a product by the parameters goes down to the numbers that
/// depend on the tuned parameters alone, since those are computed once per design. From there
/// design() goes on to the expressions of the parameters. Thread-safe.
class TransposedCode {
 public:
  /// What the results of a function are, side by side in array EquationArrays::kAdjoints: the
  /// derivatives of the weighted sum of the function's results by columns of the state, then by
  /// functions of time, then by numbers of the design.
  struct Results {
    std::vector<int> columns;  ///< (q, s), v and z side by side
    std::vector<int> timed;    ///< entries of array Recording::kTimed
    std::vector<int> numbers;  ///< indices among the sums(), each once
    std::size_t size() const { return columns.size() + timed.size() + numbers.size(); }
  };

  /// @param recorded the recording of all functions. @param functions their results and decisions,
  /// one per EquationFunction; those with has_products are transposed.
  /// @param interpreted whether machine code is never made.
  TransposedCode(const System& system, const Recording& recorded,
                 const std::vector<RecordedFunction>& functions, bool interpreted);

  /// The recording that the code below is made of. It begins with the nodes of the recording of the
  /// values, and its array kNumbers with the entries of theirs.
  const NumberedRecording& numbered() const { return numbered_; }
  /// The code of one function, made by the first call; `held` as of EquationVariant::Scalar. The
  /// weights of the k-th array of results are array kResults + k.
  const CompiledFunction& function(EquationFunction function, bool interpreted, bool held) const {
    return code(functions_[to_index(function)], interpreted, held);
  }
  const Results& results(EquationFunction function) const {
    return functions_[to_index(function)].results;
  }

  /// The number of different numbers of the design by which functions are differentiated.
  std::size_t sums() const { return sums_; }
  /// Code that multiplies the derivatives by all sums(), array kResults, with the derivatives of
  /// these numbers by expressions of the parameters; its results are in the order of expressions().
  const CompiledFunction& design() const { return code(design_, true, false); }
  /// Entries of Recording::supplied_sources().
  const std::vector<int>& expressions() const { return expressions_; }

 private:
  struct Transposed {
    ValueTask task;
    Results results;
    /// Machine code, interpreted; then both without the guards of switches.
    mutable std::array<std::unique_ptr<CompiledFunction>, 4> code;
    mutable std::array<std::once_flag, 4> made;  ///< the same
  };
  void find_dependent(const System& system);
  std::vector<bool> targets() const;
  void transpose(const System& system, const RecordedFunction& recorded, std::vector<int>* sum_of,
                 Transposed* transposed);
  void transpose_design(const std::vector<int>& sum_of);
  const CompiledFunction& code(const Transposed& which, bool interpreted, bool held) const;

  const bool interpreted_;
  NumberedRecording numbered_;
  /// per node: whether it varies with the tuned parameters, at a fixed state
  std::vector<bool> depends_;
  std::vector<Transposed> functions_;
  Transposed design_;
  std::size_t sums_ = 0;
  std::vector<int> expressions_;
};

/// Sums the transposed products of TransposedCode over many evaluations of one variant and one
/// design, and multiplies the sums with the derivatives of the design's numbers by the tuned
/// parameters, theory (18d). Functions of time have other derivatives at each instant; they are
/// evaluated with lanes of the parameters that appear in them. No allocation after the first
/// start(); not thread-safe.
class DesignProducts {
 public:
  /// @param system, code must outlive the object.
  DesignProducts(const System& system, const TransposedCode& code);

  /// Begins with zero sums. @param parameters all named parameters (Study::parameters order).
  void start(const std::vector<double>& parameters);
  /// Adds an evaluation at time t [s]. @param results of the function's code, in the order of
  /// TransposedCode::Results. @param adjoint the products by (q, s), v and z are added to it.
  void add(EquationFunction function, double t, In<double> results, Out<double> adjoint);
  /// Adds the derivatives of all sums by the tuned parameters. @param numbers array kNumbers of the
  /// design. @param gradient p entries.
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
  /// workspace of add_timed(), per function of time
  std::vector<std::array<double, Recording::kFunctionOrders>> orders_;
};

}  // namespace codesign
