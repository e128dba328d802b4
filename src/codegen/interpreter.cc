// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/interpreter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <utility>

#include "codegen/operate.h"
#include "math/to_index.h"

namespace codesign {
namespace {

using Kind = ValueProgram::Kind;

double fused(double x, double y, double z) { return std::fma(x, y, z); }
std::complex<double> fused(const std::complex<double>& x, const std::complex<double>& y, const std::complex<double>& z) {
  return x * y + z;
}

template <class T>
T& at(const std::array<const T*, kCodeArrays>& arrays, const Place& place) {
  return const_cast<T*>(arrays[to_index(place.array)])[place.index];  // NOLINT(cppcoreguidelines-pro-type-const-cast): see execute()
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
    const double factor = product.factor.array < 0 ? sign : sign * at<double>(arrays, product.factor);
    for (int lane = 0; lane < width_; ++lane) total[lane] = std::fma(factor, x[lane], total[lane]);
  }

  std::vector<Sum> sums_;
  int width_;
  RowLayouts layouts_;
};

}  // namespace

Interpreter::Interpreter(const Recording& recording, const ValueTask& task, const ValueProgram& program, int slot_array) {
  const auto place = [&](int n) {
    if (n < 0) return Place{};
    const Place& home = task.homes[to_index(n)];
    return home.array >= 0 ? home : Place{slot_array, program.slot[to_index(n)]};
  };
  for (std::size_t k = 0; k < program.instructions.size(); ++k) {
    const ValueProgram::Instruction& i = program.instructions[k];
    Step step{Action::kOperate, Operation::kLiteral, place(i.a), place(i.b), place(i.c), targets_.size(), 0, -1};
    const bool guards = i.kind == Kind::kGuardLess || i.kind == Kind::kGuardGreaterEqual;
    if (guards) {
      step.action = i.kind == Kind::kGuardLess ? Action::kGuardLess : Action::kGuardGreaterEqual;
      step.decision = i.node;
    } else if (i.kind == Kind::kOperation) {
      step.operation = recording.node(i.node).operation;
    } else if (i.kind != Kind::kCopy) {
      step.action = i.kind == Kind::kProductPlus    ? Action::kProductPlus
                    : i.kind == Kind::kProductMinus ? Action::kProductMinus
                                                    : Action::kMinusProduct;
    }
    if (!guards && i.kind != Kind::kCopy) targets_.push_back({slot_array, program.slot[to_index(i.node)]});
    targets_.insert(targets_.end(), program.stores[k].begin(), program.stores[k].end());
    step.last_target = targets_.size();
    steps_.push_back(step);
  }
}

template <class T>
T Interpreter::value_of_step(const Step& step, const T& a, const T& b, const T& c) {
  switch (step.action) {
    case Action::kProductPlus:
      return fused(a, b, c);
    case Action::kProductMinus:
      return fused(a, b, T(-c));
    case Action::kMinusProduct:
      return fused(T(-a), b, c);
    default:
      return operate<T>(step.operation, a, b);  // a copy is the operation of a literal: its operand
  }
}

template <class T>
int Interpreter::execute(const std::array<const T*, kCodeArrays>& arrays) const {
  int failed = -1;
  const T none(0.0);
  for (const Step& step : steps_) {
    const T& a = at<T>(arrays, step.a);
    const T& b = step.b.array < 0 ? none : at<T>(arrays, step.b);
    if (step.action >= Action::kGuardLess) {
      const bool holds = (value_of(a) < value_of(b)) == (step.action == Action::kGuardLess);
      if (!holds && (failed < 0 || step.decision < failed)) failed = step.decision;
      continue;
    }
    const T value = value_of_step<T>(step, a, b, step.c.array < 0 ? none : at<T>(arrays, step.c));
    for (std::size_t k = step.first_target; k < step.last_target; ++k) at<T>(arrays, targets_[k]) = value;
  }
  return failed;
}

template int Interpreter::execute<double>(const std::array<const double*, kCodeArrays>&) const;
template int Interpreter::execute<std::complex<double>>(const std::array<const std::complex<double>*, kCodeArrays>&) const;

std::unique_ptr<StraightLine> interpret_sums(std::vector<Sum> sums, int width, const StraightLine::RowLayouts& layouts) {
  assert(
      std::all_of(sums.begin(), sums.end(), [](const Sum& sum) { return sum.start.array < 0 && sum.scale.array < 0 && !sum.reciprocal; }));
  return std::make_unique<InterpretedSums>(std::move(sums), width, layouts);
}

}  // namespace codesign
