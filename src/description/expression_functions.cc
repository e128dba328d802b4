// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_functions.h"

#include <cmath>

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = 3.14159265358979323846;

Complex extreme(const Complex* z, int count, double sign) {
  Complex best = z[0];
  for (int k = 1; k < count; ++k)
    if (sign * z[k].real() > sign * best.real()) best = z[k];
  return best;
}

/// value + i slope Im z: a function with this value and slope, applied to a complex step, to first order. Unlike the analytic continuation
/// this gives an infinite derivative at an end of the domain where the slope is infinite.
Complex first_order(const Complex& z, double value, double slope) { return {value, z.imag() == 0.0 ? 0.0 : slope * z.imag()}; }

Complex square_root(const Complex* z, int) {
  const double x = z->real(), root = std::sqrt(x);
  return x >= 0.0 ? first_order(*z, root, 0.5 / root) : std::sqrt(*z);
}

Complex arc_sine(const Complex* z, int) {
  const double x = z->real();
  return std::abs(x) <= 1.0 ? first_order(*z, std::asin(x), 1.0 / std::sqrt(1.0 - x * x)) : std::asin(*z);
}

Complex arc_cosine(const Complex* z, int) {
  const double x = z->real();
  return std::abs(x) <= 1.0 ? first_order(*z, std::acos(x), -1.0 / std::sqrt(1.0 - x * x)) : std::acos(*z);
}

Complex arc_tangent2(const Complex* z, int) {
  const double y = z[0].real(), x = z[1].real();
  if (z[0].imag() == 0.0 && z[1].imag() == 0.0) return std::atan2(y, x);  // defined at the origin too, where the derivative is not
  return {std::atan2(y, x), (x * z[0].imag() - y * z[1].imag()) / (x * x + y * y)};
}

double sign_of(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : 0.0); }

}  // namespace

std::complex<double> expression_power(const std::complex<double>* z, int) {
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
      {"sin", 1, [](const Complex* z, int) { return std::sin(*z); }},
      {"cos", 1, [](const Complex* z, int) { return std::cos(*z); }},
      {"tan", 1, [](const Complex* z, int) { return std::tan(*z); }},
      {"asin", 1, arc_sine},
      {"acos", 1, arc_cosine},
      {"atan", 1, [](const Complex* z, int) { return std::atan(*z); }},
      {"atan2", 2, arc_tangent2},
      {"sinh", 1, [](const Complex* z, int) { return std::sinh(*z); }},
      {"cosh", 1, [](const Complex* z, int) { return std::cosh(*z); }},
      {"tanh", 1, [](const Complex* z, int) { return std::tanh(*z); }},
      {"exp", 1, [](const Complex* z, int) { return std::exp(*z); }},
      {"log", 1, [](const Complex* z, int) { return std::log(*z); }},
      {"log10", 1, [](const Complex* z, int) { return std::log10(*z); }},
      {"pow", 2, expression_power},
      {"abs", 1, [](const Complex* z, int) { return z->real() >= 0.0 ? *z : -*z; }},
      {"sign", 1, [](const Complex* z, int) { return Complex(sign_of(z->real())); }},
      {"min", -1, [](const Complex* z, int count) { return extreme(z, count, -1.0); }},
      {"max", -1, [](const Complex* z, int count) { return extreme(z, count, 1.0); }},
      {"floor", 1, [](const Complex* z, int) { return Complex(std::floor(z->real())); }},
      {"ceil", 1, [](const Complex* z, int) { return Complex(std::ceil(z->real())); }},
      {"radians", 1, [](const Complex* z, int) { return *z * (kPi / 180.0); }},
      {"degrees", 1, [](const Complex* z, int) { return *z * (180.0 / kPi); }},
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
