// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/recording.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "math/arrays.h"

namespace codesign {
namespace {

int find_or_append(const SourceId& source, std::vector<SourceId>* sources) {
  const auto known = std::find(sources->begin(), sources->end(), source);
  const auto index = static_cast<int>(known - sources->begin());
  if (known == sources->end()) sources->push_back(source);
  return index;
}

}  // namespace

int Recording::append(const Node& node) {
  nodes_.push_back(node);
  return size() - 1;
}

int Recording::leaf(int array, int index, bool varies) {
  const auto [known, is_new] = leaves_.try_emplace({array, index}, size());
  return is_new ? append({Operation::kLeaf, array, index, 0.0, varies}) : known->second;
}

int Recording::literal(double x) {
  if (std::isnan(x)) refuse();
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  const auto [known, is_new] = literals_.try_emplace(bits, size());
  return is_new ? append({Operation::kLiteral, -1, -1, x, false}) : known->second;
}

int Recording::supplied(const SourceId& source) {
  return leaf(kSupplied, find_or_append(source, &supplied_), false);
}

int Recording::timed(const SourceId& source, int order) {
  return leaf(kTimed, kFunctionOrders * find_or_append(source, &timed_) + order, true);
}

int Recording::operate(Operation operation, int a, int b) {
  if ((operation == Operation::kAdd || operation == Operation::kMultiply) && a > b) std::swap(a, b);
  constexpr int kBits = 29;
  const std::uint64_t key = (static_cast<std::uint64_t>(operation) << (2 * kBits)) |
                            (static_cast<std::uint64_t>(a + 1) << kBits) |
                            static_cast<std::uint64_t>(b + 1);
  if (const auto [known, is_new] = operations_.find_or_add(key, size()); !is_new) return known;
  return append({operation, a, b, 0.0, node(a).varies || (b >= 0 && node(b).varies)});
}

bool Recording::decide(int a, int b, bool expected, unsigned place) {
  const auto [known, is_new] = decided_.try_emplace({a, b}, static_cast<int>(guards_.size()));
  decisions_.push_back(known->second);
  if (is_new) {
    if (std::find(places_.begin(), places_.end(), place) == places_.end()) places_.push_back(place);
    bool outcome = guards_.size() < followed_.size() ? followed_[guards_.size()] : expected;
    if (turned_ && turned_(place)) outcome = !outcome;
    guards_.push_back({a, b, outcome, known->second});
  }
  return guards_[to_index(known->second)].outcome;
}

}  // namespace codesign
