// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/signal.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <utility>

#include "description/expression_syntax.h"
#include "description/signal_table.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kFormOfSignal =
    "<joint>/<quantity>, <link>/<quantity>/{x,y,z}, the same in the axes of a link, "
    "<link>/<quantity>/{x,y,z}@<link>, <controller>/<quantity>, sums and differences of them, and "
    "expressions of them, ${...}";

constexpr const char* kFormOfCondition =
    "a comparison of signals, parameters and the time t, ${axis/position > 0.3}, or several joined "
    "by and, or and not";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\n") - first + 1);
}

bool continues_name(char c) { return continues_identifier(c) || c == '-' || c == '.'; }

std::size_t signal_end(const std::string& text, std::size_t at);

/// The end of the name of a link behind an @: before a `-` that another signal follows, and with
/// slashes that a letter follows.
std::size_t axes_end(const std::string& text, std::size_t at) {
  for (; at < text.size(); ++at) {
    if (text[at] == '-' && signal_end(text, at + 1) != at + 1) break;
    const bool is_path = text[at] == '/' && at + 1 < text.size() &&
                         std::isalpha(static_cast<unsigned char>(text[at + 1])) != 0;
    if (!continues_name(text[at]) && !is_path) break;
  }
  return at;
}

/// The end of the signal that begins at a byte of an expression, or that byte: a name, which may
/// contain slashes, then a slash and a known quantity, a component of one letter, and @ with a
/// link.
std::size_t signal_end(const std::string& text, std::size_t at) {
  const auto name_end = [&text](std::size_t k) {
    while (k < text.size() && continues_name(text[k])) ++k;
    return k;
  };
  for (std::size_t slash = name_end(at); slash < text.size() && text[slash] == '/';
       slash = name_end(slash + 1)) {
    std::size_t end = slash + 1;
    while (end < text.size() && continues_identifier(text[end])) ++end;
    if (!is_quantity(text.substr(slash + 1, end - slash - 1))) continue;
    const bool has_component = end + 1 < text.size() && text[end] == '/' &&
                               std::string("wxyz").find(text[end + 1]) != std::string::npos &&
                               (end + 2 == text.size() || !continues_identifier(text[end + 2]));
    if (!has_component) return end;
    return end + 2 < text.size() && text[end + 2] == '@' ? axes_end(text, end + 3) : end + 2;
  }
  return at;
}

/// Parses from left to right. An operator can only follow a quantity or a component, which consist
/// of a-z and _, so that `a-b/velocity-c-d/velocity` is the difference of the velocities of joints
/// `a-b` and `c-d`.
class SignalParser {
 public:
  SignalParser(const std::string& text, const SourceLocation& where, const std::string& element)
      : text_(text), where_(where), element_(element) {}

  std::vector<SignalTerm> parse() {
    std::vector<SignalTerm> terms;
    skip_space();
    double factor = 1.0;
    if (next_is('+') || next_is('-')) factor = read_operator();
    for (;;) {
      terms.push_back(read_term(factor));
      skip_space();
      if (position_ == text_.size()) return terms;
      factor = read_operator();
    }
  }

 private:
  bool next_is(char c) const { return position_ < text_.size() && text_[position_] == c; }

  void skip_space() {
    while (position_ < text_.size() &&
           std::isspace(static_cast<unsigned char>(text_[position_])) != 0)
      ++position_;
  }

  double read_operator() {
    if (!next_is('+') && !next_is('-'))
      fail("expected + or - at column " + std::to_string(position_ + 1) + " of the signal");
    return text_[position_++] == '-' ? -1.0 : 1.0;
  }

  std::string read_word(const char* what) {
    const std::size_t first = position_;
    while (position_ < text_.size() &&
           (std::islower(static_cast<unsigned char>(text_[position_])) != 0 || next_is('_')))
      ++position_;
    if (position_ == first)
      fail(std::string("expected a ") + what + " at column " + std::to_string(first + 1) +
           " of the signal");
    return text_.substr(first, position_ - first);
  }

