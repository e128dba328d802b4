// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DESCRIPTION_EXPRESSION_SCANNER_H_
#define MECHANISM_CODESIGN_DESCRIPTION_EXPRESSION_SCANNER_H_

#include <cstddef>
#include <string>

namespace codesign {

/// A piece of an expression: a number, a name, an operator or a bracket.
struct ExpressionToken {
  enum class Kind { kNumber, kName, kSymbol, kEnd };
  Kind kind = Kind::kEnd;
  std::string text;  ///< as written; empty at the end
  double number = 0.0;
  std::size_t at = 0;  ///< where it begins, from 0
};

/// Splits an expression into tokens. White space, line breaks too, separates.
class ExpressionScanner {
 public:
  /// @throws std::invalid_argument if the first token is none.
  explicit ExpressionScanner(const std::string& text) : text_(text) { next(); }

  const ExpressionToken& token() const { return token_; }
  bool is(const char* symbol) const { return token_.kind == ExpressionToken::Kind::kSymbol && token_.text == symbol; }
  /// Goes on to the next token. @throws std::invalid_argument for what is no token.
  void next();

  /// Throws std::invalid_argument: `what at position N of 'text'`, a long text being shown around the position only.
  [[noreturn]] void fail(const std::string& what, std::size_t at) const;

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void read_number();
  void read_symbol();

  const std::string& text_;
  std::size_t at_ = 0;
  ExpressionToken token_;
};

bool starts_identifier(char c);
bool continues_identifier(char c);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DESCRIPTION_EXPRESSION_SCANNER_H_
