// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_scanner.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "text/number_text.h"

namespace codesign {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

bool starts_identifier(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool continues_identifier(char c) { return starts_identifier(c) || is_digit(c); }

void ExpressionScanner::fail(const std::string& what, std::size_t at) const {
  constexpr std::size_t kWhole = 120, kBefore = 30, kShown = 60;
  const std::size_t first = text_.size() <= kWhole || at < kBefore ? 0 : at - kBefore;
  const std::size_t count = text_.size() <= kWhole ? text_.size() : kShown;
  const std::string shown = (first > 0 ? "..." : "") + text_.substr(first, count) +
                            (first + count < text_.size() ? "..." : "");
  throw std::invalid_argument(what + " at position " + std::to_string(at + 1) + " of '" + shown +
                              "'");
}

void ExpressionScanner::next() {
  behind_last_ = at_;
  while (is_space(peek())) ++at_;
  token_ = {ExpressionToken::Kind::kEnd, "", 0.0, at_};
  if (at_ >= text_.size()) return;
  if (starts_identifier(peek())) {
    while (continues_identifier(peek())) ++at_;
    if (scope_.signal_end) at_ = std::max(at_, scope_.signal_end(text_, token_.at));
    token_.kind = ExpressionToken::Kind::kName;
    token_.text = text_.substr(token_.at, at_ - token_.at);
  } else if (is_digit(peek()) || peek() == '.') {
    read_number();
  } else {
    read_symbol();
  }
}

void ExpressionScanner::read_number() {
  const auto digits = [this] {
    while (is_digit(peek())) ++at_;
  };
  digits();
  if (peek() == '.') ++at_;
  digits();
  const std::size_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
  if ((peek() == 'e' || peek() == 'E') && is_digit(peek(1 + sign))) {
    at_ += 1 + sign;
    digits();
  }
  token_.kind = ExpressionToken::Kind::kNumber;
  token_.text = text_.substr(token_.at, at_ - token_.at);
  if (continues_identifier(peek()) || peek() == '.' || token_.text == ".")
    fail("malformed number", token_.at);
  const std::optional<double> number = parse_number(token_.text);
  if (!number) fail("number too large or too small for floating point", token_.at);
  token_.number = *number;
}

void ExpressionScanner::read_symbol() {
  static const std::string kAllowed = "+-*/^()<>=!?:,";
  const char c = peek();
  // Show all bytes of a UTF-8 character.
  std::size_t length = 1;
  while (static_cast<unsigned char>(c) >= 0x80 &&
         (static_cast<unsigned char>(peek(length)) & 0xC0) == 0x80)
    ++length;
  if (kAllowed.find(c) == std::string::npos)
    fail("unexpected character '" + text_.substr(at_, length) + "'", at_);
  const bool compares = (c == '=' || c == '!' || c == '<' || c == '>') && peek(1) == '=';
  if ((c == '=' || c == '!') && !compares)
    fail(std::string("unexpected '") + c + "' (comparisons are == != < <= > >=)", at_);
  at_ += compares || (c == '*' && peek(1) == '*') ? 2 : 1;
  token_.kind = ExpressionToken::Kind::kSymbol;
  token_.text = text_.substr(token_.at, at_ - token_.at);
}

}  // namespace codesign