  // Names may contain slashes, as `left/elbow`. The name then ends at the first slash after which a
  // known quantity ends the term.
  std::size_t name_end() const {
    const std::size_t first = text_.find('/', position_);
    if (first == std::string::npos || closes(first, false) ||
        std::isspace(static_cast<unsigned char>(behind_word(first))) != 0)
      return first;
    for (std::size_t slash = text_.find('/', first + 1); slash != std::string::npos;
         slash = text_.find('/', slash + 1))
      if (closes(slash, true)) return slash;
    return first;
  }

  std::size_t word_end(std::size_t at) const {
    while (at < text_.size() &&
           (std::islower(static_cast<unsigned char>(text_[at])) != 0 || text_[at] == '_'))
      ++at;
    return at;
  }

  char behind_word(std::size_t slash) const {
    const std::size_t end = word_end(slash + 1);
    return end < text_.size() ? text_[end] : ' ';
  }

  /// Whether a quantity follows this slash, with a component of one letter or without, and then an
  /// operator or the end of the text.
  bool closes(std::size_t slash, bool known_only) const {
    std::size_t end = word_end(slash + 1);
    if (end == slash + 1 || (known_only && !is_quantity(text_.substr(slash + 1, end - slash - 1))))
      return false;
    if (end + 1 < text_.size() && text_[end] == '/' && word_end(end + 1) == end + 2) end += 2;
    end = std::min(text_.find_first_not_of(" \t\n", end), text_.size());
    return end == text_.size() || text_[end] == '+' || text_[end] == '-' || text_[end] == '@';
  }

  SignalTerm read_term(double factor) {
    const std::size_t slash = name_end();
    if (slash == std::string::npos)
      fail("a signal needs a quantity after its name, such as crank_joint/velocity");
    SignalTerm term;
    term.factor = factor;
    term.object = trimmed(text_.substr(position_, slash - position_));
    if (term.object.empty() || term.object[0] == '+' || term.object[0] == '-')
      fail("expected a name at column " + std::to_string(position_ + 1) + " of the signal");
    position_ = slash + 1;
    term.quantity = read_word("quantity");
    if (next_is('/')) {
      ++position_;
      term.component = read_word("component");
    }
    if (next_is('@')) term.axes = read_axes();
    return term;
  }

  std::string read_axes() {
    const std::size_t first = ++position_;
    position_ = axes_end(text_, first);
    if (position_ == first)
      fail("expected the name of a link at column " + std::to_string(first + 1) + " of the signal");
    return text_.substr(first, position_ - first);
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({where_, element_, message, text_, kFormOfSignal});
  }

  const std::string& text_;
  const SourceLocation& where_;
  const std::string& element_;
  std::size_t position_ = 0;
};

/// The term of a signal that signal_end() has found.
SignalTerm term_of(const std::string& signal) {
  SignalTerm term;
  std::size_t end = std::min(signal.find('@'), signal.size()), slash = signal.rfind('/', end - 1);
  if (end < signal.size()) term.axes = signal.substr(end + 1);
  if (slash + 2 == end) {  // no quantity has one letter
    term.component = signal.substr(slash + 1, 1);
    end = slash;
    slash = signal.rfind('/', end - 1);
  }
  term.quantity = signal.substr(slash + 1, end - slash - 1);
  term.object = signal.substr(0, slash);
  return term;
}

/// @throws std::invalid_argument with what is wrong.
SignalDescription parse_formula(const std::string& text, const SourceLocation& where,
                                bool is_condition) {
  SignalDescription signal{text, {}, where, nullptr};
  SignalFormula formula;
  std::vector<std::string>& names = formula.names;
  const auto find = [&names](const std::string& name) {
    const auto known = std::find(names.begin(), names.end(), name);
    if (known == names.end()) names.push_back(name);
    return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::string inside = trimmed(text);
  formula.text = inside.substr(2, inside.size() - 3);
  formula.steps =
      parse_expression(formula.text, {find, [&names] { return names; }, signal_end, is_condition})
          .steps;
  for (const std::string& name : names)
    if (name.find('/') != std::string::npos) signal.terms.push_back(term_of(name));
  signal.formula = std::make_shared<const SignalFormula>(std::move(formula));
  return signal;
}

bool is_braced(const std::string& text) {
  return text.size() > 3 && text.compare(0, 2, "${") == 0 && text.back() == '}';
}

}  // namespace

