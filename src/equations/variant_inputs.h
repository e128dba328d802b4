// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "control/reference.h"
#include "control/shaped_input.h"
#include "equations/equation_variant.h"
#include "equations/transposed_code.h"
#include "math/scalar.h"

namespace codesign {

template <class T>
constexpr int kLanesOf = 0;
template <int N>
constexpr int kLanesOf<Lanes<N>> = N;

/// One variant of the equations' code, and what it reads besides the state, for one design: numbers
/// that depend on design, time and turn references (array EquationArrays::kNumbers). T as in
/// CompiledEquations.
template <class T>
class VariantInputs {
 public:
  explicit VariantInputs(const EquationVariant* of)
      : code_(of), numbered_(&of->numbered(kLanesOf<T> > 0)) {}

  const EquationVariant& code() const { return *code_; }
  /// Takes the values of all named parameters, unless it has them since the last forget_design().
  void take_design(const std::vector<T>& parameters);
  /// The same with the numbers of the transposed code, which begin with those of the values; for
  /// double.
  void take_products(const CompiledSystem& system, const std::vector<T>& parameters);
  void forget_design() { ready_ = false; }
  /// Evaluates the functions of time and copies the turn references.
  void set_instant(double t, const std::vector<double>& turns);
  /// Makes time the first direction of the functions of time; for Lanes, until the next
  /// set_instant().
  void seed_time(double t);

  /// Adds the derivatives along a direction of the time, N entries, likewise.
  void add_time_direction(double t, const std::vector<double>& direction);

  /// The first decision that the design makes otherwise, -1 if none.
  int failed() const { return failed_; }
  const std::vector<T>& numbers() const { return numbers_; }
  bool depends_on_time() const { return !functions_.empty(); }
  DesignProducts& products() { return *products_; }

 private:
  void fill_numbers(const std::vector<T>& parameters);
  void set_functions(const std::vector<T>& parameters);

  const EquationVariant* code_;
  const NumberedRecording* numbered_;
  bool ready_ = false;  ///< whether the members below belong to the present design
  int failed_ = -1;
  std::vector<T> numbers_, nodes_;  ///< nodes_: workspace, values of the recording's nodes
  /// functions of time, order of the recording
  std::vector<std::variant<Reference<T>, ShapedInput<T>>> functions_;
  std::unique_ptr<DesignProducts> products_;  ///< if take_products() was called
};

}  // namespace codesign
