// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "description/expression.h"

namespace codesign {

/// A number, name, operator or bracket of an expression, or its end.
struct ExpressionToken {
  enum class Kind { kNumber, kName, kSymbol, kEnd };
  Kind kind = Kind::kEnd;
  std::string text;  ///< as written; empty at the end
  double number = 0.0;
  std::size_t at = 0;  ///< byte where it begins, from 0
};

/// Splits an expression into tokens. White space and line breaks separate tokens. It keeps a
/// reference to the text.
class ExpressionScanner {
 public:
  /// Reads the first token. @param scope which signals there are; must outlive the scanner.
  /// @throws std::invalid_argument if it is invalid.
  ExpressionScanner(const std::string& text, const ExpressionScope& scope)
      : text_(text), scope_(scope) {
    next();
  }

  const ExpressionToken& token() const { return token_; }
  /// Where the token before it ends.
  std::size_t behind_last() const { return behind_last_; }
  bool is(const char* symbol) const {
    return token_.kind == ExpressionToken::Kind::kSymbol && token_.text == symbol;
  }
  /// Whether the token is one of the words and, or, not.
  bool is_word(const char* word) const {
    return token_.kind == ExpressionToken::Kind::kName && token_.text == word;
  }
  /// Reads the next token. @throws std::invalid_argument if it is invalid.
  void next();

  /// Throws std::invalid_argument with the sentence `what at position N of 'text'`; N counts from
  /// 1, and of a text of more than 120 bytes only the part around the position is shown.
  [[noreturn]] void fail(const std::string& what, std::size_t at) const;

 private:
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  void read_number();
  void read_symbol();

  const std::string& text_;
  const ExpressionScope& scope_;
  std::size_t at_ = 0, behind_last_ = 0;
  ExpressionToken token_;
};

/// Whether an identifier may begin with this character (a letter or _), or contain it (also
/// digits).
bool starts_identifier(char c);
bool continues_identifier(char c);

}  // namespace codesign
