// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/dynamics/compiled_equations.h"

#include <algorithm>
#include <cmath>

#include "dynamics/equation_code.h"
#include "mechanism_codesign/control/shaped_input.h"
#include "mechanism_codesign/math/elementary.h"

namespace codesign {
namespace {

using Arrays = EquationArrays;

template <class T>
struct LaneCount;
template <>
struct LaneCount<double> {
  static constexpr int value = 0;
};
template <int N>
struct LaneCount<Lanes<N>> {
  static constexpr int value = N;
};

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// One operation on numbers that are known.
template <class T>
T operate(Operation operation, const T& a, const T& b) {
  using std::asin, std::cos, std::exp, std::sin, std::sqrt, std::tanh;
  switch (operation) {
    case Operation::kAdd:
      return a + b;
    case Operation::kSubtract:
      return a - b;
    case Operation::kMultiply:
      return a * b;
    case Operation::kDivide:
      return a / b;
    case Operation::kNegate:
      return -a;
    case Operation::kSquareRoot:
      return sqrt(a);
    case Operation::kRound:
      return T(std::nearbyint(value_of(a)));
    case Operation::kTanh:
      return tanh(a);
    case Operation::kExp:
      return exp(a);
    case Operation::kSin:
      return sin(a);
    case Operation::kCos:
      return cos(a);
    case Operation::kArcSine:
      return asin(a);
    default:
      return arc_tangent(a, b);
  }
}

}  // namespace

template <class T>
ReferenceMotion<T> TimeFunction<T>::at(double t) const {
  return basis ? shaped_input(*basis, coefficients, t) : reference.at(t);
}

template <class T>
void CompiledEquations<T>::set_design(const std::vector<T>& parameters) {
  parameters_ = parameters;
  known_ = false;
  misses_ = {};
}

template <class T>
bool CompiledEquations<T>::is_worth_trying(EquationFunction function) {
  Misses& misses = misses_[static_cast<std::size_t>(function)];
  if (misses.pause == 0) return true;
  --misses.pause;
  return false;
}

template <class T>
bool CompiledEquations<T>::note(EquationFunction function, bool recorded) {
  constexpr int kMost = 4, kPause = 60;
  Misses& misses = misses_[static_cast<std::size_t>(function)];
  misses.in_a_row = recorded ? 0 : misses.in_a_row + 1;
  if (misses.in_a_row >= kMost) misses.pause = kPause;
  return recorded;
}

template <class T>
bool CompiledEquations<T>::prepare() {
  if (!allowed_) return false;
  if (known_) return code_ != nullptr;
  known_ = true;
  code_ = system_.equation_code();
  if (code_ && !fill_numbers()) code_ = nullptr;
  if (!code_) return false;
  functions_.clear();
  const std::vector<ControllerDescription>& controllers = system_.study().controllers;
  for (const void* origin : code_->recording().timed_origins()) {
    TimeFunction<T>& function = functions_.emplace_back();
    const auto shaped = std::find_if(controllers.begin(), controllers.end(), [&](const auto& c) { return origin == &c.basis; });
    if (shaped == controllers.end()) {
      function.reference = Reference<T>(*static_cast<const ReferenceDescription*>(origin), parameters_);
      continue;
    }
    function.basis = &shaped->basis;
    for (const Quantity& coefficient : shaped->basis.coefficients) function.coefficients.push_back(coefficient.at(parameters_));
  }
  return true;
}

template <class T>
bool CompiledEquations<T>::fill_numbers() {
  const Recording& recording = code_->recording();
  std::vector<T> values(at(recording.size()), T(0.0));
  numbers_.assign(code_->numbers().size(), T(0.0));
  for (std::size_t k = 0; k < numbers_.size(); ++k) {
    const int n = code_->numbers()[k];
    const Recording::Node& node = recording.node(n);
    T& value = values[at(n)];
    if (node.operation == Operation::kLiteral)
      value = T(node.literal);
    else if (node.operation != Operation::kLeaf)
      value = operate<T>(node.operation, values[at(node.a)], node.b < 0 ? T(0.0) : values[at(node.b)]);
    else if (node.a == Recording::kSupplied && node.b >= 0)
      value = value_at(*static_cast<const Expression*>(recording.supplied_origins()[at(node.b)]), parameters_);
    numbers_[k] = value;
  }
  const std::vector<Recording::Guard>& guards = code_->design_guards();
  return std::all_of(guards.begin(), guards.end(), [&values](const Recording::Guard& guard) {
    return (value_of(values[at(guard.a)]) < value_of(values[at(guard.b)])) == guard.outcome;
  });
}

template <class T>
void CompiledEquations<T>::set_instant(double t, const TurnReferences& turns) {
  const EquationCode::Instant& instant = code_->instant();
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    const ReferenceMotion<T> motion = functions_[k].at(t);
    const T* const orders[] = {&motion.value, &motion.rate, &motion.acceleration, &motion.jerk};
    for (std::size_t order = 0; order < Recording::kFunctionOrders; ++order)
      if (const int entry = instant.functions[k][order]; entry >= 0) numbers_[at(entry)] = *orders[order];
  }
  for (const auto& [pair, element, entry] : instant.turns) numbers_[at(entry)] = T(turns[at(pair)][at(element)]);
}

