// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/derivatives.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "math/arrays.h"

namespace codesign {
namespace {

/// Per node, whether it is a target or computed from one.
std::vector<bool> nodes_after(const Recording& recording, const std::vector<bool>& is_target) {
  std::vector<bool> after = is_target;
  after.resize(to_index(recording.size()));
  for (int n = 0; n < recording.size(); ++n) {
    const Recording::Node& node = recording.node(n);
    if (after[to_index(n)] || node.operation == Operation::kLeaf || node.operation == Operation::kLiteral) continue;
    after[to_index(n)] = after[to_index(node.a)] || (node.b >= 0 && after[to_index(node.b)]);
  }
  return after;
}

/// The linearized graph. Vertices are the nodes of the recording, then one vertex per output; those between leaves and outputs are
/// eliminated one after another.
class Elimination {
 public:
  Elimination(Recording* recording, const std::vector<int>& outputs, const std::vector<JacobianInput>& inputs)
      : recording_(recording), size_(recording->size()), in_(to_index(size_) + outputs.size()), out_(in_.size()), is_leaf_(in_.size()) {
    for (const JacobianInput& input : inputs) is_leaf_[to_index(input.leaf)] = true;
    find_dependent();
    for (std::size_t k = 0; k < outputs.size(); ++k)
      if (depends_[to_index(outputs[k])]) connect(outputs[k], size_ + static_cast<int>(k), Traced(1.0));
    // From the outputs back: nodes that no output needs get no edges.
    for (int n = size_ - 1; n >= 0; --n)
      if (!out_[to_index(n)].empty() && !is_leaf_[to_index(n)])
        for (const Partial& partial : partials_of(recording_, n))
          if (depends_[to_index(partial.node)]) connect(partial.node, n, folded(recording_, partial.factor));
  }

  void run(EliminationOrder order) {
    if (order == EliminationOrder::kForward)
      for (int n = 0; n < size_; ++n) eliminate(n);
    if (order == EliminationOrder::kReverse)
      for (int n = size_ - 1; n >= 0; --n) eliminate(n);
    if (order == EliminationOrder::kMarkowitz) eliminate_by_degree();
  }

  /// The edges into output k, in order of their leaves.
  std::vector<Partial> row(std::size_t k) const {
    std::vector<Partial> edges = in_[to_index(size_) + k];
    std::sort(edges.begin(), edges.end(), [](const Partial& x, const Partial& y) { return x.node < y.node; });
    return edges;
  }

 private:
  /// What depends on no leaf has no derivative.
  void find_dependent() {
    depends_ = is_leaf_;
    for (int n = 0; n < size_; ++n) {
      const Recording::Node& node = recording_->node(n);
      if (node.operation == Operation::kLeaf || node.operation == Operation::kLiteral || node.operation == Operation::kRound) continue;
      if (depends_[to_index(node.a)] || (node.b >= 0 && depends_[to_index(node.b)])) depends_[to_index(n)] = true;
    }
  }

  void connect(int from, int to, const Traced& value) {
    std::vector<Partial>& edges = in_[to_index(to)];
    const auto known = edge_from(from, &edges);
    if (known != edges.end()) {
      known->factor = folded(recording_, known->factor + value);
      return;
    }
    constexpr std::size_t kUsual = 4;
    if (edges.empty()) edges.reserve(kUsual);
    edges.push_back({from, value});
    out_[to_index(from)].push_back(to);
  }

  static std::vector<Partial>::iterator edge_from(int from, std::vector<Partial>* edges) {
    return std::find_if(edges->begin(), edges->end(), [from](const Partial& edge) { return edge.node == from; });
  }

  void remove(int n) {
    for (int user : out_[to_index(n)]) {
      std::vector<Partial>& edges = in_[to_index(user)];
      edges.erase(edge_from(n, &edges));
    }
    for (const Partial& edge : in_[to_index(n)]) {
      std::vector<int>& users = out_[to_index(edge.node)];
      users.erase(std::find(users.begin(), users.end(), n));
    }
    in_[to_index(n)].clear();
    out_[to_index(n)].clear();
  }

  bool is_between(int n) const { return !is_leaf_[to_index(n)] && !out_[to_index(n)].empty(); }

  void eliminate(int n) {
    if (!is_between(n)) return;
    for (int user : out_[to_index(n)]) {
      const Traced factor = edge_from(n, &in_[to_index(user)])->factor;
      for (const Partial& edge : in_[to_index(n)]) connect(edge.node, user, product(recording_, factor, edge.factor));
    }
    remove(n);
  }

  void eliminate_by_degree() {
    const auto degree = [this](int n) { return in_[to_index(n)].size() * out_[to_index(n)].size(); };
    std::set<std::pair<std::size_t, int>> waiting;
    std::vector<std::size_t> known(to_index(size_), 0);
    for (int n = 0; n < size_; ++n)
      if (is_between(n)) waiting.emplace(known[to_index(n)] = degree(n), n);
    const auto update = [&](int n) {
      if (n >= size_ || !is_between(n)) return;
      waiting.erase({known[to_index(n)], n});
      waiting.emplace(known[to_index(n)] = degree(n), n);
    };
    while (!waiting.empty()) {
      const int n = waiting.begin()->second;
      waiting.erase(waiting.begin());
      std::vector<int> neighbours(out_[to_index(n)].begin(), out_[to_index(n)].end());
      for (const Partial& edge : in_[to_index(n)]) neighbours.push_back(edge.node);
      eliminate(n);
      for (int k : neighbours) update(k);
    }
  }

