// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "description/value_range.h"
#include "math/arrays.h"
#include "math/scalar.h"

namespace codesign {

/// The functions of expressions.
enum class FunctionKind : unsigned char {
  kSquareRoot,
  kSine,
  kCosine,
  kTangent,
  kArcSine,
  kArcCosine,
  kArcTangent,
  kArcTangent2,
  kHyperbolicSine,
  kHyperbolicCosine,
  kHyperbolicTangent,
  kExponential,
  kLogarithm,
  kLogarithm10,
  kPower,
  kMagnitude,
  kSign,
  kLeast,
  kGreatest,
  kFloor,
  kCeiling,
  kRadians,
  kDegrees
};

/// A function that expressions may call; its laws are in description/formula.h.
struct ExpressionFunction {
  const char* name;
  int count;  ///< number of arguments; -1: one or more
  FunctionKind kind;
};

/// All functions. The table never changes, so that indices into it stay valid.
const std::vector<ExpressionFunction>& expression_function_table();

/// Index of a function, -1 if there is none of this name.
int find_expression_function(const std::string& name);

/// One operation of a stack machine on numbers. Operators replace their operands on the stack by
/// the result; comparisons give 1 or 0.
struct ExpressionStep {
  enum class Code : unsigned char {
    kConstant,  ///< pushes `number`
    kVariable,  ///< pushes variable `index`
    kNegate,
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kPower,
    kCall,  ///< replaces the topmost `count` numbers by function `index` of them
    kLess,
    kLessOrEqual,
    kGreater,
    kGreaterOrEqual,
    kEqual,
    kNotEqual,
    kJumpUnless,  ///< removes the topmost number and goes to step `index` if it is 0
    kJump         ///< goes to step `index`
  };
  Code code = Code::kConstant;
  int index = 0;
  int count = 0;
  double number = 0.0;
  /// Of a comparison or call: its bytes `begin` to `end` - 1 in the text of the expression.
  int begin = 0, end = 0;
};

using ExpressionSteps = std::vector<ExpressionStep>;

/// The part of an expression's text that an operation, a comparison or a call, stands for; the
/// whole text for all others.
std::string text_of(const ExpressionSteps& steps, int step, const std::string& text);

/// An upper bound of the numbers on the stack at any time.
int stack_size(const ExpressionSteps& steps);

/// The parameters that an expression may use, as functions, so that no expression needs a copy of
/// all names.
struct ExpressionScope {
  std::function<int(const std::string&)> find;      ///< index of a parameter, -1 if there is none
  std::function<std::vector<std::string>()> names;  ///< all names, for messages
  /// Where a signal ends that begins at a byte of the text; that byte itself if none does. A signal
  /// is then a name to find(). Empty: there are no signals.
  std::function<std::size_t(const std::string& text, std::size_t at)> signal_end{};
  /// The text is a condition, 1 where it holds and 0 elsewhere; else it is a number.
  bool is_condition = false;
};

/// Numbers for the parameters that one expression uses, or that stand on its stack: the expressions
/// that people write use few.
template <class T>
using UsedNumbers = ShortVector<T, (sizeof(T) <= 128 ? 32 : 8)>;

/// An arithmetic expression of named parameters, in xacro's syntax inside `${...}`.
///
/// Operators + - * / ** ^ and parentheses, comparison with `?:`, the constant `pi`, and the usual
/// functions (sqrt, sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, log, log10, pow,
/// abs, sign, min, max, floor, ceil, radians, degrees). Immutable and safe to evaluate from several
/// threads. Evaluation at parameters allocates nothing unless an expression uses more than 32
/// parameters or nests deeper than 32 numbers.
class Expression {
 public:
  /// @param text the expression without the `${` `}`.
  /// @param names the parameters that may appear; their order is the order of the vectors below.
  /// @throws std::invalid_argument with a sentence that names the position, or the unknown name and
  /// the nearest known one.
  Expression(const std::string& text, const std::vector<std::string>& names);
  Expression(const std::string& text, const ExpressionScope& scope);
  Expression(const Expression&) = delete;
  Expression& operator=(const Expression&) = delete;

  const std::string& text() const { return text_; }

  /// Indices of the parameters that appear in the expression, ascending.
  const std::vector<int>& dependencies() const { return dependencies_; }

