// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_syntax.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "description/expression.h"
#include "description/formula.h"
#include "math/arrays.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

using Code = ExpressionStep::Code;
using Kind = ExpressionToken::Kind;

constexpr int kDeepest = 200;  // recursive calls of the parser; bounds its use of the stack

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const ExpressionFunction& function : expression_function_table())
    names.emplace_back(function.name);
  return names;
}

class Parser {
 public:
  Parser(const std::string& text, const ExpressionScope& scope)
      : scope_(scope), scanner_(text, scope) {}

  ParsedExpression run() {
    if (scanner_.token().kind == Kind::kEnd) throw std::invalid_argument("the expression is empty");
    const Type type = conditional();
    if (type == Type::kTruth && !scope_.is_condition)
      scanner_.fail("a comparison is not a number", 0);
    if (type == Type::kNumber && scope_.is_condition)
      scanner_.fail("a number stands where a comparison is needed", 0);
    if (scanner_.token().kind != Kind::kEnd) unexpected();
    return finish();
  }

 private:
  enum class Type { kNumber, kTruth };

  /// Counts the depth of recursion during its lifetime; fails beyond kDeepest.
  class Level {
   public:
    explicit Level(Parser* parser) : parser_(parser) {
      if (++parser_->depth_ > kDeepest)
        parser_->scanner_.fail("brackets, powers or conditions nested too deeply",
                               parser_->scanner_.token().at);
    }
    ~Level() { --parser_->depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser* parser_;
  };

  Type conditional() {
    const Level level(this);
    const std::size_t begin = scanner_.token().at;
    const Type type = disjunction();
    if (!scanner_.is("?")) return type;
    if (type != Type::kTruth)
      scanner_.fail("a number stands before '?' where a comparison is needed", begin);
    scanner_.next();
    const std::size_t to_second = add({Code::kJumpUnless, 0, 0, 0.0});
    number(&Parser::conditional);
    expect(":", "a ':' that belongs to its '?'");
    const std::size_t to_end = add({Code::kJump, 0, 0, 0.0});
    steps_[to_second].index = branch_end();
    number(&Parser::conditional);
    steps_[to_end].index = branch_end();
    return Type::kNumber;
  }

  // Truth is 1 or 0, so that a product is `and`, 1 - x is `not x`, and `x or y` is the negation of
  // both negated. All comparisons are evaluated: none hides another one.

  Type disjunction() {
    const std::size_t begin = scanner_.token().at;
    const Type type = conjunction();
    if (!scanner_.is_word("or")) return type;
    need_truth(type, begin);
    negate();
    while (scanner_.is_word("or")) {
      scanner_.next();
      truth(&Parser::conjunction);
      negate();
      operate({Code::kMultiply, 0, 2, 0.0});
    }
    negate();
    return Type::kTruth;
  }

  Type conjunction() {
    const std::size_t begin = scanner_.token().at;
    const Type type = negation();
    if (!scanner_.is_word("and")) return type;
    need_truth(type, begin);
    while (scanner_.is_word("and")) {
      scanner_.next();
      truth(&Parser::negation);
      operate({Code::kMultiply, 0, 2, 0.0});
    }
    return Type::kTruth;
  }

  Type negation() {
    if (!scanner_.is_word("not")) return comparison();
    const Level level(this);
    scanner_.next();
    truth(&Parser::negation);
    negate();
    return Type::kTruth;
  }

  /// Replaces the truth on the stack by 1 minus it.
  void negate() {
    operate({Code::kNegate, 0, 1, 0.0});
    add({Code::kConstant, 0, 0, 1.0});
    operate({Code::kAdd, 0, 2, 0.0});
  }

  void truth(Type (Parser::*rule)()) {
    const std::size_t begin = scanner_.token().at;
    need_truth((this->*rule)(), begin);
  }

  void need_truth(Type type, std::size_t begin) const {
    if (type == Type::kNumber) scanner_.fail("a number stands where a comparison is needed", begin);
  }

