// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/compiled_equations.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <memory>
#include <utility>

#include "equations/compressed_jacobian.h"
#include "equations/transposed_code.h"
#include "equations/variant_inputs.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Arrays = EquationArrays;

template <class T>
constexpr bool kIsComplex = std::is_same_v<T, std::complex<double>>;

/// The entries of the code's arrays: a Lanes<N> is 1 + N doubles in a row, value first.
template <class T>
using CodeNumber = std::conditional_t<kIsComplex<T>, T, double>;
template <class T>
using CodeArrays = std::array<const CodeNumber<T>*, kCodeArrays>;

/// The arrays that the equations own; the caller sets the arrays of the state and of results.
template <class T>
CodeArrays<T> inner_arrays(const std::vector<T>& numbers, const LineVector& slots,
                           const LineVector& rows) {
  CodeArrays<T> arrays{};
  arrays[Arrays::kNumbers] = reinterpret_cast<const CodeNumber<T>*>(numbers.data());
  arrays[Arrays::kSlots] = reinterpret_cast<const CodeNumber<T>*>(slots.data());
  arrays[Arrays::kRows] = reinterpret_cast<const CodeNumber<T>*>(rows.data());
  return arrays;
}

int run_values(const CompiledFunction& code, const CodeArrays<double>& arrays) {
  if (code.interpreter) return code.interpreter->execute<double>(arrays);
  return code.values->run(arrays) ? -1 : 0;
}

int run_values(const CompiledFunction& code, const CodeArrays<std::complex<double>>& arrays) {
  return code.interpreter->execute<std::complex<double>>(arrays);
}

}  // namespace

template <class T>
CompiledEquations<T>::CompiledEquations(const CompiledSystem& system, EquationPart part)
    : system_(system), part_(part) {}

template <class T>
CompiledEquations<T>::CompiledEquations(CompiledEquations&&) noexcept = default;
template <class T>
CompiledEquations<T>::~CompiledEquations() = default;

template <class T>
template <class Visit>
void CompiledEquations<T>::for_each_other(const Visit& visit) const {
  for (const auto& other : others_)
    if (other) visit(other.get());
  if constexpr (std::is_same_v<T, double>)
    if (compressed_) visit(compressed_.get());
}

template <class T>
void CompiledEquations<T>::set_design(const std::vector<T>& parameters) {
  parameters_ = parameters;
  for (VariantInputs<T>& variant : variants_) variant.forget_design();
  multiplied_.clear();
  current_ = 0;
  for_each_other([&](auto* other) { other->set_design(parameters); });
}

template <class T>
void CompiledEquations<T>::allow(bool machine_code) {
  interpreted_ = !machine_code;
  for_each_other([&](auto* other) { other->allow(machine_code); });
}

template <class T>
void CompiledEquations<T>::use_first_variant() {
  current_ = 0;
  for_each_other([](auto* other) { other->use_first_variant(); });
}

template <class T>
void CompiledEquations<T>::hold(const std::vector<bool>& mode) {
  held_ = true;
  mode_ = mode;
  if (variants_.empty()) adopt();
  for (std::size_t k = 0; k < variants_.size() && !serves(current_); ++k) current_ = k;
  for_each_other([&](auto* other) { other->hold(mode); });
}

template <class T>
void CompiledEquations<T>::release() {
  held_ = false;
  for_each_other([](auto* other) { other->release(); });
}

template <class T>
void CompiledEquations<T>::expressions(const State<T>& state, VectorX<T>* values) {
  if constexpr (std::is_same_v<T, double>) {
    const In<double> parts[] = {state.q, state.v, state.s, state.z};
    evaluate({EquationFunction::kExpressions, Mode::kValues, state.t, state.turns},
             [&](const CompiledFunction& code, CodeArrays<T> arrays, VariantInputs<T>* variant) {
               values->resize(to_signed(variant->code().expressions()));
               std::transform(std::begin(parts), std::end(parts), arrays.begin(),
                              [](In<double> part) { return part.data(); });
               arrays[Arrays::kResults] = values->data();
               return run_values(code, arrays);
             });
  }
}

