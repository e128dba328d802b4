// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/recording.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "math/arrays.h"

namespace codesign {
namespace {

int index_of(const SourceId& source, std::vector<SourceId>* sources) {
  const auto known = std::find(sources->begin(), sources->end(), source);
  const auto index = static_cast<int>(known - sources->begin());
  if (known == sources->end()) sources->push_back(source);
  return index;
}

/// The bits of a number: zeros of both signs differ, since one over each does.
std::uint64_t bits_of(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

bool are_same(const Recording::Node& x, const Recording::Node& y) {
  return x.operation == y.operation && x.a == y.a && x.b == y.b &&
         bits_of(x.literal) == bits_of(y.literal);
}

}  // namespace

int Recording::find_or_append(const Node& node) {
  if (2 * (nodes_.size() + 1) > table_.size()) grow_table();
  int& place = place_of(node);
  if (place < 0) {
    place = size();
    nodes_.push_back(node);
  }
  return place;
}

// Fibonacci hashing, then the next entry that is empty or has the node.
int& Recording::place_of(const Node& node) {
  constexpr unsigned kOperand = 29;
  const std::uint64_t key =
      bits_of(node.literal) ^ (static_cast<std::uint64_t>(node.operation) << (2 * kOperand)) ^
      (static_cast<std::uint64_t>(node.a + 1) << kOperand) ^ static_cast<std::uint64_t>(node.b + 1);
  const std::size_t last = table_.size() - 1;
  std::size_t k = to_index((key * 0x9E3779B97F4A7C15U) >> unused_bits_);
  while (table_[k] >= 0 && !are_same(nodes_[to_index(table_[k])], node)) k = (k + 1) & last;
  return table_[k];
}

void Recording::grow_table() {
  constexpr int kFirstBits = 13;
  unused_bits_ = table_.empty() ? 64 - kFirstBits : unused_bits_ - 1;
  table_.assign(std::size_t{1} << static_cast<unsigned>(64 - unused_bits_), -1);
  for (int n = 0; n < size(); ++n) place_of(node(n)) = n;
}

int Recording::leaf(int array, int index, bool varies) {
  return find_or_append({Operation::kLeaf, varies, array, index, 0.0});
}

int Recording::literal(double x) {
  if (std::isnan(x)) refuse();
  return find_or_append({Operation::kLiteral, false, -1, -1, x});
}

int Recording::supplied(const SourceId& source) {
  return leaf(kSupplied, index_of(source, &supplied_), false);
}

int Recording::timed(const SourceId& source, int order) {
  return leaf(kTimed, kFunctionOrders * index_of(source, &timed_) + order, true);
}

int Recording::operate(Operation operation, int a, int b) {
  if ((operation == Operation::kAdd || operation == Operation::kMultiply) && a > b) std::swap(a, b);
  return find_or_append({operation, node(a).varies || (b >= 0 && node(b).varies), a, b, 0.0});
}

void Recording::note(int node) {
  if (records_switches_ && nodes_[to_index(node)].varies &&
      std::find(noted_.begin(), noted_.end(), node) == noted_.end())
    noted_.push_back(node);
}

bool Recording::decide(int a, int b, bool expected, unsigned place, DecisionKind kind) {
  const auto [known, is_new] = decided_.try_emplace({a, b}, static_cast<int>(guards_.size()));
  decisions_.push_back(known->second);
  if (is_new) {
    if (std::find(places_.begin(), places_.end(), place) == places_.end()) places_.push_back(place);
    bool outcome = guards_.size() < followed_.size() ? followed_[guards_.size()] : expected;
    const bool may_be_held =
        kind != DecisionKind::kSmooth && records_switches_ && (node(a).varies || node(b).varies);
    const std::size_t switches = switch_origins_.size();
    if (may_be_held && switches < held_.size()) outcome = held_[switches];
    if (turned_ && turned_(place)) outcome = !outcome;
    if (may_be_held) {
      switch_origins_.push_back(origin_);
      switch_origins_.back().compares_with_literal = node(b).operation == Operation::kLiteral;
      switch_origins_.back().is_kink = kind == DecisionKind::kKink;
    }
    guards_.push_back({a, b, outcome, known->second, may_be_held});
  } else if (kind == DecisionKind::kSwitch && guards_[to_index(known->second)].is_switch) {
    // A kink of one formula may be a jump of another.
    const auto before = std::count_if(guards_.begin(), guards_.begin() + known->second,
                                      [](const Guard& guard) { return guard.is_switch; });
    switch_origins_[to_index(before)].is_kink = false;
  }
  return guards_[to_index(known->second)].outcome;
}

}  // namespace codesign