  Type comparison() {
    static const std::map<std::string, Code> kCodes = {
        {"<", Code::kLess},    {"<=", Code::kLessOrEqual},
        {">", Code::kGreater}, {">=", Code::kGreaterOrEqual},
        {"==", Code::kEqual},  {"!=", Code::kNotEqual}};
    const std::size_t begin = scanner_.token().at;
    const Type type = sum();
    const auto found = kCodes.find(scanner_.token().text);
    if (found == kCodes.end()) return type;
    need_number(type, begin);
    scanner_.next();
    number(&Parser::sum);
    if (kCodes.count(scanner_.token().text) > 0)
      scanner_.fail("a comparison stands where a number is needed", scanner_.token().at);
    operate({found->second, 0, 2, 0.0}, begin);
    return Type::kTruth;
  }

  Type sum() { return chain("+", Code::kAdd, "-", Code::kSubtract, &Parser::product); }
  Type product() { return chain("*", Code::kMultiply, "/", Code::kDivide, &Parser::signs); }

  /// `part {symbol part}`, left associative.
  Type chain(const char* first, Code first_code, const char* second, Code second_code,
             Type (Parser::*part)()) {
    const std::size_t begin = scanner_.token().at;
    const Type type = (this->*part)();
    while (scanner_.is(first) || scanner_.is(second)) {
      need_number(type, begin);
      const Code code = scanner_.is(first) ? first_code : second_code;
      scanner_.next();
      number(part);
      operate({code, 0, 2, 0.0});
    }
    return type;
  }

  Type signs() {
    const std::size_t begin = scanner_.token().at;
    bool negative = false, any = false;
    for (; scanner_.is("-") || scanner_.is("+"); scanner_.next()) {
      any = true;
      if (scanner_.is("-")) negative = !negative;
    }
    const Type type = power();
    if (any) need_number(type, begin);
    if (negative) operate({Code::kNegate, 0, 1, 0.0});
    return type;
  }

  Type power() {
    const Level level(this);
    const std::size_t begin = scanner_.token().at;
    const Type type = operand();
    if (!scanner_.is("^") && !scanner_.is("**")) return type;
    need_number(type, begin);
    scanner_.next();
    number(&Parser::signs);
    operate({Code::kPower, 0, 2, 0.0});
    return Type::kNumber;
  }

  Type operand() {
    const ExpressionToken token = scanner_.token();
    if (token.kind == Kind::kNumber) {
      scanner_.next();
      add({Code::kConstant, 0, 0, token.number});
      return Type::kNumber;
    }
    if (token.kind == Kind::kName) {
      name(token);
      return Type::kNumber;
    }
    if (!scanner_.is("(")) unexpected();
    scanner_.next();
    const Type type = conditional();
    expect(")", "a closing parenthesis");
    return type;
  }

  void name(const ExpressionToken& token) {
    const int function = find_expression_function(token.text);
    scanner_.next();
    if (scanner_.is("(")) {
      if (function < 0) unknown("function", token, function_names());
      call(function, token);
    } else if (token.text == "pi") {
      add({Code::kConstant, 0, 0, M_PI});
    } else if (function >= 0) {
      scanner_.fail("the function '" + token.text + "' lacks its parentheses", token.at);
    } else {
      const int parameter = scope_.find(token.text);
      if (parameter < 0) unknown_parameter(token);
      used_.emplace(parameter, 0);
      add({Code::kVariable, parameter, 0, 0.0});
    }
  }

  void call(int function, const ExpressionToken& token) {
    const int wanted = expression_function_table()[to_index(function)].count;
    scanner_.next();
    int count = 0;
    if (!scanner_.is(")")) {
      for (;; scanner_.next()) {
        number(&Parser::conditional);
        ++count;
        if (!scanner_.is(",")) break;
      }
    }
    expect(")", "a comma or a closing parenthesis");
    if (wanted >= 0 ? count != wanted : count < 1)
      scanner_.fail("the function '" + token.text + "' takes " +
                        (wanted < 0 ? "at least 1" : std::to_string(wanted)) + " argument" +
                        (wanted == 2 ? "s" : "") + ", not " + std::to_string(count),
                    token.at);
    operate({Code::kCall, function, count, 0.0}, token.at);
  }

  void number(Type (Parser::*rule)()) {
    const std::size_t begin = scanner_.token().at;
    need_number((this->*rule)(), begin);
  }

  void need_number(Type type, std::size_t begin) const {
    if (type == Type::kTruth) scanner_.fail("a comparison stands where a number is needed", begin);
  }

  void expect(const char* symbol, const char* what) {
    if (!scanner_.is(symbol))
      scanner_.fail(std::string("expected ") + what + found(), scanner_.token().at);
    scanner_.next();
  }