  Recording* recording_;
  int size_;                              ///< nodes of the recording before those for derivatives were appended
  std::vector<std::vector<Partial>> in_;  ///< per vertex: its operands with the partial derivatives
  std::vector<std::vector<int>> out_;     ///< per vertex: its users
  std::vector<bool> is_leaf_;
  std::vector<bool> depends_;  ///< per node: whether it is a leaf or depends on one
};

}  // namespace

std::vector<Partial> partials_of(Recording* recording, int n) {
  const Recording::Node node = recording->node(n);
  const auto value = [recording](int k) { return Traced(recording, k); };
  const Traced self = value(n), one(1.0);
  switch (node.operation) {
    case Operation::kAdd:
      return {{node.a, one}, {node.b, one}};
    case Operation::kSubtract:
      return {{node.a, one}, {node.b, -one}};
    case Operation::kMultiply:
      return {{node.a, value(node.b)}, {node.b, value(node.a)}};
    case Operation::kDivide: {
      const Traced inverse = one / value(node.b);
      return {{node.a, inverse}, {node.b, -(self * inverse)}};
    }
    case Operation::kNegate:
      return {{node.a, -one}};
    case Operation::kSquareRoot:
      return {{node.a, Traced(0.5) / self}};
    case Operation::kTanh:
      return {{node.a, one - self * self}};
    case Operation::kExp:
      return {{node.a, self}};
    case Operation::kSin:
      return {{node.a, cos(value(node.a))}};
    case Operation::kCos:
      return {{node.a, -sin(value(node.a))}};
    case Operation::kArcSine:
      return {{node.a, one / sqrt(one - value(node.a) * value(node.a))}};
    case Operation::kArcTangent: {
      const Traced y = value(node.a), x = value(node.b), inverse = one / (x * x + y * y);
      return {{node.a, x * inverse}, {node.b, -(y * inverse)}};
    }
    default:
      return {};
  }
}

Traced folded(Recording* recording, const Traced& x) {
  if (x.is_literal()) return x;
  const Recording::Node& node = recording->node(x.node_in(recording));
  return node.operation == Operation::kLiteral ? Traced(node.literal) : x;
}

Traced product(Recording* recording, const Traced& x, const Traced& y) {
  const auto varies = [recording](const Traced& z) { return !z.is_literal() && recording->node(z.node()).varies; };
  if (varies(x) == varies(y)) return folded(recording, x * y);
  const Traced &fixed = varies(x) ? y : x, &moving = varies(x) ? x : y;
  const Recording::Node node = recording->node(moving.node());
  if (node.operation == Operation::kMultiply && recording->node(node.a).varies != recording->node(node.b).varies) {
    const bool first = recording->node(node.a).varies;
    const Traced inner(recording, first ? node.b : node.a), rest(recording, first ? node.a : node.b);
    return folded(recording, (fixed * folded(recording, inner)) * rest);
  }
  return folded(recording, x * y);
}

std::vector<Traced> derive_adjoints(Recording* recording, const std::vector<AdjointSeed>& seeds, const std::vector<bool>& is_target) {
  const std::vector<bool> matters = nodes_after(*recording, is_target);
  std::vector<Traced> adjoints(matters.size(), Traced(0.0));
  const auto add = [&](int n, const Traced& x) {
    if (matters[to_index(n)]) adjoints[to_index(n)] = folded(recording, adjoints[to_index(n)] + x);
  };
  for (const AdjointSeed& seed : seeds) add(seed.node, seed.weight);
  for (std::size_t n = matters.size(); n-- > 0;) {
    if ((n < is_target.size() && is_target[n]) || adjoints[n].is(0.0)) continue;
    for (const Partial& partial : partials_of(recording, static_cast<int>(n)))
      add(partial.node, product(recording, adjoints[n], folded(recording, partial.factor)));
    adjoints[n] = Traced(0.0);
  }
  adjoints.resize(is_target.size());
  return adjoints;
}

std::vector<JacobianEntry> derive_jacobian(Recording* recording, const std::vector<int>& outputs, const std::vector<JacobianInput>& inputs,
                                           EliminationOrder order) {
  Elimination elimination(recording, outputs, inputs);
  elimination.run(order);
  std::map<int, const JacobianInput*> input_of;
  for (const JacobianInput& input : inputs) input_of[input.leaf] = &input;
  std::vector<JacobianEntry> entries;
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    std::map<int, Traced> row;
    for (const auto& [leaf, value] : elimination.row(k)) {
      const JacobianInput& input = *input_of.at(leaf);
      row[input.column] += product(recording, value, input.seed);
    }
    for (const auto& [column, value] : row) {
      const Traced entry = folded(recording, value);
      if (!entry.is_literal() || entry.value() != 0.0) entries.push_back({static_cast<int>(k), column, entry});
    }
  }
  return entries;
}

}  // namespace codesign
