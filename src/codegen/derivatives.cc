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
    if (after[to_index(n)] || node.operation == Operation::kLeaf ||
        node.operation == Operation::kLiteral)
      continue;
    after[to_index(n)] = after[to_index(node.a)] || (node.b >= 0 && after[to_index(node.b)]);
  }
  return after;
}

/// The linearized graph. Vertices are the nodes of the recording, then one vertex per output; those
/// between leaves and outputs are eliminated one after another.
class Elimination {
 public:
  Elimination(Recording* recording, const std::vector<int>& outputs,
              const std::vector<JacobianInput>& inputs)
      : recording_(recording),
        size_(recording->size()),
        in_(to_index(size_) + outputs.size()),
        out_(in_.size()),
        is_leaf_(in_.size()) {
    for (const JacobianInput& input : inputs) is_leaf_[to_index(input.leaf)] = true;
    find_dependent();
    for (std::size_t k = 0; k < outputs.size(); ++k)
      if (depends_[to_index(outputs[k])])
        connect(outputs[k], size_ + static_cast<int>(k), Traced(1.0));
    // From the outputs back: nodes that no output needs get no edges.
    for (int n = size_ - 1; n >= 0; --n)
      if (!out_[to_index(n)].empty() && !is_leaf_[to_index(n)])
        for (const Partial& partial : partials_of(recording_, n))
          if (depends_[to_index(partial.node)])
            connect(partial.node, n, folded(recording_, partial.factor));
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
    std::sort(edges.begin(), edges.end(),
              [](const Partial& x, const Partial& y) { return x.node < y.node; });
    return edges;
  }

 private:
  /// What depends on no leaf has no derivative.
  void find_dependent() {
    depends_ = is_leaf_;
    for (int n = 0; n < size_; ++n) {
      const Recording::Node& node = recording_->node(n);
      if (node.operation == Operation::kLeaf || node.operation == Operation::kLiteral ||
          node.operation == Operation::kRound)
        continue;
      if (depends_[to_index(node.a)] || (node.b >= 0 && depends_[to_index(node.b)]))
        depends_[to_index(n)] = true;
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
    return std::find_if(edges->begin(), edges->end(),
                        [from](const Partial& edge) { return edge.node == from; });
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
      for (const Partial& edge : in_[to_index(n)])
        connect(edge.node, user, product(recording_, factor, edge.factor));
    }
    remove(n);
  }

  void eliminate_by_degree() {
    const auto degree = [this](int n) {
      return in_[to_index(n)].size() * out_[to_index(n)].size();
    };
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
  int size_;  ///< nodes of the recording before those for derivatives were appended
  std::vector<std::vector<Partial>> in_;  ///< per vertex: its operands with the partial derivatives
  std::vector<std::vector<int>> out_;     ///< per vertex: its users
  std::vector<bool> is_leaf_;
  std::vector<bool> depends_;  ///< per node: whether it is a leaf or depends on one
};

using Parts = std::vector<Partial>;

bool only_adds(Operation operation) {
  return operation == Operation::kAdd || operation == Operation::kSubtract ||
         operation == Operation::kNegate;
}

class Accumulation {
 public:
  Accumulation(Recording* recording, const std::vector<ValueTask::Output>& outputs,
               const std::vector<bool>& is_leaf)
      : recording_(recording),
        outputs_(outputs),
        is_leaf_(is_leaf),
        size_(recording->size()),
        parts_(is_leaf.size()),
        uses_(is_leaf.size(), 0),
        only_added_(is_leaf.size(), true) {}

  void run(TangentProgram* program) {
    program_ = program;
    program->row.assign(is_leaf_.size(), -1);
    find_active();
    count_uses();
    for (int n = 0; n < size_; ++n)
      if (active_[to_index(n)] && uses_[to_index(n)] > 0 && !is_leaf_[to_index(n)]) accumulate(n);
    for (const ValueTask::Output& output : outputs_)
      append(-1, output, of(output.node, Traced(1.0)));
    std::sort(program->factors.begin(), program->factors.end());
    program->factors.erase(std::unique(program->factors.begin(), program->factors.end()),
                           program->factors.end());
  }

 private:
  void find_active() {
    active_ = is_leaf_;
    for (int n = 0; n < size_; ++n) {
      const Recording::Node& node = recording_->node(n);
      if (active_[to_index(n)] || node.operation == Operation::kLeaf ||
          node.operation == Operation::kLiteral || node.operation == Operation::kRound)
        continue;
      active_[to_index(n)] =
          active_[to_index(node.a)] || (node.b >= 0 && active_[to_index(node.b)]);
    }
  }