template <class T>
EquationPart CompiledEquations<T>::part_of(EquationFunction function) const {
  if (part_ != EquationPart::kMotion) return part_;
  const bool is_rates =
      function == EquationFunction::kRates || function == EquationFunction::kAccelerations;
  if (is_rates && system_.compresses_jacobian()) return EquationPart::kRates;
  return function == EquationFunction::kLinearization && system_.has_rates_apart()
             ? EquationPart::kLinearized
             : part_;
}

template <class T>
template <class Other>
std::unique_ptr<Other> CompiledEquations<T>::prepared(std::unique_ptr<Other> other) const {
  other->allow(!interpreted_);
  if (held_) other->hold(mode_);
  other->set_design(parameters_);
  return other;
}

template <class T>
CompiledEquations<T>& CompiledEquations<T>::holder(EquationFunction function) {
  const EquationPart part = part_of(function);
  if (part == part_) return *this;
  std::unique_ptr<CompiledEquations>& other = others_[to_index(part)];
  if (!other) other = prepared(std::make_unique<CompiledEquations>(system_, part));
  return *other;
}

template <class T>
CompressedJacobian& CompiledEquations<T>::compressed() {
  if constexpr (std::is_same_v<T, double>)
    if (!compressed_) compressed_ = prepared(std::make_unique<CompressedJacobian>(system_));
  return *compressed_;
}

template <class T>
bool CompiledEquations<T>::adopt() {
  const EquationVariant* const code = system_.equation_variant(variants_.size(), part_);
  if (code) variants_.emplace_back(code);
  return code != nullptr;
}

template <class T>
template <class Run>
int CompiledEquations<T>::attempt(const Instant& instant, bool interpreted, const Run& run,
                                  VariantInputs<T>* variant) {
  const bool transposed = instant.mode == Mode::kTransposed;
  transposed ? variant->take_products(system_, parameters_) : variant->take_design(parameters_);
  if (variant->failed() >= 0) return variant->failed();
  const CompiledFunction& code =
      transposed
          ? variant->code().transposed().function(instant.function, interpreted, holds())
          : variant->code().function(instant.function, {kLanesOf<T>, instant.mode == Mode::kSplit,
                                                        interpreted || kIsComplex<T>, holds()});
  const std::size_t slots = code.slots * sizeof(CodeNumber<T>) / sizeof(double);
  if (slots_.size() < slots) slots_.resize(slots);
  if (rows_.size() < code.rows) rows_.resize(code.rows);
  variant->set_instant(instant.t, instant.turns);
  if (!time_direction_.empty()) variant->add_time_direction(instant.t, time_direction_);
  return run(code, inner_arrays<T>(variant->numbers(), slots_, rows_), variant);
}

template <class T>
template <class Run>
void CompiledEquations<T>::evaluate(const Instant& instant, const Run& run) {
  if (variants_.empty()) adopt();
  // What a run needs a few times takes less time than making code for it.
  const bool interpreted =
      interpreted_ || part_ == EquationPart::kStart ||
      (part_ == EquationPart::kSignals && instant.function == EquationFunction::kTerminal);
  const bool serves_now = serves(current_);
  if (serves_now && attempt(instant, interpreted, run, &variants_[current_]) < 0) return;
  for (std::size_t k = 0; k < variants_.size() || adopt(); ++k) {
    if ((k == current_ && serves_now) || !serves(k) ||
        attempt(instant, interpreted, run, &variants_[k]) >= 0)
      continue;
    current_ = k;
    return;
  }
  add_variant(instant, run);
}