template <class T>
bool CompiledEquations<T>::run(EquationFunction function, const T* const (&state)[4], T* const (&results)[4]) {
  const CompiledFunction* const code = code_->function(function, {LaneCount<T>::value, false});
  if (!code) return false;
  if (slots_.size() < code->slots) slots_.resize(code->slots);
  if (rows_.size() < code->rows) rows_.resize(code->rows);
  ValueCode::Arrays arrays{};
  const auto set = [&arrays](int array, const T* first) { arrays[at(array)] = reinterpret_cast<const double*>(first); };
  for (int k = 0; k < 4; ++k) set(k, state[k]), set(Arrays::kResults + k, results[k]);
  set(Arrays::kNumbers, numbers_.data());
  arrays[at(Arrays::kSlots)] = slots_.data();
  arrays[at(Arrays::kRows)] = rows_.data();
  if (!note(function, code->values->run(arrays))) return false;
  if (code->tangents) code->tangents->run(arrays);
  return true;
}

template <class T>
bool CompiledEquations<T>::tangents(EquationFunction function, double t, const TurnReferences& turns, const double* const (&values)[4],
                                    const double* const (&directions)[4], double* const (&results)[4]) {
  if (LaneCount<T>::value == 0 || !is_worth_trying(function) || !prepare()) return false;
  const CompiledFunction* const code = code_->function(function, {LaneCount<T>::value, true});
  if (!code) return false;
  set_instant(t, turns);
  if (slots_.size() < code->slots) slots_.resize(code->slots);
  if (rows_.size() < code->rows) rows_.resize(code->rows);
  ValueCode::Arrays arrays{};
  std::copy(std::begin(values), std::end(values), arrays.begin());
  arrays[at(Arrays::kNumbers)] = reinterpret_cast<const double*>(numbers_.data());
  arrays[at(Arrays::kSlots)] = slots_.data();
  if (!note(function, code->values->run(arrays))) return false;
  std::copy(std::begin(directions), std::end(directions), arrays.begin());
  std::copy(std::begin(results), std::end(results), arrays.begin() + Arrays::kResults);
  arrays[at(Arrays::kRows)] = rows_.data();
  code->tangents->run(arrays);
  return true;
}

template <class T>
bool CompiledEquations<T>::residual(const State<T>& state, const TurnReferences& turns, VectorX<T>* G, T* g) {
  if (!is_worth_trying(EquationFunction::kResidual) || !prepare()) return false;
  set_instant(state.t, turns);
  G->resize(system_.layout().columns());
  return run(EquationFunction::kResidual, {state.q.data(), state.v.data(), state.s.data(), state.z.data()},
             {G->data(), g, nullptr, nullptr});
}

template <class T>
bool CompiledEquations<T>::linearize(const State<T>& state, const TurnReferences& turns, Linearization<T>* derivatives) {
  if (!is_worth_trying(EquationFunction::kLinearization) || !prepare()) return false;
  set_instant(state.t, turns);
  return run(EquationFunction::kLinearization, {state.q.data(), state.v.data(), state.s.data(), state.z.data()},
             {derivatives->position.data(), derivatives->velocity.data(), derivatives->rate.data(), derivatives->time.data()});
}

template <class T>
bool CompiledEquations<T>::constraint_errors(const VectorX<T>& q, const VectorX<T>& v, const TurnReferences& turns, VectorX<T>* Phi,
                                             VectorX<T>* Phi_rate) {
  if (!is_worth_trying(EquationFunction::kConstraintErrors) || !prepare()) return false;
  set_instant(0.0, turns);
  Phi->resize(system_.layout().m);
  Phi_rate->resize(system_.layout().m);
  return run(EquationFunction::kConstraintErrors, {q.data(), v.data(), nullptr, nullptr},
             {Phi->data(), Phi_rate->data(), nullptr, nullptr});
}

template struct TimeFunction<double>;
template struct TimeFunction<Lanes<4>>;
template struct TimeFunction<Lanes<8>>;
template class CompiledEquations<double>;
template class CompiledEquations<Lanes<4>>;
template class CompiledEquations<Lanes<8>>;

}  // namespace codesign