  /// The operations; variable k is parameter dependencies()[k].
  const ExpressionSteps& steps() const { return steps_; }

  /// Value at `parameters`, which may hold more entries than the names given at construction (the
  /// surplus is ignored). NaN where the expression has no real value (square root or logarithm of a
  /// negative number, 0/0). Of complex numbers the imaginary parts are derivatives: the result is
  /// f + i f' to first order, exactly, however long the step.
  double value(const std::vector<double>& parameters) const;
  std::complex<double> value(const std::vector<std::complex<double>>& parameters) const;

  /// Partial derivative with respect to parameter `index`, by a complex step (exact to rounding).
  double derivative(int index, const std::vector<double>& parameters) const;

  /// Value, and derivative by parameter dependencies()[k], from only the parameters that appear:
  /// `values[k]` is the value of parameter dependencies()[k]. The cost does not grow with the
  /// number of parameters that the expression does not use.
  double value_of(In<double> values) const { return evaluate<double>(values); }
  double derivative_of(std::size_t k, In<double> values) const;

  /// The value as a number with derivatives, from those of the parameters that appear.
  /// T: double, std::complex<double>, Lanes<4>, Lanes<8> or ValueRange.
  template <class T>
  T evaluate(In<T> values) const;

  /// The numbers of the parameters that appear, in the order of dependencies(). @param number
  /// (Entry) -> T, the number of a parameter.
  /// @throws std::out_of_range if there are fewer parameters than names.
  template <class T, class Entry, class Number>
  UsedNumbers<T> used(const std::vector<Entry>& parameters, const Number& number) const {
    UsedNumbers<T> values(dependencies_.size());
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = number(parameters.at(to_index(dependencies_[k])));
    return values;
  }

  /// A range that contains the value wherever all parameters lie in theirs,
  /// description/value_range.h. All numbers if there may be none. @param parameters in the order of
  /// the names.
  ValueRange range(const std::vector<ValueRange>& parameters) const;

 private:
  std::string text_;
  std::vector<int> dependencies_;
  ExpressionSteps steps_;
  std::size_t stack_ = 0;  ///< stack_size() of the steps
};

/// Why `name` cannot be the name of a parameter (not an identifier, `pi`, or a function's name), as
/// a sentence; empty if it can.
std::string identifier_fault(const std::string& name);

class Traced;

/// The value of an expression at `parameters`.
inline double value_at(const Expression& expression, const std::vector<double>& parameters) {
  return expression.value(parameters);
}
inline std::complex<double> value_at(const Expression& expression,
                                     const std::vector<std::complex<double>>& parameters) {
  return expression.value(parameters);
}
/// The value with its derivatives.
template <int N>
Lanes<N> value_at(const Expression& expression, const std::vector<Lanes<N>>& parameters) {
  return expression.evaluate<Lanes<N>>(
      expression.used<Lanes<N>>(parameters, [](const Lanes<N>& x) { return x; }));
}
/// For recorded equations an expression is an input that is supplied with each design. `parameters`
/// are nodes of the recording; at least one.
Traced value_at(const Expression& expression, const std::vector<Traced>& parameters);

/// A number of the model: a constant, or an expression of the parameters.
class Quantity {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): a number is a quantity.
  Quantity(double constant = 0.0) : nominal_(constant) {}
  Quantity(double nominal, std::shared_ptr<const Expression> expression)
      : nominal_(nominal), expression_(std::move(expression)) {}

  /// The value at the parameters' default values, as written in the plain attribute.
  double nominal() const { return nominal_; }
  bool is_constant() const { return expression_ == nullptr; }
  /// Whether it is the constant zero, which stands for an absent quantity. False for every
  /// expression, also one with the value zero.
  bool is_zero() const { return is_constant() && nominal_ == 0.0; }
  const Expression* expression() const { return expression_.get(); }

  /// The value at `parameters`: all named parameters in the order of Study::parameters (the model's
  /// first, then the study's own).
  template <class T>
  T at(const std::vector<T>& parameters) const {
    return expression_ ? value_at(*expression_, parameters) : T(nominal_);
  }

 private:
  double nominal_ = 0.0;
  std::shared_ptr<const Expression> expression_;
};

using QuantityVector = std::array<Quantity, 3>;

}  // namespace codesign