// Each round keeps the outcomes up to the first one that the point decides otherwise. Only the loop
// over operations tells which one it is.
template <class T>
template <class Run>
void CompiledEquations<T>::add_variant(const Instant& instant, const Run& run) {
  std::vector<bool> outcomes;
  for (;;) {
    std::unique_ptr<EquationVariant> code =
        system_.record_variant(outcomes, part_, holds() ? mode_ : std::vector<bool>());
    VariantInputs<T> variant(code.get());
    const int failed = attempt(instant, true, run, &variant);
    // A decision within rounding that fails again stays as it is: both branches give the same
    // there.
    if (failed < static_cast<int>(outcomes.size())) {
      current_ = system_.keep_variant(std::move(code), part_);
      while (variants_.size() <= current_) adopt();
      return;
    }
    outcomes = code->outcomes();
    outcomes.resize(to_index(failed) + 1);
    outcomes.back() = !outcomes.back();
  }
}

template <class T>
void CompiledEquations<T>::run(EquationFunction function, double t,
                               const std::vector<double>& turns, const In<T> (&state)[4],
                               const Out<T> (&results)[4]) {
  const auto numbers = [](In<T> array) {
    return reinterpret_cast<const CodeNumber<T>*>(array.data());
  };
  evaluate({function, Mode::kValues, t, turns},
           [&](const CompiledFunction& code, CodeArrays<T> arrays, VariantInputs<T>*) {
             std::transform(std::begin(state), std::end(state), arrays.begin(), numbers);
             std::transform(std::begin(results), std::end(results),
                            arrays.begin() + Arrays::kResults, numbers);
             const int failed = run_values(code, arrays);
             if constexpr (kLanesOf < T >> 0)
               if (failed < 0) code.tangents->run(arrays);
             return failed;
           });
}

template <class T>
void CompiledEquations<T>::tangents(EquationFunction function, double t,
                                    const std::vector<double>& turns, const In<double> (&values)[4],
                                    const In<double> (&directions)[4],
                                    const Out<double> (&results)[4]) {
  assert(std::equal(
      std::begin(values), std::end(values), std::begin(directions),
      [](In<double> x, In<double> along) { return along.size() == kLanesOf<T> * x.size(); }));
  if constexpr (kLanesOf < T >> 0) {
    const auto first = [](In<double> array) { return array.data(); };
    holder(function).evaluate(
        {function, Mode::kSplit, t, turns},
        [&](const CompiledFunction& code, CodeArrays<T> arrays, VariantInputs<T>*) {
          std::transform(std::begin(values), std::end(values), arrays.begin(), first);
          if (const int failed = run_values(code, arrays); failed >= 0) return failed;
          std::transform(std::begin(directions), std::end(directions), arrays.begin(), first);
          std::transform(std::begin(results), std::end(results), arrays.begin() + Arrays::kResults,
                         first);
          code.tangents->run(arrays);
          return -1;
        });
  }
}

template <class T>
bool CompiledEquations<T>::residual_tangents(const State<double>& state,
                                             const std::vector<Pass>& passes,
                                             const Pass* along_time) {
  bool depends_on_time = false;
  if constexpr (kLanesOf < T >> 0) {
    const In<double> parts[] = {state.q, state.v, state.s, state.z};
    const auto first = [](In<double> array) { return array.data(); };
    const EquationFunction function = EquationFunction::kResidual;
    evaluate({function, Mode::kSplit, state.t, state.turns},
             [&](const CompiledFunction& code, CodeArrays<T> arrays, VariantInputs<T>* variant) {
               std::transform(std::begin(parts), std::end(parts), arrays.begin(), first);
               if (const int failed = run_values(code, arrays); failed >= 0) return failed;
               const auto run_pass = [&](const Pass& pass) {
                 std::transform(std::begin(pass.directions), std::end(pass.directions),
                                arrays.begin(), first);
                 std::transform(std::begin(pass.results), std::end(pass.results),
                                arrays.begin() + Arrays::kResults, first);
                 code.tangents->run(arrays);
               };
               for (const Pass& pass : passes) run_pass(pass);
               depends_on_time = variant->depends_on_time();
               if (along_time && depends_on_time) {
                 variant->seed_time(state.t);
                 run_pass(*along_time);
               }
               return -1;
             });
  }
  return depends_on_time;
}

