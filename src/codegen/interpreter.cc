// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/interpreter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <map>
#include <utility>

#include "math/arrays.h"

namespace codesign {
namespace {

using Kind = ValueProgram::Kind;

constexpr Operation kCopied = Operation::kLiteral;  // its result is its operand

bool is_guard(Kind kind) { return kind == Kind::kGuardLess || kind == Kind::kGuardGreaterEqual; }

double fused(double x, double y, double z) { return std::fma(x, y, z); }
std::complex<double> fused(const std::complex<double>& x, const std::complex<double>& y,
                           const std::complex<double>& z) {
  return x * y + z;
}

template <class T>
T& at(const std::array<const T*, kCodeArrays>& arrays, const Place& place) {
  return const_cast<T*>(arrays[to_index(
      place.array)])[place.index];  // NOLINT(cppcoreguidelines-pro-type-const-cast): see execute()
}

class InterpretedSums final : public StraightLine {
 public:
  InterpretedSums(std::vector<Sum> sums, int width, const RowLayouts& layouts)
      : sums_(with_starts(std::move(sums))), width_(width), layouts_(layouts) {}

  void run(const Arrays& arrays) const override {
    std::array<double, 8> total{};
    for (const Sum& sum : sums_) {
      start(arrays, sum, total.data());
      for (const Sum::Product& product : sum.products) add(arrays, product, total.data());
      std::copy_n(total.data(), width_, row(arrays, sum.target));
    }
  }

 private:
  double* row(const Arrays& arrays, const Place& place) const {
    const RowLayout& layout = layouts_[to_index(place.array)];
    return &at<double>(arrays, {place.array, layout.stride * place.index + layout.offset});
  }

  void start(const Arrays& arrays, const Sum& sum, double* total) const {
    if (sum.start.array < 0) {
      std::fill_n(total, width_, 0.0);
      return;
    }
    const double* const x = row(arrays, sum.start);
    const double scale = sum.start_scale.array < 0 ? 1.0 : at<double>(arrays, sum.start_scale);
    for (int lane = 0; lane < width_; ++lane) total[lane] = scale * x[lane];
  }

  void add(const Arrays& arrays, const Sum::Product& product, double* total) const {
    const double* const x = row(arrays, product.row);
    const double sign = product.added ? 1.0 : -1.0;
    const double factor =
        product.factor.array < 0 ? sign : sign * at<double>(arrays, product.factor);
    for (int lane = 0; lane < width_; ++lane) total[lane] = std::fma(factor, x[lane], total[lane]);
  }

  std::vector<Sum> sums_;
  int width_;
  RowLayouts layouts_;
};

}  // namespace

Interpreter::Interpreter(const Recording& recording, const ValueTask& task,
                         const ValueProgram& program, int slot_array) {
  const auto place = [&](int n, const Place& absent) {
    if (n < 0) return absent;
    const Place& home = task.homes[to_index(n)];
    return home.array >= 0 ? home : Place{slot_array, program.slot[to_index(n)]};
  };
  std::vector<std::pair<Batch, Step>> steps;
  for (std::size_t k = 0; k < program.instructions.size(); ++k) {
    const ValueProgram::Instruction& i = program.instructions[k];
    const Place a = place(i.a, {}), b = place(i.b, a), c = place(i.c, b);
    if (is_guard(i.kind)) {
      steps.push_back({{i.kind, kCopied, 0, 0}, {a, b, c, {-1, i.node}}});
      continue;
    }
    Place result = a;
    if (i.kind != Kind::kCopy) {
      result = {slot_array, program.slot[to_index(i.node)]};
      const Operation operation =
          i.kind == Kind::kOperation ? recording.node(i.node).operation : kCopied;
      steps.push_back({{i.kind, operation, 0, 0}, {a, b, c, result}});
    }
    for (const Place& target : program.stores[k])
      steps.push_back({{Kind::kCopy, kCopied, 0, 0}, {result, result, result, target}});
  }
  arrange(steps, slot_array, program.slots);
}

// A branch that depends on the kind of each instruction would take longer than most instructions.
// Of the kinds with an instruction whose operands are known, the one with most of them is next,
// until it has none left.
void Interpreter::arrange(const std::vector<std::pair<Batch, Step>>& steps, int slot_array,
                          int slots) {
  std::vector<int> producers(to_index(slots), -1);
  std::vector<std::vector<std::size_t>> users(steps.size());
  std::vector<int> waits_for(steps.size(), 0);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const Step& step = steps[k].second;
    for (const Place& operand : {step.a, step.b, step.c}) {
      const int producer = operand.array == slot_array ? producers[to_index(operand.index)] : -1;
      if (producer < 0) continue;
      users[to_index(producer)].push_back(k);
      ++waits_for[k];
    }
    if (step.target.array == slot_array)
      producers[to_index(step.target.index)] = static_cast<int>(k);
  }
  std::map<std::pair<Kind, Operation>, std::vector<std::size_t>> ready;
  const auto add = [&](std::size_t k) {
    ready[{steps[k].first.kind, steps[k].first.operation}].push_back(k);
  };
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (waits_for[k] == 0) add(k);
  while (steps_.size() < steps.size()) {
    const auto fuller = [](const auto& x, const auto& y) {
      return x.second.size() < y.second.size();
    };
    const auto next = std::max_element(ready.begin(), ready.end(), fuller);
    Batch batch{next->first.first, next->first.second, steps_.size(), 0};
    for (std::size_t i = 0; i < next->second.size(); ++i) {
      const std::size_t k = next->second[i];
      steps_.push_back(steps[k].second);
      for (std::size_t user : users[k])
        if (--waits_for[user] == 0) add(user);
    }
    next->second.clear();
    batch.last = steps_.size();
    batches_.push_back(batch);
  }
}

