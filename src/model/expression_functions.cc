// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "expression_functions.h"

#include <muparserx/mpOprtCmplx.h>
#include <muparserx/mpValReader.h>

#include <cmath>
#include <complex>

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = 3.14159265358979323846;

Complex argument(const mup::ptr_val_type& value) {
  if (value->GetType() == 'b') throw mup::ParserError("a comparison stands where a number is needed");
  return value->GetComplex();
}

/// A function of any number of numbers; `count` -1: one or more.
class Function : public mup::ICallback {
 public:
  using Law = Complex (*)(const Complex* arguments, int count);
  Function(const char* name, int count, Law law) : ICallback(mup::cmFUNC, name, count), law_(law) {}

  void Eval(mup::ptr_val_type& result, const mup::ptr_val_type* arguments, int count) override {
    if (count < 1) throw mup::ParserError("a function lacks its argument");
    std::vector<Complex> values;
    values.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) values.push_back(argument(arguments[k]));
    *result = law_(values.data(), count);
  }
  const mup::char_type* GetDesc() const override { return ""; }
  mup::IToken* Clone() const override { return new Function(*this); }

 private:
  Law law_;
};

class Power : public mup::IOprtBin {
 public:
  explicit Power(const char* name) : IOprtBin(name, mup::prPOW, mup::oaRIGHT) {}
  static Complex law(const Complex* z, int) {
    const Complex base = z[0], exponent = z[1];
    const double n = exponent.real();
    if (exponent.imag() == 0.0 && base.imag() == 0.0) return std::pow(base.real(), n);
    // n x^(n-1) keeps the derivative of an integer power exact at zero and for negative bases, where exp(n log x) is not.
    if (exponent.imag() == 0.0) return {std::pow(base.real(), n), n == 0.0 ? 0.0 : n * std::pow(base.real(), n - 1.0) * base.imag()};
    return std::pow(base, exponent);
  }
  void Eval(mup::ptr_val_type& result, const mup::ptr_val_type* arguments, int) override {
    const Complex values[2] = {argument(arguments[0]), argument(arguments[1])};
    *result = law(values, 2);
  }
  const mup::char_type* GetDesc() const override { return ""; }
  mup::IToken* Clone() const override { return new Power(*this); }
};

class Comparison : public mup::IOprtBin {
 public:
  using Law = bool (*)(double, double);
  Comparison(const char* name, int precedence, Law law) : IOprtBin(name, precedence, mup::oaLEFT), law_(law) {}
  void Eval(mup::ptr_val_type& result, const mup::ptr_val_type* arguments, int) override {
    *result = law_(argument(arguments[0]).real(), argument(arguments[1]).real());
  }
  const mup::char_type* GetDesc() const override { return ""; }
  mup::IToken* Clone() const override { return new Comparison(*this); }

 private:
  Law law_;
};

class UnaryPlus : public mup::IOprtInfix {
 public:
  UnaryPlus() : IOprtInfix("+", mup::prINFIX) {}
  void Eval(mup::ptr_val_type& result, const mup::ptr_val_type* arguments, int) override { *result = argument(arguments[0]); }
  const mup::char_type* GetDesc() const override { return ""; }
  mup::IToken* Clone() const override { return new UnaryPlus(*this); }
};

Complex extreme(const Complex* z, int count, double sign) {
  Complex best = z[0];
  for (int k = 1; k < count; ++k)
    if (sign * z[k].real() > sign * best.real()) best = z[k];
  return best;
}

Complex arc_tangent2(const Complex* z, int) {
  const double y = z[0].real(), x = z[1].real();
  return {std::atan2(y, x), (x * z[0].imag() - y * z[1].imag()) / (x * x + y * y)};
}

double sign_of(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : 0.0); }

void install_functions(mup::ParserX* parser) {
  const auto define = [parser](const char* name, int count, Function::Law law) { parser->DefineFun(new Function(name, count, law)); };
  define("sqrt", 1, [](const Complex* z, int) { return std::sqrt(*z); });
  define("sin", 1, [](const Complex* z, int) { return std::sin(*z); });
  define("cos", 1, [](const Complex* z, int) { return std::cos(*z); });
  define("tan", 1, [](const Complex* z, int) { return std::tan(*z); });
  define("asin", 1, [](const Complex* z, int) { return std::asin(*z); });
  define("acos", 1, [](const Complex* z, int) { return std::acos(*z); });
  define("atan", 1, [](const Complex* z, int) { return std::atan(*z); });
  define("atan2", 2, arc_tangent2);
  define("sinh", 1, [](const Complex* z, int) { return std::sinh(*z); });
  define("cosh", 1, [](const Complex* z, int) { return std::cosh(*z); });
  define("tanh", 1, [](const Complex* z, int) { return std::tanh(*z); });
  define("exp", 1, [](const Complex* z, int) { return std::exp(*z); });
  define("log", 1, [](const Complex* z, int) { return std::log(*z); });
  define("log10", 1, [](const Complex* z, int) { return std::log10(*z); });
  define("pow", 2, Power::law);
  define("abs", 1, [](const Complex* z, int) { return z->real() >= 0.0 ? *z : -*z; });
  define("sign", 1, [](const Complex* z, int) { return Complex(sign_of(z->real())); });
  define("min", -1, [](const Complex* z, int count) { return extreme(z, count, -1.0); });
  define("max", -1, [](const Complex* z, int count) { return extreme(z, count, 1.0); });
  define("floor", 1, [](const Complex* z, int) { return Complex(std::floor(z->real())); });
  define("ceil", 1, [](const Complex* z, int) { return Complex(std::ceil(z->real())); });
  define("radians", 1, [](const Complex* z, int) { return *z * (kPi / 180.0); });
  define("degrees", 1, [](const Complex* z, int) { return *z * (180.0 / kPi); });
}

}  // namespace

void install_expression_functions(mup::ParserX* parser) {
  parser->AddValueReader(new mup::DblValReader);
  parser->DefineConst("pi", mup::Value(kPi));
  parser->DefineInfixOprt(new mup::OprtSignCmplx);
  parser->DefineInfixOprt(new UnaryPlus);
  parser->DefineOprt(new mup::OprtAddCmplx);
  parser->DefineOprt(new mup::OprtSubCmplx);
  parser->DefineOprt(new mup::OprtMulCmplx);
  parser->DefineOprt(new mup::OprtDivCmplx);
  parser->DefineOprt(new Power("^"));
  parser->DefineOprt(new Power("**"));
  parser->DefineOprt(new Comparison("<", mup::prRELATIONAL2, [](double a, double b) { return a < b; }));
  parser->DefineOprt(new Comparison("<=", mup::prRELATIONAL2, [](double a, double b) { return a <= b; }));
  parser->DefineOprt(new Comparison(">", mup::prRELATIONAL2, [](double a, double b) { return a > b; }));
  parser->DefineOprt(new Comparison(">=", mup::prRELATIONAL2, [](double a, double b) { return a >= b; }));
  parser->DefineOprt(new Comparison("==", mup::prRELATIONAL1, [](double a, double b) { return a == b; }));
  parser->DefineOprt(new Comparison("!=", mup::prRELATIONAL1, [](double a, double b) { return a != b; }));
  install_functions(parser);
}

}  // namespace codesign
