// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/design_products.h"

#include <algorithm>

#include "description/dependencies.h"
#include "math/to_index.h"

namespace codesign {

DesignProducts::DesignProducts(const System& system, const TransposedCode& code)
    : system_(system),
      code_(code),
      tuned_of_(system.study().parameters.size(), -1),
      sums_(code.sums()),
      timed_(system.study().tuned.size()),
      by_expression_(code.expressions().size()),
      slots_(code.design().slots) {
  const std::vector<int>& tuned = system.study().tuned;
  for (std::size_t k = 0; k < tuned.size(); ++k) tuned_of_[to_index(tuned[k])] = static_cast<int>(k);
  const std::vector<SourceId>& sources = code.numbered().recording.timed_sources();
  orders_.resize(sources.size());
  for (std::size_t f = 0; f < sources.size(); ++f) {
    const auto* basis = sources[f].as<BasisDescription>();
    std::vector<int> found;
    for (int parameter : basis ? dependencies(*basis) : dependencies(*sources[f].as<ReferenceDescription>()))
      if (tuned_of_[to_index(parameter)] >= 0) found.push_back(tuned_of_[to_index(parameter)]);
    for (std::size_t first = 0; first < found.size(); first += 8) {
      Lane& lane = lanes_.emplace_back();
      lane.function = static_cast<int>(f);
      lane.tuned.assign(found.begin() + static_cast<std::ptrdiff_t>(first),
                        found.begin() + static_cast<std::ptrdiff_t>(std::min(first + 8, found.size())));
      if (basis) lane.motion.emplace<ShapedInput<Lanes<8>>>();
    }
  }
}

void DesignProducts::start(const std::vector<double>& parameters) {
  parameters_ = parameters;
  std::fill(sums_.begin(), sums_.end(), 0.0);
  std::fill(timed_.begin(), timed_.end(), 0.0);
  for (Lane& lane : lanes_) {
    seeded_.assign(parameters.begin(), parameters.end());
    for (std::size_t k = 0; k < lane.tuned.size(); ++k)
      seeded_[to_index(system_.study().tuned[to_index(lane.tuned[k])])].v[static_cast<int>(k)] = 1.0;
    const SourceId& source = code_.numbered().recording.timed_sources()[to_index(lane.function)];
    if (auto* shaped = std::get_if<ShapedInput<Lanes<8>>>(&lane.motion))
      shaped->set(*source.as<BasisDescription>(), seeded_);
    else
      std::get<Reference<Lanes<8>>>(lane.motion).set(*source.as<ReferenceDescription>(), seeded_);
  }
}

void DesignProducts::add(EquationFunction function, double t, In<double> results, Out<double> adjoint) {
  const TransposedCode::Results& of = code_.results(function);
  std::ptrdiff_t k = 0;
  for (int column : of.columns) adjoint[column] += results[k++];
  if (!of.timed.empty()) add_timed(of, t, results.subspan(k, static_cast<std::ptrdiff_t>(of.timed.size())));
  k += static_cast<std::ptrdiff_t>(of.timed.size());
  for (int number : of.numbers) sums_[to_index(number)] += results[k++];
}

void DesignProducts::add_timed(const TransposedCode::Results& of, double t, In<double> results) {
  for (auto& orders : orders_) orders.fill(0.0);
  for (std::size_t k = 0; k < of.timed.size(); ++k) {
    const int entry = of.timed[k];
    orders_[to_index(entry / Recording::kFunctionOrders)][to_index(entry % Recording::kFunctionOrders)] =
        results[static_cast<std::ptrdiff_t>(k)];
  }
  for (const Lane& lane : lanes_) {
    const auto& [value, rate, acceleration, jerk] = orders_[to_index(lane.function)];
    if (value == 0.0 && rate == 0.0 && acceleration == 0.0 && jerk == 0.0) continue;
    const ReferenceMotion<Lanes<8>> motion = std::visit([t](const auto& function) { return function.at(t); }, lane.motion);
    const auto sum = value * motion.value.v + rate * motion.rate.v + acceleration * motion.acceleration.v + jerk * motion.jerk.v;
    for (std::size_t k = 0; k < lane.tuned.size(); ++k) timed_[to_index(lane.tuned[k])] += sum[static_cast<int>(k)];
  }
}

void DesignProducts::add_to(const std::vector<double>& numbers, Out<double> gradient) {
  ValueCode::Arrays arrays{};
  arrays[EquationArrays::kNumbers] = numbers.data();
  arrays[EquationArrays::kResults] = sums_.data();
  arrays[EquationArrays::kSlots] = slots_.data();
  arrays[EquationArrays::kAdjoints] = by_expression_.data();
  code_.design().values->run(arrays);
  for (std::size_t e = 0; e < by_expression_.size(); ++e) {
    const auto& source = code_.numbered().recording.supplied_sources()[to_index(code_.expressions()[e])];
    const Expression& expression = *source.as<Expression>();
    const UsedNumbers<double> values = expression.used<double>(parameters_, [](double x) { return x; });
    for (std::size_t k = 0; k < values.size(); ++k)
      if (const int tuned = tuned_of_[to_index(expression.dependencies()[k])]; tuned >= 0)
        gradient[tuned] += by_expression_[e] * expression.derivative_of(k, values);
  }
  for (std::size_t k = 0; k < timed_.size(); ++k) gradient[static_cast<std::ptrdiff_t>(k)] += timed_[k];
}

}  // namespace codesign
