// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/model/expression.h"

#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "expression_functions.h"
#include "expression_syntax.h"

namespace codesign {
namespace {

/// muParserX fills static tables when the first parser is made, without a lock of its own.
std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

struct Expression::Parser {
  mup::ParserX parser{0};  // bare: the library's packages would reserve `i`, `e` and units as names
  std::vector<mup::Value> variables;
  std::mutex mutex;

  template <class T>
  std::complex<double> evaluate(const std::vector<int>& dependencies, const std::vector<T>& parameters) {
    const std::lock_guard<std::mutex> lock(mutex);
    for (std::size_t k = 0; k < dependencies.size(); ++k)
      variables[k] = mup::Value(mup::cmplx_type{parameters.at(static_cast<std::size_t>(dependencies[k]))});
    try {
      const mup::IValue& result = parser.Eval();
      if (result.GetType() != 'b') return result.GetComplex();
    } catch (const mup::ParserError&) {
      // Only a branch of `?:` that construction did not reach can fail here.
    }
    return std::numeric_limits<double>::quiet_NaN();
  }
};

Expression::Expression(const std::string& text, const std::vector<std::string>& names)
    : text_(text), dependencies_(scan_expression(text, names)) {
  const std::lock_guard<std::mutex> lock(library_mutex());
  try {
    parser_ = std::make_unique<Parser>();
    install_expression_functions(&parser_->parser);
    parser_->variables.assign(dependencies_.size(), mup::Value(1.0));
    for (std::size_t k = 0; k < dependencies_.size(); ++k)
      parser_->parser.DefineVar(names[static_cast<std::size_t>(dependencies_[k])], mup::Variable(&parser_->variables[k]));
    parser_->parser.SetExpr(text);
    if (parser_->parser.Eval().GetType() == 'b') throw std::invalid_argument("a comparison is not a number in '" + text + "'");
  } catch (const mup::ParserError& error) {
    throw std::invalid_argument(error.GetMsg() + " In '" + text + "'");
  }
}

Expression::~Expression() = default;

double Expression::value(const std::vector<double>& parameters) const {
  const std::complex<double> result = parser_->evaluate(dependencies_, parameters);
  return result.imag() == 0.0 ? result.real() : std::numeric_limits<double>::quiet_NaN();
}

std::complex<double> Expression::value(const std::vector<std::complex<double>>& parameters) const {
  return parser_->evaluate(dependencies_, parameters);
}

double Expression::derivative(int index, const std::vector<double>& parameters) const {
  constexpr double kStep = 1e-30;
  std::vector<std::complex<double>> stepped(parameters.begin(), parameters.end());
  stepped.at(static_cast<std::size_t>(index)) += std::complex<double>(0.0, kStep);
  return value(stepped).imag() / kStep;
}

}  // namespace codesign
