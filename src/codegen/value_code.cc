// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/value_code.h"

#ifdef CODESIGN_MACHINE_CODE
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "codegen/machine_code.h"
#include "math/arrays.h"
#endif

namespace codesign {

#ifdef CODESIGN_MACHINE_CODE
namespace {

// Limit of the estimate, which is about four times the actual size.
constexpr std::size_t kMostBytes = 16 * 1024 * 1024;
constexpr std::size_t kBytesPerInstruction = 64;  // with loads, spills and stores
constexpr std::size_t kBytesPerCall = 256;
constexpr int kRegisters = 16;

using Instruction = ValueProgram::Instruction;
using Kind = ValueProgram::Kind;

/// The instructions that read each node, in order.
class Uses {
 public:
  Uses() = default;
  Uses(const ValueProgram& program, int nodes) : next_(to_index(nodes) + 1), last_(next_.size()) {
    for (const Instruction& i : program.instructions)
      for (int n : {i.a, i.b, i.c})
        if (n >= 0) ++last_[to_index(n)];
    std::partial_sum(last_.begin(), last_.end(), last_.begin());
    std::copy(last_.begin(), last_.end() - 1, next_.begin() + 1);
    positions_.resize(last_.back());
    std::vector<std::size_t> end = next_;
    for (std::size_t k = 0; k < program.instructions.size(); ++k)
      for (int n :
           {program.instructions[k].a, program.instructions[k].b, program.instructions[k].c})
        if (n >= 0) positions_[end[to_index(n)]++] = static_cast<int>(k);
  }

  /// The next instruction that reads the node, after those passed.
  int next(int node) const {
    return is_read_again(node) ? positions_[next_[to_index(node)]]
                               : std::numeric_limits<int>::max();
  }
  bool is_read_again(int node) const { return next_[to_index(node)] < last_[to_index(node)]; }
  void pass(int node) { ++next_[to_index(node)]; }

 private:
  std::vector<int> positions_;  ///< of all nodes, one after the other
  /// per node: where its next position is, and where its positions end
  std::vector<std::size_t> next_, last_;
};

class Code final : public ValueCode, private MachineCode {
 public:
  Code(const Recording& recording, const ValueTask& task, const ValueProgram& program,
       int slot_array, std::size_t bytes)
      : MachineCode(bytes),
        recording_(&recording),
        task_(&task),
        program_(&program),
        slot_array_(slot_array),
        uses_(program, recording.size()),
        register_of_(to_index(recording.size()), -1),
        stored_(to_index(recording.size()), false),
        kept_(to_index(recording.size()), false) {
    for (int n : task.kept) kept_[to_index(n)] = true;
    held_.fill(-1);
    enter();
    for (std::size_t k = 0; k < program.instructions.size(); ++k)
      emit(program.instructions[k], program.stores[k]);
    mov(eax, 1);
    leave();
    L(failed_);
    xor_(eax, eax);
    leave();
    finish();
    release_inputs();
  }

  bool run(const Arrays& arrays) const override { return call(arrays.data()) != 0; }

 private:
  using Xmm = Xbyak::Xmm;
  using Operand = Xbyak::Operand;

  // Places of values.

  Place memory_of(int node) const {
    const Place& home = task_->homes[to_index(node)];
    return home.array >= 0 ? home : Place{slot_array_, program_->slot[to_index(node)]};
  }
  bool in_memory(int node) const {
    return task_->homes[to_index(node)].array >= 0 || stored_[to_index(node)];
  }
  bool in_register(int node) const { return register_of_[to_index(node)] >= 0; }
  Xmm register_of(int node) const { return Xmm(register_of_[to_index(node)]); }

  void release(int node) {
    held_[to_index(register_of_[to_index(node)])] = -1;
    register_of_[to_index(node)] = -1;
  }

  void save(int node) {
    if (in_memory(node)) return;
    vmovsd(number(memory_of(node)), register_of(node));
    stored_[to_index(node)] = true;
  }

  /// A register to write to, not one that the present instruction uses. Its value is saved to
  /// memory if it is not there yet.
  int free_register() {
    int best = -1, farthest = -1;
    for (int r = 0; r < kRegisters; ++r) {
      if (busy_[to_index(r)]) continue;
      if (held_[to_index(r)] < 0) return r;
      if (const int next = next_read_[to_index(r)]; next > farthest) {
        farthest = next;
        best = r;
      }
    }
    const int victim = held_[to_index(best)];
    save(victim);
    release(victim);
    return best;
  }

  void hold(int node, int r) {
    held_[to_index(r)] = node;
    register_of_[to_index(node)] = r;
    next_read_[to_index(r)] = uses_.next(node);
  }