template <class T>
void CompiledEquations<T>::add_transposed(EquationFunction function, const State<T>& state,
                                          const In<double> (&weights)[4], Out<double> adjoint) {
  if constexpr (std::is_same_v<T, double>) {
    if (CompiledEquations& other = holder(function); &other != this) {
      other.add_transposed(function, state, weights, adjoint);
      return;
    }
    const In<double> parts[] = {state.q, state.v, state.s, state.z};
    const auto first = [](In<double> array) { return array.data(); };
    evaluate({function, Mode::kTransposed, state.t, state.turns},
             [&](const CompiledFunction& code, CodeArrays<T> arrays, VariantInputs<T>*) {
               std::transform(std::begin(parts), std::end(parts), arrays.begin(), first);
               std::transform(std::begin(weights), std::end(weights),
                              arrays.begin() + Arrays::kResults, first);
               return run_values(code, arrays);
             });
    VariantInputs<T>& variant = variants_[current_];
    variant.take_products(system_, parameters_);
    if (std::find(multiplied_.begin(), multiplied_.end(), current_) == multiplied_.end())
      multiplied_.push_back(current_);
    variant.products().add(function, state.t, {rows_.data(), to_signed(rows_.size())}, adjoint);
  }
}

template <class T>
void CompiledEquations<T>::add_gradient(Out<double> gradient) {
  if constexpr (std::is_same_v<T, double>)
    for (std::size_t k : multiplied_)
      variants_[k].products().add_to(variants_[k].numbers(), gradient);
  for (const auto& other : others_)
    if (other) other->add_gradient(gradient);
}

template <class T>
void CompiledEquations<T>::residual(const State<T>& state, VectorX<T>* G, T* g) {
  G->resize(system_.layout().columns());
  run(EquationFunction::kResidual, state, {*G, {g, 1}, {}, {}});
}

template <class T>
void CompiledEquations<T>::linearize(const State<T>& state, Linearization<T>* derivatives) {
  if constexpr (std::is_same_v<T, double>)
    if (system_.compresses_jacobian()) return compressed().linearize(state, derivatives);
  holder(EquationFunction::kLinearization)
      .run(EquationFunction::kLinearization, state,
           {derivatives->position, derivatives->velocity, derivatives->rate, derivatives->time});
}

template <class T>
void CompiledEquations<T>::rates(const State<T>& state, VectorX<T>* G, T* g,
                                 Linearization<T>* derivatives) {
  if constexpr (std::is_same_v<T, double>)
    if (system_.compresses_jacobian()) {
      residual(state, G, g);
      return compressed().rates(state, derivatives);
    }
  G->resize(system_.layout().columns());
  holder(EquationFunction::kRates)
      .run(EquationFunction::kRates, state, {*G, {g, 1}, derivatives->rate, {}});
}

template <class T>
bool CompiledEquations<T>::accelerations(State<T>* state, T* g, std::vector<T>* factors) {
  const MassFactor* const factor = mass_factor();
  if (!factor) return false;
  factors->resize(factor->size());
  holder(EquationFunction::kAccelerations)
      .run(EquationFunction::kAccelerations, *state, {state->z, {g, 1}, *factors, {}});
  return mass_factor() != nullptr;
}

template <class T>
const MassFactor* CompiledEquations<T>::mass_factor() {
  CompiledEquations& at = holder(EquationFunction::kAccelerations);
  if (at.variants_.empty()) at.adopt();
  const EquationVariant& code = at.variants_[at.current_].code();
  return code.has_accelerations() ? &code.mass_factor() : nullptr;
}

template class CompiledEquations<double>;
template class CompiledEquations<std::complex<double>>;
template class CompiledEquations<Lanes<4>>;
template class CompiledEquations<Lanes<8>>;

}  // namespace codesign