SignalDescription end_time_signal(const SourceLocation& where) {
  SignalFormula time;
  time.steps.push_back({ExpressionStep::Code::kVariable, 0, 0, 0.0});
  time.names.emplace_back(kEndTime);
  return {kEndTime, {}, where, std::make_shared<const SignalFormula>(std::move(time))};
}

SignalDescription parse_condition(const std::string& text, const SourceLocation& where,
                                  const std::string& element) {
  if (!is_braced(trimmed(text)))
    throw InputError({where, element, "no expression", text, kFormOfCondition});
  SignalDescription condition;
  try {
    condition = parse_formula(text, where, true);
  } catch (const std::invalid_argument& error) {
    throw InputError({where, element, error.what(), text, kFormOfCondition});
  }
  const std::vector<std::string>& names = condition.formula->names;
  const auto varies = [](const std::string& name) {
    return name == "t" || name.find('/') != std::string::npos;
  };
  if (std::none_of(names.begin(), names.end(), varies))
    throw InputError({where, element, "neither a signal nor the time stands in the condition", text,
                      kFormOfCondition});
  return condition;
}

SignalDescription parse_signal(const std::string& text, const SourceLocation& where,
                               const std::string& element) {
  try {
    if (is_braced(trimmed(text))) return parse_formula(text, where, false);
  } catch (const std::invalid_argument& error) {
    throw InputError({where, element, error.what(), text, kFormOfSignal});
  }
  return {text, SignalParser(text, where, element).parse(), where, nullptr};
}

bool has_band(const WatchedSignal& watched) {
  return watched.measure == WatchedSignal::Measure::kArrival ||
         watched.measure == WatchedSignal::Measure::kDwell;
}

bool is_term(const WatchedSignal& watched) {
  return watched.role == WatchedSignal::Role::kPeak || watched.role == WatchedSignal::Role::kTerm;
}

bool is_largest_of_many(const WatchedSignal& watched) {
  if (watched.role != WatchedSignal::Role::kTerm) return watched.role == WatchedSignal::Role::kPeak;
  if (watched.measure == WatchedSignal::Measure::kMinimum) return watched.weight < 0.0;
  return !has_band(watched) && watched.weight > 0.0;
}

std::string describe(const WatchedSignal& watched) {
  if (watched.linear || watched.measure == WatchedSignal::Measure::kNone)
    return watched.signal.text;
  return kMeasureNames[static_cast<std::size_t>(watched.measure) - 1] +
         (" of " + watched.signal.text);
}

bool is_equality(const WatchedSignal& watched) {
  if (watched.role != WatchedSignal::Role::kFinal || !watched.lower || !watched.upper) return false;
  return watched.lower->is_constant() && watched.upper->is_constant() &&
         watched.lower->nominal() == watched.upper->nominal();
}

void require_ordered_bounds(const WatchedSignal& watched, const std::vector<double>& parameters) {
  if (!watched.lower || !watched.upper) return;
  const double lower = watched.lower->at(parameters), upper = watched.upper->at(parameters);
  const bool equal_allowed = watched.role == WatchedSignal::Role::kFinal;
  if (lower < upper || (lower == upper && equal_allowed)) return;
  throw InputError({watched.where, watched.element,
                    "the lower bound must be less than the upper one",
                    to_decimal(lower) + ", " + to_decimal(upper),
                    equal_allowed ? "lower <= upper" : "lower < upper"});
}

}  // namespace codesign
