// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/compiled_equations.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "codegen/operate.h"
#include "equations/equation_code.h"
#include "math/to_index.h"

namespace codesign {
namespace {

using Arrays = EquationArrays;

template <class T>
constexpr int kLanesOf = 0;
template <int N>
constexpr int kLanesOf<Lanes<N>> = N;

/// The arrays that the equations own; the caller sets the arrays of the state and of results.
template <class T>
ValueCode::Arrays inner_arrays(const std::vector<T>& numbers, const LineVector& slots, const LineVector& rows) {
  ValueCode::Arrays arrays{};
  arrays[Arrays::kNumbers] = reinterpret_cast<const double*>(numbers.data());
  arrays[Arrays::kSlots] = slots.data();
  arrays[Arrays::kRows] = rows.data();
  return arrays;
}

}  // namespace

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
  if (code_) numbered_ = &code_->numbered(kLanesOf<T> > 0);
  if (code_ && !fill_numbers()) code_ = nullptr;
  if (!code_) return false;
  set_functions();
  return true;
}

template <class T>
void CompiledEquations<T>::set_functions() {
  const auto& sources = numbered_->recording.timed_sources();
  functions_.resize(sources.size());
  const auto set = [this](auto* function, std::size_t k, const auto& description) {
    using Function = std::remove_pointer_t<decltype(function)>;
    if (!function) function = &functions_[k].template emplace<Function>();
    function->set(description, parameters_);
  };
  for (std::size_t k = 0; k < sources.size(); ++k) {
    if (const auto* basis = sources[k].template as<BasisDescription>())
      set(std::get_if<ShapedInput<T>>(&functions_[k]), k, *basis);
    else
      set(std::get_if<Reference<T>>(&functions_[k]), k, *sources[k].template as<ReferenceDescription>());
  }
}

template <class T>
bool CompiledEquations<T>::fill_numbers() {
  const Recording& recording = numbered_->recording;
  std::vector<T>& values = nodes_;
  values.assign(to_index(recording.size()), T(0.0));
  numbers_.assign(numbered_->numbers.size(), T(0.0));
  for (std::size_t k = 0; k < numbers_.size(); ++k) {
    const int n = numbered_->numbers[k];
    const Recording::Node& node = recording.node(n);
    T& value = values[to_index(n)];
    if (node.operation == Operation::kLiteral)
      value = T(node.literal);
    else if (node.operation != Operation::kLeaf)
      value = operate<T>(node.operation, values[to_index(node.a)], node.b < 0 ? T(0.0) : values[to_index(node.b)]);
    else if (node.a == Recording::kSupplied && node.b >= 0)
      value = value_at(*recording.supplied_sources()[to_index(node.b)].as<Expression>(), parameters_);
    numbers_[k] = value;
  }
  const std::vector<Recording::Guard>& guards = code_->design_guards();
  return std::all_of(guards.begin(), guards.end(), [&values](const Recording::Guard& guard) {
    return (value_of(values[to_index(guard.a)]) < value_of(values[to_index(guard.b)])) == guard.outcome;
  });
}

template <class T>
void CompiledEquations<T>::set_instant(double t, const std::vector<double>& turns) {
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    const ReferenceMotion<T> motion = std::visit([t](const auto& function) { return function.at(t); }, functions_[k]);
    const T* const orders[] = {&motion.value, &motion.rate, &motion.acceleration, &motion.jerk};
    for (std::size_t order = 0; order < Recording::kFunctionOrders; ++order)
      if (const int entry = numbered_->functions[k][order]; entry >= 0) numbers_[to_index(entry)] = *orders[order];
  }
  for (const auto& [slot, entry] : numbered_->turns) numbers_[to_index(entry)] = T(turns[to_index(slot)]);
}

template <class T>
const CompiledFunction* CompiledEquations<T>::begin(EquationFunction function, bool split, double t, const std::vector<double>& turns) {
  if (!is_worth_trying(function) || !prepare()) return nullptr;
  const CompiledFunction* const code = code_->function(function, {kLanesOf<T>, split});
  if (!code) return nullptr;
  if (slots_.size() < code->slots) slots_.resize(code->slots);
  if (rows_.size() < code->rows) rows_.resize(code->rows);
  set_instant(t, turns);
  return code;
}

// A Lanes<N> is 1 + N doubles in a row, value first; the code reads arrays of them as arrays of doubles.
template <class T>
bool CompiledEquations<T>::run(EquationFunction function, double t, const std::vector<double>& turns, const In<T> (&state)[4],
                               const Out<T> (&results)[4]) {
  const CompiledFunction* const code = begin(function, false, t, turns);
  if (!code) return false;
  const auto numbers = [](In<T> array) { return reinterpret_cast<const double*>(array.data()); };
  ValueCode::Arrays arrays = inner_arrays(numbers_, slots_, rows_);
  std::transform(std::begin(state), std::end(state), arrays.begin(), numbers);
  std::transform(std::begin(results), std::end(results), arrays.begin() + Arrays::kResults, numbers);
  if (!note(function, code->values->run(arrays))) return false;
  if (code->tangents) code->tangents->run(arrays);
  return true;
}

template <class T>
bool CompiledEquations<T>::tangents(EquationFunction function, double t, const std::vector<double>& turns, const In<double> (&values)[4],
                                    const In<double> (&directions)[4], const Out<double> (&results)[4]) {
  const CompiledFunction* const code = kLanesOf<T> == 0 ? nullptr : begin(function, true, t, turns);
  if (!code) return false;
  assert(std::equal(std::begin(values), std::end(values), std::begin(directions),
                    [](In<double> x, In<double> along) { return along.size() == kLanesOf<T> * x.size(); }));
  const auto first = [](In<double> array) { return array.data(); };
  ValueCode::Arrays arrays = inner_arrays(numbers_, slots_, rows_);
  std::transform(std::begin(values), std::end(values), arrays.begin(), first);
  if (!note(function, code->values->run(arrays))) return false;
  std::transform(std::begin(directions), std::end(directions), arrays.begin(), first);
  std::transform(std::begin(results), std::end(results), arrays.begin() + Arrays::kResults, first);
  code->tangents->run(arrays);
  return true;
}

template <class T>
bool CompiledEquations<T>::residual(const State<T>& state, VectorX<T>* G, T* g) {
  G->resize(system_.layout().columns());
  return run(EquationFunction::kResidual, state.t, state.turns, {state.q, state.v, state.s, state.z}, {*G, {g, 1}, {}, {}});
}

template <class T>
bool CompiledEquations<T>::linearize(const State<T>& state, Linearization<T>* derivatives) {
  return run(EquationFunction::kLinearization, state.t, state.turns, {state.q, state.v, state.s, state.z},
             {derivatives->position, derivatives->velocity, derivatives->rate, derivatives->time});
}

template <class T>
bool CompiledEquations<T>::constraint_errors(const State<T>& state, VectorX<T>* Phi, VectorX<T>* Phi_rate) {
  Phi->resize(system_.layout().m);
  Phi_rate->resize(system_.layout().m);
  return run(EquationFunction::kConstraintErrors, 0.0, state.turns, {state.q, state.v, {}, {}}, {*Phi, *Phi_rate, {}, {}});
}

template class CompiledEquations<double>;
template class CompiledEquations<Lanes<4>>;
template class CompiledEquations<Lanes<8>>;

}  // namespace codesign
