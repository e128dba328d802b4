// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "codegen/interpreter.h"
#include "codegen/traced.h"
#include "codegen/value_program.h"

namespace codesign {

constexpr int kSomeLeaves = 30, kSomeResults = 25;

/// Sums, products, quotients and functions of the leaves and of each other, for any scalar. Some
/// are used at once, some much later, so that they do not all fit into registers.
template <class T>
std::vector<T> some_results(const std::vector<T>& leaves) {
  using std::asin, std::cos, std::exp, std::sin, std::sqrt, std::tanh;
  std::mt19937 random(11);
  std::vector<T> all = leaves;
  const auto any = [&]() -> T { return all[random() % all.size()]; };
  const auto bounded = [](const T& x) -> T { return T(0.4) * tanh(x); };
  for (int k = 0; k < 300; ++k) {
    const T a = any(), b = any(), c = any();
    switch (random() % 12) {
      case 0:
        all.push_back(bounded(a) * b - c);
        break;
      case 1:
        all.push_back(c - a * bounded(b));
        break;
      case 2:
        all.push_back(a / (T(2.0) + bounded(b)));
        break;
      case 3:
        all.push_back(sqrt(T(1.0) + bounded(a) * bounded(a)) - c);
        break;
      case 4:
        all.push_back(sin(a) + cos(b));
        break;
      case 5:
        all.push_back(asin(bounded(a)) * exp(bounded(b)));
        break;
      case 6:
        all.push_back(arc_tangent(a, T(T(1.5) + bounded(b))));
        break;
      case 7:
        all.push_back(-(bounded(a) + T(0.25) * b + T(0.5) * c));
        break;
      case 8:
        all.push_back(bounded(a) * b + bounded(c) * a);
        break;
      default:
        all.push_back(T(0.5) * (a - b) + bounded(c));
        break;
    }
  }
  return {all.end() - kSomeResults, all.end()};
}

/// The recording of some_results() of leaves of array 0.
struct SomeRecording {
  SomeRecording() {
    std::vector<Traced> leaves;
    for (int k = 0; k < kSomeLeaves; ++k)
      leaves.emplace_back(&recording, recording.leaf(0, k, true));
    for (const Traced& result : some_results(leaves)) results.push_back(result.node_in(&recording));
  }

  /// Leaves are read from array 0, literals from array 1.
  std::vector<Place> homes() {
    std::vector<Place> places(static_cast<std::size_t>(recording.size()));
    for (int n = 0; n < recording.size(); ++n) {
      const Recording::Node& node = recording.node(n);
      Place& place = places[static_cast<std::size_t>(n)];
      if (node.operation == Operation::kLeaf) place = {0, node.b};
      if (node.operation != Operation::kLiteral) continue;
      place = {1, static_cast<int>(literals.size())};
      literals.push_back(node.literal);
    }
    return places;
  }

  static std::vector<double> leaf_values() {
    std::vector<double> values;
    for (int k = 0; k < kSomeLeaves; ++k) values.push_back(std::sin(1.3 * k + 0.2));
    return values;
  }

  Recording recording;
  std::vector<int> results;
  std::vector<double> literals;
};

/// The values of all nodes, one after the other.
inline std::vector<double> node_values(const Recording& recording,
                                       const std::vector<double>& leaves) {
  std::vector<double> values;
  for (int n = 0; n < recording.size(); ++n) {
    const Recording::Node& node = recording.node(n);
    const double a = node.operation != Operation::kLeaf && node.a >= 0
                         ? values[static_cast<std::size_t>(node.a)]
                         : 0.0;
    const double b = node.operation != Operation::kLeaf && node.b >= 0
                         ? values[static_cast<std::size_t>(node.b)]
                         : 0.0;
    values.push_back(node.operation == Operation::kLeaf ? leaves[static_cast<std::size_t>(node.b)]
                     : node.operation == Operation::kLiteral ? node.literal
                                                             : operate(node.operation, a, b));
  }
  return values;
}

}  // namespace codesign
