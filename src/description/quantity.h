// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <memory>
#include <utility>
#include <vector>

#include "description/expression.h"
#include "math/arrays.h"
#include "math/scalar.h"

namespace codesign {

class Traced;

/// The value of an expression at `parameters`.
inline double value_at(const Expression& expression, const std::vector<double>& parameters) {
  return expression.value(parameters);
}
inline std::complex<double> value_at(const Expression& expression,
                                     const std::vector<std::complex<double>>& parameters) {
  return expression.value(parameters);
}
/// The value with its derivatives, by the chain rule in each lane.
template <int N>
Lanes<N> value_at(const Expression& expression, const std::vector<Lanes<N>>& parameters) {
  const UsedNumbers<double> values =
      expression.used<double>(parameters, [](const Lanes<N>& parameter) { return parameter.a; });
  Lanes<N> result(expression.value_of(values));
  for (std::size_t k = 0; k < values.size(); ++k)
    result.v +=
        expression.derivative_of(k, values) * parameters[to_index(expression.dependencies()[k])].v;
  return result;
}
/// For recorded equations an expression is an input that is supplied with each design. `parameters`
/// are nodes of the recording; at least one.
Traced value_at(const Expression& expression, const std::vector<Traced>& parameters);

/// A number of the model: a constant, or an expression of the parameters.
class Quantity {
 public:
  Quantity(double constant = 0.0)
      : nominal_(constant) {}  // NOLINT(google-explicit-constructor): a number is a quantity
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
