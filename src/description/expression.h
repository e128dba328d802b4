// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "description/expression_range.h"
#include "math/short_vector.h"
#include "math/span.h"

namespace codesign {

/// The parameters that an expression may use, as functions, so that no expression needs a copy of all names.
struct ExpressionScope {
  std::function<int(const std::string&)> find;      ///< index of a parameter, -1 if there is none
  std::function<std::vector<std::string>()> names;  ///< all names, for messages
};

/// Numbers for the parameters that one expression uses: the expressions that people write use few.
template <class T>
using UsedNumbers = ShortVector<T, 32>;

/// An arithmetic expression of named parameters, in xacro's syntax inside `${...}`.
///
/// Operators + - * / ** ^ and parentheses, comparison with `?:`, the constant `pi`, and the usual functions (sqrt, sin, cos, tan, asin,
/// acos, atan, atan2, sinh, cosh, tanh, exp, log, log10, pow, abs, sign, min, max, floor, ceil, radians, degrees). Immutable and safe to
/// evaluate from several threads. Evaluation allocates nothing unless an expression uses more than 32 parameters or nests deeper than 32
/// numbers.
class Expression {
 public:
  /// @param text the expression without the `${` `}`.
  /// @param names the parameters that may appear; their order is the order of the vectors below.
  /// @throws std::invalid_argument with a sentence that names the position, or the unknown name and the nearest known one.
  Expression(const std::string& text, const std::vector<std::string>& names);
  Expression(const std::string& text, const ExpressionScope& scope);
  ~Expression();
  Expression(const Expression&) = delete;
  Expression& operator=(const Expression&) = delete;

  const std::string& text() const { return text_; }

  /// Indices of the parameters that appear in the expression, ascending.
  const std::vector<int>& dependencies() const { return dependencies_; }

  /// Value at `parameters`, which may hold more entries than the names given at construction (the surplus is ignored).
  /// NaN where the expression has no real value (square root or logarithm of a negative number, 0/0).
  double value(const std::vector<double>& parameters) const;
  std::complex<double> value(const std::vector<std::complex<double>>& parameters) const;

  /// Partial derivative with respect to parameter `index`, by a complex step (exact to rounding).
  double derivative(int index, const std::vector<double>& parameters) const;

  /// Value, and derivative by parameter dependencies()[k], from only the parameters that appear: `values[k]` is the value of parameter
  /// dependencies()[k]. The cost does not grow with the number of parameters that the expression does not use.
  double value_of(In<double> values) const;
  double derivative_of(std::size_t k, In<double> values) const;

  /// The numbers of the parameters that appear, in the order of dependencies(). @param number (Entry) -> T, the number of a parameter.
  /// @throws std::out_of_range if there are fewer parameters than names.
  template <class T, class Entry, class Number>
  UsedNumbers<T> used(const std::vector<Entry>& parameters, const Number& number) const {
    UsedNumbers<T> values(dependencies_.size());
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = number(parameters.at(static_cast<std::size_t>(dependencies_[k])));
    return values;
  }

  /// A range that contains the value wherever all parameters lie in theirs. @param parameters in the order of the names.
  ValueRange range(const std::vector<ValueRange>& parameters) const;

 private:
  struct Program;

  std::string text_;
  std::vector<int> dependencies_;
  std::unique_ptr<const Program> program_;
};

/// Why `name` cannot be the name of a parameter (not an identifier, `pi`, or a function's name), as a sentence; empty if it can.
std::string identifier_fault(const std::string& name);

}  // namespace codesign
