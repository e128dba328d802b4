// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MODEL_QUANTITY_H_
#define MECHANISM_CODESIGN_MODEL_QUANTITY_H_

#include <array>
#include <complex>
#include <memory>
#include <utility>
#include <vector>

#include "mechanism_codesign/math/scalar.h"
#include "mechanism_codesign/model/expression.h"

namespace codesign {

/// The value of an expression at `parameters`.
inline double value_at(const Expression& expression, const std::vector<double>& parameters) { return expression.value(parameters); }
inline std::complex<double> value_at(const Expression& expression, const std::vector<std::complex<double>>& parameters) {
  return expression.value(parameters);
}
/// With the chain rule carried into every lane.
template <int N>
Lanes<N> value_at(const Expression& expression, const std::vector<Lanes<N>>& parameters) {
  std::vector<double> values;
  values.reserve(parameters.size());
  for (const Lanes<N>& parameter : parameters) values.push_back(parameter.a);
  Lanes<N> result(expression.value(values));
  for (int index : expression.dependencies())
    result.v += expression.derivative(index, values) * parameters[static_cast<std::size_t>(index)].v;
  return result;
}
/// While equations are recorded an expression comes with each design. `parameters` are of the recording, and not empty.
inline Traced value_at(const Expression& expression, const std::vector<Traced>& parameters) {
  Recording* const recording = parameters.front().recording();
  std::vector<double> values;
  for (const Traced& parameter : parameters) values.push_back(parameter.value());
  return {recording, recording->supplied(&expression), expression.value(values)};
}

/// A number of the model: a constant, or an expression of the parameters.
class Quantity {
 public:
  Quantity(double constant = 0.0) : nominal_(constant) {}  // NOLINT(google-explicit-constructor): a number is a quantity
  Quantity(double nominal, std::shared_ptr<const Expression> expression) : nominal_(nominal), expression_(std::move(expression)) {}

  /// The value at the parameters' default values, as written in the plain attribute.
  double nominal() const { return nominal_; }
  bool is_constant() const { return expression_ == nullptr; }
  const Expression* expression() const { return expression_.get(); }

  /// The value at `parameters` (all named parameters, in the order of the model, then of the study).
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

#endif  // MECHANISM_CODESIGN_MODEL_QUANTITY_H_