template <class T, class Value>
void Interpreter::compute(const Batch& batch, const std::array<const T*, kCodeArrays>& arrays,
                          const Value& value) const {
  for (std::size_t k = batch.first; k < batch.last; ++k) {
    const Step& step = steps_[k];
    at<T>(arrays, step.target) =
        value(at<T>(arrays, step.a), at<T>(arrays, step.b), at<T>(arrays, step.c));
  }
}

template <class T>
void Interpreter::compute(const Batch& batch,
                          const std::array<const T*, kCodeArrays>& arrays) const {
  switch (batch.kind) {
    case Kind::kProductPlus:
      return compute(batch, arrays,
                     [](const T& a, const T& b, const T& c) { return fused(a, b, c); });
    case Kind::kProductMinus:
      return compute(batch, arrays,
                     [](const T& a, const T& b, const T& c) { return fused(a, b, -c); });
    case Kind::kMinusProduct:
      return compute(batch, arrays,
                     [](const T& a, const T& b, const T& c) { return fused(-a, b, c); });
    default:
      break;
  }
  switch (batch.operation) {
    case Operation::kAdd:
      return compute(batch, arrays, [](const T& a, const T& b, const T&) {
        return operate<T>(Operation::kAdd, a, b);
      });
    case Operation::kSubtract:
      return compute(batch, arrays, [](const T& a, const T& b, const T&) {
        return operate<T>(Operation::kSubtract, a, b);
      });
    case Operation::kMultiply:
      return compute(batch, arrays, [](const T& a, const T& b, const T&) {
        return operate<T>(Operation::kMultiply, a, b);
      });
    default:
      return compute(batch, arrays, [&](const T& a, const T& b, const T&) {
        return operate<T>(batch.operation, a, b);
      });
  }
}

template <class T>
int Interpreter::execute(const std::array<const T*, kCodeArrays>& arrays) const {
  int failed = -1;
  for (const Batch& batch : batches_) {
    if (!is_guard(batch.kind)) {
      compute(batch, arrays);
      continue;
    }
    for (std::size_t k = batch.first; k < batch.last; ++k) {
      const Step& step = steps_[k];
      const bool holds = (value_of(at<T>(arrays, step.a)) < value_of(at<T>(arrays, step.b))) ==
                         (batch.kind == Kind::kGuardLess);
      if (!holds && (failed < 0 || step.target.index < failed)) failed = step.target.index;
    }
  }
  return failed;
}

template int Interpreter::execute<double>(const std::array<const double*, kCodeArrays>&) const;
template int Interpreter::execute<std::complex<double>>(
    const std::array<const std::complex<double>*, kCodeArrays>&) const;

std::unique_ptr<StraightLine> interpret_sums(std::vector<Sum> sums, int width,
                                             const StraightLine::RowLayouts& layouts) {
  assert(std::all_of(sums.begin(), sums.end(), [](const Sum& sum) {
    return sum.start.array < 0 && sum.scale.array < 0 && !sum.reciprocal;
  }));
  return std::make_unique<InterpretedSums>(std::move(sums), width, layouts);
}

}  // namespace codesign
