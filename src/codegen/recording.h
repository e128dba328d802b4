// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <typeindex>
#include <utility>
#include <vector>

#include "math/arrays.h"

namespace codesign {

/// Identifies the object that an input of a recording is computed from: an expression, or a
/// function of time. The object keeps its type, so that code generation need not know it and its
/// reader cannot take it for another. It must outlive the id.
class SourceId {
 public:
  template <class Source>
  explicit SourceId(const Source& source) : address_(&source), type_(typeid(Source)) {}

  /// The object, or null if it is of another type.
  template <class Source>
  const Source* as() const {
    return type_ == typeid(Source) ? static_cast<const Source*>(address_) : nullptr;
  }
  bool operator==(const SourceId& other) const {
    return address_ == other.address_ && type_ == other.type_;
  }

 private:
  const void* address_;
  std::type_index type_;
};

/// Where a switch was recorded: of which object, and of which part of it.
struct SwitchOrigin {
  std::optional<SourceId> source;  ///< empty: not known
  int part = -1;  ///< of an expression the operation; of stops and friction laws their decision
  bool compares_with_literal = false;  ///< y of x < y is a number, as in floor(x)
  bool is_kink = false;  ///< what it decides is continuous by its form: is_below_kink()
};

/// What the results of a computation do where a decision turns.
enum class DecisionKind {
  kSmooth,  ///< they go on with the same slope: is_less()
  kSwitch,  ///< a kink or a jump: is_below()
  kKink     ///< a kink in all states and designs: is_below_kink()
};

/// Elementary operations of a Recording.
enum class Operation : std::uint8_t {
  kLeaf,     ///< an input: entry b of array a
  kLiteral,  ///< a constant, known while recording
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kNegate,
  kSquareRoot,
  kRound,  ///< to the nearest integer
  kTanh,
  kExp,
  kLog,
  kSin,
  kCos,
  kArcSine,
  kArcTangent  ///< atan2(a, b)
};

/// The elementary operations of a computation as a computational graph (Griewank and Walther,
/// Evaluating Derivatives, 2008, section 2.2). The nodes are in the order of computation, operands
/// before the operations that use them; an operation that occurs again with the same operands gets
/// no second node.
class Recording {
 public:
  Recording() { nodes_.reserve(kUsualNodes); }

  struct Node {
    Operation operation;
    bool varies = false;   ///< depends on a leaf that varies between evaluations of one design
    int a = -1, b = -1;    ///< operands, -1 where there is none
    double literal = 0.0;  ///< of kLiteral
  };

  /// A branch of the recorded computation: the recording is valid only where (a < b) == outcome.
  struct Guard {
    int a, b;
    bool outcome;
    int decision = -1;       ///< index among guards()
    bool is_switch = false;  ///< whether its outcome may be held
  };

  // The next five functions return the index of a node.

  /// The leaf for entry `index` of an input array. @param varies whether it changes between
  /// evaluations of one design.
  int leaf(int array, int index, bool varies);
  /// A constant. NaN, which stands for a value that must not be used while recording, makes the
  /// recording refused().
  int literal(double x);
  /// A leaf of array kSupplied that does not vary: the value of `source`, an expression, for the
  /// parameters of a design.
  int supplied(const SourceId& source);
  /// A leaf of array kTimed that varies: the derivative of the given order (0 to 3) of the function
  /// of time `source`.
  int timed(const SourceId& source, int order);
  /// @param b -1 for operations with one operand.
  int operate(Operation operation, int a, int b = -1);

  /// The outcome of a < b, which a guard keeps: as it was decided before, else the next of those to
  /// hold() if it is a switch, else the next of the outcomes to follow(), else `expected`.
  /// @param place place_in_source() of the decision. @param kind of a switch; counts while
  /// record_switches(true) and if the outcome varies.
  bool decide(int a, int b, bool expected, unsigned place,
              DecisionKind kind = DecisionKind::kSmooth);
  /// Later decisions have these outcomes in turn, and the expected outcomes after them. The guards
  /// of two recordings of one computation with the same outcomes are the same, and so are their
  /// nodes.
  void follow(std::vector<bool> outcomes) { followed_ = std::move(outcomes); }
  /// Later switches have these outcomes in turn: a mode.
  void hold(std::vector<bool> mode) { held_ = std::move(mode); }
  /// Whether switches are marked as such from now on; else they are decisions as all others.
  void record_switches(bool on) { records_switches_ = on; }
  /// Switches that are recorded from now on are of this object; name_part() says of which part.
  void name_switches(const std::optional<SourceId>& source) { origin_ = {source}; }
  void name_part(int part) { origin_.part = part; }
  /// The origins of the switches among guards(), in their order. A switch that several objects
  /// share has the first one.
  const std::vector<SwitchOrigin>& switch_origins() const { return switch_origins_; }
  /// Keeps a node that varies for noted(), while record_switches(true).
  void note(int node);
  const std::vector<int>& noted() const { return noted_; }
  /// Later decisions at the places where `turned` is true have the outcome that is not expected, to
  /// see what else results can depend on.
  void turn(std::function<bool(unsigned place)> turned) { turned_ = std::move(turned); }
  /// Expressions compute the sum of what their branches give, to see all that they can depend on:
  /// evaluate_formula(). Their values mean nothing then.
  void take_all_branches() { takes_all_branches_ = true; }
  bool takes_all_branches() const { return takes_all_branches_; }
  /// The places of all decisions, each once, in the order of their first occurrence.
  const std::vector<unsigned>& places() const { return places_; }
  /// Makes the recording refused(): the computation branched in a way that no guard can check.
  void refuse() { refused_ = true; }

  int size() const { return static_cast<int>(nodes_.size()); }
  const Node& node(int k) const { return nodes_[to_index(k)]; }
  const std::vector<Guard>& guards() const { return guards_; }
  /// The index among guards() of each decision, also of those that were made before, in turn.
  const std::vector<int>& decisions() const { return decisions_; }
  /// Whether the recording must not be compiled.
  bool refused() const { return refused_; }
  /// The source of each entry of array kSupplied.
  const std::vector<SourceId>& supplied_sources() const { return supplied_; }
  /// The source of each group of kFunctionOrders entries of array kTimed.
  const std::vector<SourceId>& timed_sources() const { return timed_; }

  static constexpr int kSupplied = 100, kTimed = 101, kFunctionOrders = 4;

 private:
  static constexpr std::size_t kUsualNodes = 4096;  ///< of a mechanism with some ten bodies

  /// The node with this operation and these operands, entry or literal.
  int find_or_append(const Node& node);
  /// The entry of table_ that holds a node with this content, or is empty and would.
  int& place_of(const Node& node);
  void grow_table();

  std::vector<Node> nodes_;
  /// A hash table in one array of a power of two entries: each node's index, -1 where there is
  /// none. Without keys, since most operations are new, and what it costs is to touch its memory.
  std::vector<int> table_;
  int unused_bits_ = 64;  ///< of 64 bits of a hash
  std::vector<Guard> guards_;
  std::vector<SourceId> supplied_, timed_;
  /// index among guards_, by the nodes that are compared
  std::map<std::pair<int, int>, int> decided_;
  std::vector<int> decisions_;
  std::vector<bool> followed_, held_;
  bool records_switches_ = false;
  SwitchOrigin origin_;  ///< of the next switch
  bool takes_all_branches_ = false;
  std::vector<SwitchOrigin> switch_origins_;
  std::vector<int> noted_;
  std::function<bool(unsigned)> turned_;
  std::vector<unsigned> places_;
  bool refused_ = false;
};

}  // namespace codesign
