// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/straight_line.h"

#ifdef CODESIGN_MACHINE_CODE
#include <xbyak/xbyak.h>
#include <xbyak/xbyak_util.h>

#include <algorithm>
#include <array>
#include <cstdint>
#endif

namespace codesign {

#ifdef CODESIGN_MACHINE_CODE
namespace {

constexpr std::size_t kMostBytes = 512 * 1024;
constexpr std::size_t kBytesPerOperation = 16;  // an instruction has fewer
constexpr int kOne = 15;                        // the register that holds 1

bool operator==(const Place& x, const Place& y) { return x.array == y.array && x.index == y.index; }

/// Which registers hold which rows; the one that was not asked for longest is given away first.
class Registers {
 public:
  explicit Registers(int count) : count_(static_cast<std::size_t>(count)) {}

  /// The register that holds a row, or -1.
  int find(const Place& row) {
    for (std::size_t r = 0; r < count_; ++r)
      if (held_[r] == row) return touch(r);
    return -1;
  }
  /// A register for a row that will be read or computed.
  int take(const Place& row) {
    if (const int r = find(row); r >= 0) return r;
    std::size_t oldest = 0;
    for (std::size_t r = 1; r < count_; ++r)
      if (asked_[r] < asked_[oldest]) oldest = r;
    held_[oldest] = row;
    return touch(oldest);
  }

 private:
  int touch(std::size_t r) {
    asked_[r] = ++clock_;
    return static_cast<int>(r);
  }

  std::size_t count_;
  std::array<Place, 16> held_{};
  std::array<int, 16> asked_{};
  int clock_ = 0;
};

class MachineCode final : public StraightLine, private Xbyak::CodeGenerator {
 public:
  MachineCode(const std::vector<Sum>& sums, int width, std::size_t bytes)
      : Xbyak::CodeGenerator(bytes, Xbyak::DontSetProtectRWE), width_(width) {
    for (int k = 0; k < kArrays; ++k) mov(base(k), ptr[rdi + 8 * k]);
    if (width_ == 1) {
      mov(rax, std::uint64_t{0x3ff0000000000000});  // the number 1
      vmovq(Xbyak::Xmm(kOne), rax);
      for (const Sum& sum : sums) emit_one(sum);
    } else {
      for (const Sum& sum : sums) emit_many(sum);
      vzeroupper();
    }
    ret();
    setProtectModeRE();
    run_ = getCode<void (*)(const double* const*)>();
  }

  void run(const double* const (&arrays)[kArrays]) const override { run_(arrays); }

 private:
  Xbyak::Reg64 base(int array) const {
    const Xbyak::Reg64 bases[kArrays] = {rsi, rdx, rcx, r8, r9};
    return bases[array];
  }
  Xbyak::Address number(const Place& place) { return qword[base(place.array) + 8 * place.index]; }
  Xbyak::Address row(const Place& place, int block) { return yword[base(place.array) + 8 * width_ * place.index + 32 * block]; }

  // Long sums in two parts, since every addition waits for the one before it.
  void emit_one(const Sum& sum) {
    const Xbyak::Xmm result(registers_.take(sum.target)), second(14);
    if (sum.start.array < 0)
      vxorpd(result, result, result);
    else if (sum.start_scale.array < 0)
      vmovsd(result, number(sum.start));
    else
      vmovsd(result, number(sum.start)), vmulsd(result, result, number(sum.start_scale));
    const std::size_t in_second = sum.products.size() < 4 ? 0 : sum.products.size() / 2;
    for (std::size_t k = 0; k < sum.products.size(); ++k) {
      const Sum::Product& product = sum.products[k];
      int held = registers_.find(product.row);
      if (held < 0) {
        held = registers_.take(product.row);
        vmovsd(Xbyak::Xmm(held), number(product.row));
      }
      if (k >= in_second)
        vfnmadd231sd(result, Xbyak::Xmm(held), number(product.factor));
      else if (k == 0)
        vmulsd(second, Xbyak::Xmm(held), number(product.factor));
      else
        vfmadd231sd(second, Xbyak::Xmm(held), number(product.factor));
      registers_.find(sum.target);
    }
    if (in_second > 0) vsubsd(result, result, second);
    if (sum.scale.array >= 0) vmulsd(result, result, number(sum.scale));
    if (sum.reciprocal) vdivsd(result, Xbyak::Xmm(kOne), result);
    vmovsd(number(sum.target), result);
  }

  void emit_many(const Sum& sum) {
    const int blocks = width_ / 4;
    const Xbyak::Ymm factor(15);
    const auto result = [](int block) { return Xbyak::Ymm(block); };
    if (sum.start_scale.array >= 0) vbroadcastsd(factor, number(sum.start_scale));
    for (int block = 0; block < blocks; ++block)
      if (sum.start.array < 0)
        vxorpd(result(block), result(block), result(block));
      else if (sum.start_scale.array < 0)
        vmovupd(result(block), row(sum.start, block));
      else
        vmulpd(result(block), factor, row(sum.start, block));
    for (const Sum::Product& product : sum.products) {
      vbroadcastsd(factor, number(product.factor));
      for (int block = 0; block < blocks; ++block) vfnmadd231pd(result(block), factor, row(product.row, block));
    }
    if (sum.scale.array >= 0) {
      vbroadcastsd(factor, number(sum.scale));
      for (int block = 0; block < blocks; ++block) vmulpd(result(block), result(block), factor);
    }
    for (int block = 0; block < blocks; ++block) vmovupd(row(sum.target, block), result(block));
  }

  int width_;
  Registers registers_{14};
  void (*run_)(const double* const*) = nullptr;
};

bool can_run() {
  static const bool can = [] {
    const Xbyak::util::Cpu cpu;
    return cpu.has(Xbyak::util::Cpu::tAVX2) && cpu.has(Xbyak::util::Cpu::tFMA);
  }();
  return can;
}

}  // namespace

std::unique_ptr<StraightLine> StraightLine::compile(const std::vector<Sum>& sums, int width) {
  std::size_t operations = 32;
  for (const Sum& sum : sums) operations += 8 + (1 + static_cast<std::size_t>(width + 3) / 4) * sum.products.size();
  const std::size_t bytes = kBytesPerOperation * operations;
  if (bytes > kMostBytes || !can_run()) return nullptr;
  try {
    return std::make_unique<MachineCode>(sums, width, (bytes + 4095) / 4096 * 4096);
  } catch (const Xbyak::Error&) {
    return nullptr;
  }
}
#else
std::unique_ptr<StraightLine> StraightLine::compile(const std::vector<Sum>&, int) { return nullptr; }
#endif

}  // namespace codesign