  void count_uses() {
    for (const ValueTask::Output& output : outputs_) ++uses_[to_index(output.node)];
    for (int n = size_ - 1; n >= 0; --n) {
      if (!active_[to_index(n)] || uses_[to_index(n)] == 0 || is_leaf_[to_index(n)]) continue;
      const Recording::Node& node = recording_->node(n);
      for (int operand : {node.a, node.b}) {
        if (operand < 0) continue;
        ++uses_[to_index(operand)];
        if (!only_adds(node.operation)) only_added_[to_index(operand)] = false;
      }
    }
  }

  /// The derivative of `node` times `factor`, in terms of derivatives of leaves and of nodes with a
  /// sum.
  Parts of(int node, const Traced& factor) const {
    if (!active_[to_index(node)]) return {};
    if (is_leaf_[to_index(node)] || program_->row[to_index(node)] >= 0) return {{node, factor}};
    Parts parts = parts_[to_index(node)];
    for (Partial& part : parts) part.factor = folded(recording_, factor * part.factor);
    return parts;
  }

  void accumulate(int n) {
    Parts sum;
    for (const Partial& partial : partials_of(recording_, n))
      for (const Partial& part : of(partial.node, folded(recording_, partial.factor)))
        add(part, &sum);
    const bool inlined = sum.size() <= 1 || (uses_[to_index(n)] == 1 && only_added_[to_index(n)]);
    if (!inlined) {
      append(n, {}, sum);
      program_->row[to_index(n)] = program_->rows++;
    } else {
      parts_[to_index(n)] = std::move(sum);
    }
  }

  static void add(const Partial& part, Parts* sum) {
    for (Partial& known : *sum) {
      if (known.node != part.node) continue;
      known.factor += part.factor;
      return;
    }
    sum->push_back(part);
  }

  void append(int node, const ValueTask::Output& output, const Parts& parts) {
    TangentProgram::Sum sum{node, output, {}};
    for (const Partial& part : parts) {
      if (part.factor.is(0.0)) continue;
      Traced factor = part.factor;
      const bool negative =
          factor.is_literal()
              ? factor.value() < 0.0
              : recording_->node(factor.node_in(recording_)).operation == Operation::kNegate;
      if (negative) factor = -factor;
      const bool one = factor.is(1.0);
      const int factor_node = one ? -1 : factor.node_in(recording_);
      if (!one) program_->factors.push_back(factor_node);
      sum.terms.push_back({part.node, factor_node, !negative});
    }
    program_->sums.push_back(std::move(sum));
  }

  Recording* recording_;
  const std::vector<ValueTask::Output>& outputs_;
  const std::vector<bool>& is_leaf_;
  int size_;  ///< nodes of the recording before those for factors were appended
  TangentProgram* program_ = nullptr;
  std::vector<Parts> parts_;  ///< of nodes without a sum
  std::vector<int> uses_;
  std::vector<bool> only_added_, active_;
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
    case Operation::kLog:
      return {{node.a, one / value(node.a)}};
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
  const auto varies = [recording](const Traced& z) {
    return !z.is_literal() && recording->node(z.node()).varies;
  };
  if (varies(x) == varies(y)) return folded(recording, x * y);
  const Traced &fixed = varies(x) ? y : x, &moving = varies(x) ? x : y;
  const Recording::Node node = recording->node(moving.node());
  if (node.operation == Operation::kMultiply &&
      recording->node(node.a).varies != recording->node(node.b).varies) {
    const bool first = recording->node(node.a).varies;
    const Traced inner(recording, first ? node.b : node.a),
        rest(recording, first ? node.a : node.b);
    return folded(recording, (fixed * folded(recording, inner)) * rest);
  }
  return folded(recording, x * y);
}

std::vector<Traced> derive_adjoints(Recording* recording, const std::vector<AdjointSeed>& seeds,
                                    const std::vector<bool>& is_target) {
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

std::vector<JacobianEntry> derive_jacobian(Recording* recording, const std::vector<int>& outputs,
                                           const std::vector<JacobianInput>& inputs,
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
      if (!entry.is_literal() || entry.value() != 0.0)
        entries.push_back({static_cast<int>(k), column, entry});
    }
  }
  return entries;
}

TangentProgram::TangentProgram(Recording* recording, const std::vector<ValueTask::Output>& outputs,
                               const std::vector<bool>& is_leaf) {
  Accumulation(recording, outputs, is_leaf).run(this);
}

}  // namespace codesign