  std::string found() const {
    return scanner_.token().kind == Kind::kEnd
               ? ", found the end"
               : ", found '" + scanner_.token().text.substr(0, 40) + "'";
  }

  [[noreturn]] void unexpected() const {
    const ExpressionToken& token = scanner_.token();
    if (token.kind == Kind::kEnd) scanner_.fail("a number is missing", token.at);
    if (token.text == ",") scanner_.fail("a comma outside a function's parentheses", token.at);
    if (token.text == ")") scanner_.fail("a closing parenthesis without its opening one", token.at);
    if (token.text == ":") scanner_.fail("a ':' without its '?'", token.at);
    const bool operand = token.kind != Kind::kSymbol || token.text == "(";
    if (operand)
      scanner_.fail("an operator is missing before '" + token.text.substr(0, 40) + "'", token.at);
    scanner_.fail("a number is missing before '" + token.text + "'", token.at);
  }

  [[noreturn]] void unknown(const std::string& kind, const ExpressionToken& token,
                            const std::vector<std::string>& known) const {
    const std::string near = nearest_name(token.text, known);
    const std::string hint =
        near.empty() ? " (known: " + list_names(known) + ")" : ", did you mean '" + near + "'?";
    scanner_.fail("unknown " + kind + " '" + token.text.substr(0, 60) + "'" + hint, token.at);
  }

  [[noreturn]] void unknown_parameter(const ExpressionToken& token) const {
    std::vector<std::string> known = scope_.names();
    known.emplace_back("pi");
    unknown("name", token, known);
  }

  std::size_t add(const ExpressionStep& step) {
    steps_.push_back(step);
    return steps_.size() - 1;
  }

  /// The next step, to which steps before it jump.
  int branch_end() {
    folded_ = steps_.size();
    return static_cast<int>(folded_);
  }

  /// Adds an operation whose text begins at a byte and ends with the last token.
  void operate(ExpressionStep operation, std::size_t begin) {
    operation.begin = static_cast<int>(begin);
    operation.end = static_cast<int>(scanner_.behind_last());
    operate(operation);
  }

  /// Adds an operation of `count` operands. Of constants it is a constant: 1 + 1 in x**(1 + 1).
  void operate(const ExpressionStep& operation) {
    const std::size_t count = to_index(operation.count);
    const bool is_constant =
        steps_.size() >= folded_ + count &&
        std::all_of(steps_.end() - operation.count, steps_.end(),
                    [](const ExpressionStep& step) { return step.code == Code::kConstant; });
    add(operation);
    if (!is_constant) return;
    const ExpressionSteps alone(steps_.end() - operation.count - 1, steps_.end());
    steps_.resize(steps_.size() - count - 1);
    add({Code::kConstant, 0, 0, evaluate_formula<double>(alone, {})});
  }

  /// Renumbers the variables by their position among the parameters used.
  ParsedExpression finish() {
    ParsedExpression parsed;
    for (auto& [parameter, place] : used_) {
      place = static_cast<int>(parsed.dependencies.size());
      parsed.dependencies.push_back(parameter);
    }
    for (ExpressionStep& step : steps_)
      if (step.code == Code::kVariable) step.index = used_.at(step.index);
    parsed.steps = std::move(steps_);
    return parsed;
  }

  const ExpressionScope& scope_;
  ExpressionScanner scanner_;
  ExpressionSteps steps_;
  std::map<int, int> used_;  ///< parameter to variable
  int depth_ = 0;
  std::size_t folded_ = 0;  ///< steps before this one are not changed: a jump leads behind them
};

}  // namespace

ParsedExpression parse_expression(const std::string& text, const ExpressionScope& scope) {
  return Parser(text, scope).run();
}

std::string identifier_fault(const std::string& name) {
  if (name.empty()) return "the name is empty";
  if (!starts_identifier(name[0]) || !std::all_of(name.begin(), name.end(), continues_identifier))
    return "'" + name + "' is not an identifier (letters, digits and _, not starting with a digit)";
  if (name == "pi" || find_expression_function(name) >= 0)
    return "'" + name + "' is a function or constant of expressions; choose another name";
  if (name == "and" || name == "or" || name == "not")
    return "'" + name + "' is an operator of expressions; choose another name";
  return "";
}

}  // namespace codesign
