// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "expression_syntax.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <stdexcept>

#include "mechanism_codesign/model/expression.h"
#include "mechanism_codesign/model/nearest_name.h"
#include "mechanism_codesign/model/unknown_name.h"

namespace codesign {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool starts_identifier(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool continues_identifier(char c) { return starts_identifier(c) || is_digit(c); }
bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

class Scanner {
 public:
  Scanner(const std::string& text, const std::vector<std::string>& names) : text_(text), names_(names) {}

  std::vector<int> run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (starts_identifier(c)) {
        name();
      } else if (is_digit(c) || c == '.') {
        number();
      } else {
        other(c);
      }
    }
    return {used_.begin(), used_.end()};
  }

 private:
  [[noreturn]] void fail(const std::string& what, std::size_t position) const {
    throw std::invalid_argument(what + " at position " + std::to_string(position + 1) + " of '" + text_ + "'");
  }

  [[noreturn]] void unknown(const std::string& kind, const std::string& word, const std::vector<std::string>& known,
                            std::size_t position) const {
    const std::string near = nearest_name(word, known);
    const std::string hint = near.empty() ? " (known: " + list_names(known) + ")" : ", did you mean '" + near + "'?";
    fail("unknown " + kind + " '" + word + "'" + hint, position);
  }

  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  void name() {
    const std::size_t begin = at_;
    while (continues_identifier(peek())) ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    std::size_t next = at_;
    while (next < text_.size() && text_[next] == ' ') ++next;
    const bool is_call = next < text_.size() && text_[next] == '(';
    const std::vector<std::string>& functions = expression_functions();
    if (is_call) {
      if (contains(functions, word)) return;
      unknown("function", word, functions, begin);
    }
    if (word == "pi") return;
    if (contains(functions, word)) fail("the function '" + word + "' lacks its parentheses", begin);
    const auto found = std::find(names_.begin(), names_.end(), word);
    if (found != names_.end()) {
      used_.insert(static_cast<int>(found - names_.begin()));
      return;
    }
    std::vector<std::string> known = names_;
    known.push_back("pi");
    unknown("name", word, known, begin);
  }

  void digits() {
    while (is_digit(peek())) ++at_;
  }

  void number() {
    const std::size_t begin = at_;
    digits();
    if (peek() == '.') ++at_;
    digits();
    const std::size_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
    if ((peek() == 'e' || peek() == 'E') && is_digit(peek(1 + sign))) {
      at_ += 1 + sign;
      digits();
    }
    if (continues_identifier(peek()) || peek() == '.' || text_.substr(begin, at_ - begin) == ".") fail("malformed number", begin);
  }

  void other(char c) {
    static const std::string kAllowed = "+-*/^()<>=!?:, \t\r\n";
    if (kAllowed.find(c) == std::string::npos) fail(std::string("unexpected character '") + c + "'", at_);
    const bool compares = (c == '=' || c == '!' || c == '<' || c == '>') && peek(1) == '=';
    if ((c == '=' || c == '!') && !compares) fail(std::string("unexpected '") + c + "' (comparisons are == != < <= > >=)", at_);
    at_ += compares ? 2 : 1;
  }

  const std::string& text_;
  const std::vector<std::string>& names_;
  std::size_t at_ = 0;
  std::set<int> used_;
};

}  // namespace

const std::vector<std::string>& expression_functions() {
  static const std::vector<std::string> kNames = {"sqrt", "sin",  "cos",  "tan",   "asin", "acos",    "atan",   "atan2",
                                                  "sinh", "cosh", "tanh", "exp",   "log",  "log10",   "pow",    "abs",
                                                  "sign", "min",  "max",  "floor", "ceil", "radians", "degrees"};
  return kNames;
}

std::vector<int> scan_expression(const std::string& text, const std::vector<std::string>& names) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) throw std::invalid_argument("the expression is empty");
  return Scanner(text, names).run();
}

std::string identifier_fault(const std::string& name) {
  if (name.empty()) return "the name is empty";
  if (!starts_identifier(name[0]) || !std::all_of(name.begin(), name.end(), continues_identifier))
    return "'" + name + "' is no identifier (letters, digits and _, not starting with a digit)";
  if (name == "pi" || contains(expression_functions(), name)) return "'" + name + "' has a meaning of its own in expressions";
  return "";
}

}  // namespace codesign
