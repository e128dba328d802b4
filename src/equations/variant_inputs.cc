// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/variant_inputs.h"

#include <complex>
#include <iterator>

#include "codegen/interpreter.h"
#include "equations/transposed_code.h"
#include "math/arrays.h"

namespace codesign {

template <class T>
void VariantInputs<T>::take_design(const std::vector<T>& parameters) {
  if (ready_) return;
  fill_numbers(parameters);
  set_functions(parameters);
  if constexpr (std::is_same_v<T, double>)
    if (products_) products_->start(parameters);
  ready_ = true;
}

template <class T>
void VariantInputs<T>::take_products(const CompiledSystem& system,
                                     const std::vector<T>& parameters) {
  if (!products_) {
    const TransposedCode& transposed = code_->transposed();
    products_ = std::make_unique<DesignProducts>(system, transposed);
    numbered_ = &transposed.numbered();
    ready_ = false;
  }
  take_design(parameters);
}

template <class T>
void VariantInputs<T>::set_functions(const std::vector<T>& parameters) {
  const auto& sources = numbered_->recording.timed_sources();
  functions_.resize(sources.size());
  const auto set = [&](auto* function, std::size_t k, const auto& description) {
    using Function = std::remove_pointer_t<decltype(function)>;
    if (!function) function = &functions_[k].template emplace<Function>();
    function->set(description, parameters);
  };
  for (std::size_t k = 0; k < sources.size(); ++k) {
    if (const auto* basis = sources[k].template as<BasisDescription>())
      set(std::get_if<ShapedInput<T>>(&functions_[k]), k, *basis);
    else
      set(std::get_if<Reference<T>>(&functions_[k]), k,
          *sources[k].template as<ReferenceDescription>());
  }
}

template <class T>
void VariantInputs<T>::fill_numbers(const std::vector<T>& parameters) {
  const Recording& recording = numbered_->recording;
  nodes_.assign(to_index(recording.size()), T(0.0));
  numbers_.assign(numbered_->numbers.size(), T(0.0));
  for (std::size_t k = 0; k < numbers_.size(); ++k) {
    const int n = numbered_->numbers[k];
    const Recording::Node& node = recording.node(n);
    T& value = nodes_[to_index(n)];
    if (node.operation == Operation::kLiteral)
      value = T(node.literal);
    else if (node.operation != Operation::kLeaf)
      value = operate<T>(node.operation, nodes_[to_index(node.a)],
                         node.b < 0 ? T(0.0) : nodes_[to_index(node.b)]);
    else if (node.a == Recording::kSupplied && node.b >= 0)
      value =
          value_at(*recording.supplied_sources()[to_index(node.b)].as<Expression>(), parameters);
    numbers_[k] = value;
  }
  failed_ = -1;
  for (const Recording::Guard& guard : code_->design_guards()) {
    const bool outcome = value_of(nodes_[to_index(guard.a)]) < value_of(nodes_[to_index(guard.b)]);
    if (outcome != guard.outcome && (failed_ < 0 || guard.decision < failed_))
      failed_ = guard.decision;
  }
}

template <class T>
void VariantInputs<T>::set_instant(double t, const std::vector<double>& turns) {
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    const ReferenceMotion<T> motion =
        std::visit([t](const auto& function) { return function.at(t); }, functions_[k]);
    const T* const orders[] = {&motion.value, &motion.rate, &motion.acceleration, &motion.jerk};
    for (std::size_t order = 0; order < Recording::kFunctionOrders; ++order)
      if (const int entry = numbered_->functions[k][order]; entry >= 0)
        numbers_[to_index(entry)] = *orders[order];
  }
  for (const auto& [slot, entry] : numbered_->turns)
    numbers_[to_index(entry)] = T(turns[to_index(slot)]);
}

template <class T>
void VariantInputs<T>::seed_time(double t) {
  if constexpr (kLanesOf < T >> 0)
    for (std::size_t k = 0; k < functions_.size(); ++k) {
      const ReferenceMotion<T> motion =
          std::visit([t](const auto& function) { return function.at(t); }, functions_[k]);
      const T* const next[] = {&motion.rate, &motion.acceleration, &motion.jerk};
      for (std::size_t order = 0; order < std::size(next); ++order)
        if (const int entry = numbered_->functions[k][order]; entry >= 0)
          numbers_[to_index(entry)].directions()[0] = value_of(*next[order]);
    }
}

template <class T>
void VariantInputs<T>::add_time_direction(double t, const std::vector<double>& direction) {
  if constexpr (kLanesOf < T >> 0)
    for (std::size_t k = 0; k < functions_.size(); ++k) {
      const ReferenceMotion<T> motion =
          std::visit([t](const auto& function) { return function.at(t); }, functions_[k]);
      const T* const next[] = {&motion.rate, &motion.acceleration, &motion.jerk};
      for (std::size_t order = 0; order < std::size(next); ++order)
        if (const int entry = numbered_->functions[k][order]; entry >= 0)
          for (std::size_t lane = 0; lane < direction.size(); ++lane)
            numbers_[to_index(entry)].directions()[to_signed(lane)] +=
                value_of(*next[order]) * direction[lane];
    }
}

template class VariantInputs<double>;
template class VariantInputs<std::complex<double>>;
template class VariantInputs<Lanes<4>>;
template class VariantInputs<Lanes<8>>;

}  // namespace codesign