  /// Notes that the present instruction is past reading a node.
  void pass(int node) {
    uses_.pass(node);
    if (in_register(node)) next_read_[to_index(register_of_[to_index(node)])] = uses_.next(node);
  }

  /// A register with the value of the node; it stays unchanged during the present instruction.
  Xmm in_some_register(int node) {
    if (!in_register(node)) {
      const int r = free_register();
      vmovsd(Xmm(r), number(memory_of(node)));
      hold(node, r);
    }
    busy_[to_index(register_of_[to_index(node)])] = true;
    return register_of(node);
  }

  /// The node as an operand to read: a register if it is in one or is read again later, else its
  /// address in memory.
  const Operand& operand(int node) {
    if (in_register(node) || uses_.is_read_again(node)) {
      operand_register_ = in_some_register(node);
      return operand_register_;
    }
    operand_address_ = number(memory_of(node));
    return operand_address_;
  }

  /// Frees the register of an operand that is not read again, for use as the result's.
  void drop(int node) {
    if (node >= 0 && in_register(node) && !uses_.is_read_again(node)) {
      const int r = register_of_[to_index(node)];
      release(node);
      busy_[to_index(r)] = true;  // until the instruction is written
      last_dropped_ = r;
    }
  }

  /// A register for the result: the register of a dropped operand if there is one.
  Xmm result_register() {
    const int r = last_dropped_ >= 0 ? last_dropped_ : free_register();
    busy_[to_index(r)] = true;
    return Xmm(r);
  }

  // Instructions.

  void emit(const Instruction& i, const std::vector<Place>& stores) {
    busy_.fill(false);
    last_dropped_ = -1;
    for (int n : {i.a, i.b, i.c})
      if (n >= 0) pass(n);
    switch (i.kind) {
      case Kind::kGuardLess:
      case Kind::kGuardGreaterEqual:
        emit_guard(i);
        return;
      case Kind::kCopy:
        vmovsd(number(stores.front()), in_some_register(i.a));
        drop(i.a);
        return;
      case Kind::kOperation:
        emit_operation(i);
        break;
      default:
        emit_product(i);
        break;
    }
    for (const Place& place : stores) vmovsd(number(place), register_of(i.node));
    if (kept_[to_index(i.node)]) save(i.node);
    if (!uses_.is_read_again(i.node)) release(i.node);
  }

  void emit_guard(const Instruction& i) {
    const Xmm b = in_some_register(i.b);
    vucomisd(b, operand(i.a));
    i.kind == Kind::kGuardLess ? jbe(failed_, T_NEAR) : ja(failed_, T_NEAR);
    drop(i.a), drop(i.b);
  }

  void emit_operation(const Instruction& i) {
    const Operation operation = recording_->node(i.node).operation;
    switch (operation) {
      case Operation::kAdd:
      case Operation::kMultiply:
      case Operation::kSubtract:
      case Operation::kDivide:
        emit_arithmetic(operation, i);
        return;
      case Operation::kNegate:
      case Operation::kSquareRoot:
      case Operation::kRound:
        emit_unary(operation, i);
        return;
      default:
        emit_call(operation, i);
        return;
    }
  }

  void emit_arithmetic(Operation operation, const Instruction& i) {
    int first = i.a, second = i.b;
    const bool commutes = operation == Operation::kAdd || operation == Operation::kMultiply;
    if (commutes && !in_register(first) && in_register(second)) std::swap(first, second);
    const Xmm x = in_some_register(first);
    const Operand& y = operand(second);
    drop(first), drop(second);
    const Xmm result = result_register();
    switch (operation) {
      case Operation::kAdd:
        vaddsd(result, x, y);
        break;
      case Operation::kMultiply:
        vmulsd(result, x, y);
        break;
      case Operation::kSubtract:
        vsubsd(result, x, y);
        break;
      default:
        vdivsd(result, x, y);
        break;
    }
    hold(i.node, result.getIdx());
  }

  void emit_unary(Operation operation, const Instruction& i) {
    const Xmm x = in_some_register(i.a);
    if (operation != Operation::kNegate) drop(i.a);
    const Xmm result = operation == Operation::kNegate ? Xmm(free_register()) : result_register();
    if (operation == Operation::kNegate) {
      vpcmpeqd(result, result, result);
      vpsllq(result, result, 63);  // only the sign bit set
      vxorpd(result, result, x);
      drop(i.a);
    } else if (operation == Operation::kSquareRoot) {
      vsqrtsd(result, x, x);
    } else {
      vroundsd(result, x, x, 0);
    }
    hold(i.node, result.getIdx());
  }

