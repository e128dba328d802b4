// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/parameter_switches.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Code = ExpressionStep::Code;

/// What a number on the stack depends on.
struct Reads {
  std::set<int> parameters;
  bool reads_time = false, reads_signal = false;
  void join(const Reads& other) {
    parameters.insert(other.parameters.begin(), other.parameters.end());
    reads_time = reads_time || other.reads_time;
    reads_signal = reads_signal || other.reads_signal;
  }
};

bool is_comparison(const ExpressionStep& step) {
  return step.code >= Code::kLess && step.code <= Code::kNotEqual;
}

/// Functions of one number that are constant between their jumps.
bool is_staircase(const ExpressionStep& step) {
  if (step.code != Code::kCall) return false;
  const FunctionKind kind = expression_function_table()[to_index(step.index)].kind;
  return kind == FunctionKind::kFloor || kind == FunctionKind::kCeiling ||
         kind == FunctionKind::kSign;
}

int operands(const ExpressionStep& step) {
  if (step.code == Code::kCall) return step.count;
  return step.code == Code::kNegate ? 1 : 2;
}

/// Walks over the steps with both branches of each condition.
class Walk {
 public:
  Walk(const ExpressionSteps& steps, const std::string& text,
       const std::function<ExpressionVariable(int)>& variable, bool at_instant)
      : steps_(steps), text_(text), variable_(variable), at_instant_(at_instant) {}

  std::vector<ParameterSwitch> run() {
    for (std::size_t at = 0; at < steps_.size(); ++at) {
      end_branches(at);
      take(static_cast<int>(at));
    }
    return std::move(switches_);
  }

 private:
  Reads pop() {
    Reads top = std::move(stack_.back());
    stack_.pop_back();
    return top;
  }

  void end_branches(std::size_t at) {
    const auto [first, last] = first_branches_.equal_range(at);
    for (auto branch = first; branch != last; ++branch) stack_.back().join(branch->second);
  }

  void take(int at) {
    const ExpressionStep& step = steps_[to_index(at)];
    switch (step.code) {
      case Code::kConstant:
        return stack_.push_back({});
      case Code::kVariable:
        return push(variable_(step.index));
      case Code::kJumpUnless:
        return truths_.push_back(pop());
      case Code::kJump: {
        Reads branch = pop();
        branch.join(truths_.back());
        truths_.pop_back();
        first_branches_.emplace(to_index(step.index), std::move(branch));
        return;
      }
      default:
        operate(at, step);
    }
  }

  void push(const ExpressionVariable& variable) {
    Reads reads;
    if (variable.kind == VariableKind::kParameter) reads.parameters.insert(variable.parameter);
    reads.reads_time = variable.kind == VariableKind::kTime;
    reads.reads_signal = variable.kind == VariableKind::kSignal;
    stack_.push_back(std::move(reads));
  }

  void operate(int at, const ExpressionStep& step) {
    Reads result;
    for (int k = operands(step); k > 0; --k) result.join(pop());
    if (is_staircase(step) || is_comparison(step)) note(at, step, result);
    stack_.push_back(std::move(result));
  }

  void note(int at, const ExpressionStep& step, const Reads& reads) {
    if (reads.reads_signal) {
      if (at_instant_ && is_staircase(step)) switches_.push_back({text_of(steps_, at, text_), {}});
      return;
    }
    if (reads.parameters.empty() || (reads.reads_time && !at_instant_)) return;
    switches_.push_back(
        {text_of(steps_, at, text_), {reads.parameters.begin(), reads.parameters.end()}});
  }

  const ExpressionSteps& steps_;
  const std::string& text_;
  const std::function<ExpressionVariable(int)>& variable_;
  const bool at_instant_;
  std::vector<Reads> stack_, truths_;
  std::multimap<std::size_t, Reads> first_branches_;  ///< by the step behind the second one
  std::vector<ParameterSwitch> switches_;
};

/// Whether a function of one number jumps between two places: where halving an interval leaves a
/// difference.
bool has_jump(const std::function<double(double)>& function, double from, double to) {
  constexpr int kJumpIntervals = 256, kMostHalvings = 45;
  constexpr double kLeast = 1e-9;  // of the largest change over an interval
  std::vector<double> values;
  double largest = 0.0;
  for (int k = 0; k <= kJumpIntervals; ++k) {
    values.push_back(function(from + (to - from) * k / kJumpIntervals));
    if (k > 0 && std::isfinite(values[to_index(k)] - values[to_index(k - 1)]))
      largest = std::max(largest, std::abs(values[to_index(k)] - values[to_index(k - 1)]));
  }
  for (int k = 0; k < kJumpIntervals; ++k) {
    double left = from + (to - from) * k / kJumpIntervals,
           right = left + (to - from) / kJumpIntervals, at_left = values[to_index(k)],
           at_right = values[to_index(k + 1)];
    for (int halving = 0; halving < kMostHalvings; ++halving) {
      if (!(std::abs(at_right - at_left) > kLeast * largest)) break;
      const double middle = 0.5 * (left + right), at_middle = function(middle);
      if (!(left < middle && middle < right)) break;
      if (std::abs(at_middle - at_left) > std::abs(at_right - at_middle))
        right = middle, at_right = at_middle;
      else
        left = middle, at_left = at_middle;
    }
    if (std::abs(at_right - at_left) > 1e-6 * largest) return true;
  }
  return false;
}

bool jumps(const ParameterSwitch& one, const Study& study, const std::vector<double>& design,
           int parameter) {
  const Parameter& of = study.parameters[to_index(parameter)];
  const double value = design[to_index(parameter)], reach = extent(of, value);
  const double from = has_range(of) ? of.lower : std::max(of.lower, value - reach),
               to = has_range(of) ? of.upper : std::min(of.upper, value + reach);
  return std::any_of(one.values.begin(), one.values.end(), [&](const auto& function) {
    std::vector<double> moved = design;
    return has_jump(
        [&](double x) {
          moved[to_index(parameter)] = x;
          return function(moved);
        },
        from, to);
  });
}

void add_jumps(const Study& of, const Study& study, const Eigen::VectorXd& rho,
               std::vector<ParameterJump>* result) {
  const auto add = [result](int parameter, const std::string& text) {
    const bool is_known =
        std::any_of(result->begin(), result->end(), [&](const ParameterJump& jump) {
          return jump.parameter == parameter && jump.text == text;
        });
    if (!is_known) result->push_back({parameter, text});
  };
  const std::vector<double> design = parameters_at(study, rho);
  for (const ParameterSwitch& one : of.switches) {
    if (one.parameters.empty()) add(-1, one.text);
    for (const int parameter : study.tuned)
      if (std::count(one.parameters.begin(), one.parameters.end(), parameter) > 0 &&
          jumps(one, study, design, parameter))
        add(parameter, one.text);
  }
}

}  // namespace

std::vector<ParameterSwitch> find_switches(const ExpressionSteps& steps, const std::string& text,
                                           const std::function<ExpressionVariable(int)>& variable,
                                           bool at_instant) {
  return Walk(steps, text, variable, at_instant).run();
}

std::vector<ParameterJump> find_jumps(const Study& study, const Eigen::VectorXd& rho) {
  std::vector<ParameterJump> jumps;
  add_jumps(study, study, rho, &jumps);
  for (const RunDescription& run : study.ensemble.runs)
    if (run.study) add_jumps(*run.study, study, rho, &jumps);
  return jumps;
}

}  // namespace codesign
