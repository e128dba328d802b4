// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_functions.h"

#include <cmath>

namespace codesign {
namespace {

using Complex = std::complex<double>;

Complex extreme(In<Complex> z, double sign) {
  Complex best = z[0];
  for (const Complex& one : z)
    if (sign * one.real() > sign * best.real()) best = one;
  return best;
}

/// value + i slope Im z: a function with this value and slope, applied to a complex step, to first order. Unlike the analytic continuation
/// this gives an infinite derivative at an end of the domain where the slope is infinite.
Complex first_order(const Complex& z, double value, double slope) { return {value, z.imag() == 0.0 ? 0.0 : slope * z.imag()}; }

Complex square_root(In<Complex> z) {
  const double x = z[0].real(), root = std::sqrt(x);
  return x >= 0.0 ? first_order(z[0], root, 0.5 / root) : std::sqrt(z[0]);
}

Complex arc_sine(In<Complex> z) {
  const double x = z[0].real();
  return std::abs(x) <= 1.0 ? first_order(z[0], std::asin(x), 1.0 / std::sqrt(1.0 - x * x)) : std::asin(z[0]);
}

Complex arc_cosine(In<Complex> z) {
  const double x = z[0].real();
  return std::abs(x) <= 1.0 ? first_order(z[0], std::acos(x), -1.0 / std::sqrt(1.0 - x * x)) : std::acos(z[0]);
}

Complex arc_tangent2(In<Complex> z) {
  const double y = z[0].real(), x = z[1].real();
  if (z[0].imag() == 0.0 && z[1].imag() == 0.0) return std::atan2(y, x);  // defined at the origin too, where the derivative is not
  return {std::atan2(y, x), (x * z[0].imag() - y * z[1].imag()) / (x * x + y * y)};
}

double sign_of(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : 0.0); }

}  // namespace

std::complex<double> expression_power(In<std::complex<double>> z) {
  const Complex base = z[0], exponent = z[1];
  const double n = exponent.real();
  if (exponent.imag() == 0.0 && base.imag() == 0.0) return std::pow(base.real(), n);
  // n x^(n-1) keeps the derivative of an integer power exact at zero and for negative bases, where exp(n log x) is not.
  if (exponent.imag() == 0.0) return {std::pow(base.real(), n), n == 0.0 ? 0.0 : n * std::pow(base.real(), n - 1.0) * base.imag()};
  return std::pow(base, exponent);
}

std::complex<double> expression_quotient(std::complex<double> a, std::complex<double> b) {
  return a.imag() == 0.0 && b.imag() == 0.0 ? Complex(a.real() / b.real()) : a / b;
}

const std::vector<ExpressionFunction>& expression_function_table() {
  static const std::vector<ExpressionFunction> kTable = {
      {"sqrt", 1, square_root},
      {"sin", 1, [](In<Complex> z) { return std::sin(z[0]); }},
      {"cos", 1, [](In<Complex> z) { return std::cos(z[0]); }},
      {"tan", 1, [](In<Complex> z) { return std::tan(z[0]); }},
      {"asin", 1, arc_sine},
      {"acos", 1, arc_cosine},
      {"atan", 1, [](In<Complex> z) { return std::atan(z[0]); }},
      {"atan2", 2, arc_tangent2},
      {"sinh", 1, [](In<Complex> z) { return std::sinh(z[0]); }},
      {"cosh", 1, [](In<Complex> z) { return std::cosh(z[0]); }},
      {"tanh", 1, [](In<Complex> z) { return std::tanh(z[0]); }},
      {"exp", 1, [](In<Complex> z) { return std::exp(z[0]); }},
      {"log", 1, [](In<Complex> z) { return std::log(z[0]); }},
      {"log10", 1, [](In<Complex> z) { return std::log10(z[0]); }},
      {"pow", 2, expression_power},
      {"abs", 1, [](In<Complex> z) { return z[0].real() >= 0.0 ? z[0] : -z[0]; }},
      {"sign", 1, [](In<Complex> z) { return Complex(sign_of(z[0].real())); }},
      {"min", -1, [](In<Complex> z) { return extreme(z, -1.0); }},
      {"max", -1, [](In<Complex> z) { return extreme(z, 1.0); }},
      {"floor", 1, [](In<Complex> z) { return Complex(std::floor(z[0].real())); }},
      {"ceil", 1, [](In<Complex> z) { return Complex(std::ceil(z[0].real())); }},
      {"radians", 1, [](In<Complex> z) { return z[0] * (kPi / 180.0); }},
      {"degrees", 1, [](In<Complex> z) { return z[0] * (180.0 / kPi); }},
  };
  return kTable;
}

int find_expression_function(const std::string& name) {
  const std::vector<ExpressionFunction>& table = expression_function_table();
  for (std::size_t k = 0; k < table.size(); ++k)
    if (name == table[k].name) return static_cast<int>(k);
  return -1;
}

}  // namespace codesign