  // a b + c, a b - c or c - a b. A fused instruction overwrites one operand: c if it is not read
  // again, else a copy of c.
  void emit_product(const Instruction& i) {
    int first = i.a, second = i.b;
    if (!in_register(first) && in_register(second)) std::swap(first, second);
    const Xmm x = in_some_register(first);
    int r = -1;
    if (in_register(i.c) && !uses_.is_read_again(i.c) && i.c != first && i.c != second) {
      r = register_of_[to_index(i.c)];
      release(i.c);
      busy_[to_index(r)] = true;
    }
    const Operand& y = operand(second);
    if (r < 0) {
      if (in_register(i.c)) busy_[to_index(register_of_[to_index(i.c)])] = true;
      r = free_register();
      in_register(i.c) ? vmovapd(Xmm(r), register_of(i.c)) : vmovsd(Xmm(r), number(memory_of(i.c)));
    }
    if (i.kind == Kind::kProductPlus)
      vfmadd231sd(Xmm(r), x, y);
    else if (i.kind == Kind::kProductMinus)
      vfmsub231sd(Xmm(r), x, y);
    else
      vfnmadd231sd(Xmm(r), x, y);
    drop(first), drop(second), drop(i.c);
    hold(i.node, r);
  }

  static const void* function(Operation operation) {
    using Unary = double (*)(double);
    using Binary = double (*)(double, double);
    switch (operation) {
      case Operation::kTanh:
        return reinterpret_cast<const void*>(static_cast<Unary>(std::tanh));
      case Operation::kExp:
        return reinterpret_cast<const void*>(static_cast<Unary>(std::exp));
      case Operation::kLog:
        return reinterpret_cast<const void*>(static_cast<Unary>(std::log));
      case Operation::kSin:
        return reinterpret_cast<const void*>(static_cast<Unary>(std::sin));
      case Operation::kCos:
        return reinterpret_cast<const void*>(static_cast<Unary>(std::cos));
      case Operation::kArcSine:
        return reinterpret_cast<const void*>(static_cast<Unary>(std::asin));
      default:
        return reinterpret_cast<const void*>(static_cast<Binary>(std::atan2));
    }
  }

  // A call may change every register.
  void emit_call(Operation operation, const Instruction& i) {
    for (int r = 0; r < kRegisters; ++r) {
      const int node = held_[to_index(r)];
      if (node < 0) continue;
      if (uses_.is_read_again(node) || node == i.a || node == i.b) save(node);
      release(node);
    }
    vmovsd(Xmm(0), number(memory_of(i.a)));
    if (i.b >= 0) vmovsd(Xmm(1), number(memory_of(i.b)));
    mov(rax, reinterpret_cast<std::size_t>(function(operation)));
    MachineCode::CodeGenerator::call(rax);
    load_bases();
    hold(i.node, 0);
  }

  /// Releases the data that only code generation needs.
  void release_inputs() {
    recording_ = nullptr, task_ = nullptr, program_ = nullptr;
    uses_ = Uses();
    register_of_ = {}, stored_ = {}, kept_ = {};
  }

  const Recording* recording_;
  const ValueTask* task_;
  const ValueProgram* program_;
  int slot_array_;
  Uses uses_;
  std::vector<int> register_of_;  ///< per node: the register that holds it, -1 if none
  /// per node: its value is in its slot; it must be there at the end
  std::vector<bool> stored_, kept_;
  std::array<int, kRegisters> held_{};       ///< the node in each register, -1 if none
  std::array<int, kRegisters> next_read_{};  ///< per register in use: Uses::next() of its node
  std::array<bool, kRegisters> busy_{};      ///< the present instruction reads or writes it
  int last_dropped_ = -1;
  Xmm operand_register_{0};
  Xbyak::Address operand_address_{0, false, Xbyak::RegExp()};
  Xbyak::Label failed_;
};

}  // namespace

bool ValueCode::is_available() { return MachineCode::can_run(); }

std::unique_ptr<ValueCode> ValueCode::compile(const Recording& recording, const ValueTask& task,
                                              const ValueProgram& program, int slot_array) {
  std::size_t bytes = 1024;
  for (std::size_t k = 0; k < program.instructions.size(); ++k)
    bytes += kBytesPerInstruction + 16 * program.stores[k].size();
  for (const Instruction& i : program.instructions)
    if (i.kind == Kind::kOperation && recording.node(i.node).operation >= Operation::kTanh)
      bytes += kBytesPerCall;
  if (bytes > kMostBytes || !MachineCode::can_run()) return nullptr;
  try {
    return std::make_unique<Code>(recording, task, program, slot_array, bytes);
  } catch (const Xbyak::Error&) {
    return nullptr;
  }
}
#else
bool ValueCode::is_available() { return false; }

std::unique_ptr<ValueCode> ValueCode::compile(const Recording&, const ValueTask&,
                                              const ValueProgram&, int) {
  return nullptr;
}
#endif

}  // namespace codesign
