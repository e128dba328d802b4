// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef CODESIGN_MACHINE_CODE
#include <xbyak/xbyak.h>
#include <xbyak/xbyak_util.h>

#include <cstddef>

#include "codegen/value_program.h"

namespace codesign {

/// Base of the code generators: a function int(const double* const* arrays) of straight-line code
/// on numbers in arrays, in the System V calling convention. rbx holds the argument. Its memory is
/// writable until finish() only.
class MachineCode : protected Xbyak::CodeGenerator {
 public:
  MachineCode(const MachineCode&) = delete;
  MachineCode& operator=(const MachineCode&) = delete;

  /// Whether the processor has AVX2 and FMA, which the code uses.
  static bool can_run() {
    static const bool can = [] {
      const Xbyak::util::Cpu cpu;
      return cpu.has(Xbyak::util::Cpu::tAVX2) && cpu.has(Xbyak::util::Cpu::tFMA);
    }();
    return can;
  }

 protected:
  explicit MachineCode(std::size_t bytes)
      : Xbyak::CodeGenerator((bytes + 4095) / 4096 * 4096, Xbyak::DontSetProtectRWE) {}

  /// Saves registers and loads the addresses of the arrays. Afterwards the stack is aligned for
  /// calls.
  void enter() {
    push(rbx), push(rbp), push(r13);
    mov(rbx, rdi);
    load_bases();
  }
  /// Loads the addresses of the arrays; needed again after each call, which may change these
  /// registers.
  void load_bases() {
    for (int k = 0; k < kCodeArrays; ++k) mov(base(k), ptr[rbx + 8 * k]);
  }
  /// Returns the value of eax.
  void leave() {
    pop(r13), pop(rbp), pop(rbx);
    ret();
  }
  void finish() {
    setProtectModeRE();
    run_ = getCode<int (*)(const double* const*)>();
  }

  Xbyak::Reg64 base(int array) const {
    using Register = Xbyak::Operand;
    static constexpr int kBases[kCodeArrays] = {
        Register::RSI, Register::RDX, Register::RCX, Register::R8,  Register::R9, Register::R10,
        Register::R11, Register::RAX, Register::RBP, Register::R13, Register::RDI};
    return Xbyak::Reg64(kBases[array]);
  }
  Xbyak::Address number(const Place& place) { return qword[base(place.array) + 8 * place.index]; }

  // Pointers, not spans, here and in the callers: the code loads the addresses directly and
  // contains the indices. It writes to its targets although the numbers are declared const.
  int call(const double* const* arrays) const { return run_(arrays); }

 private:
  int (*run_)(const double* const*) = nullptr;
};

}  // namespace codesign
#endif
