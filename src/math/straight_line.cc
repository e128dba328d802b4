// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/straight_line.h"

#ifdef CODESIGN_MACHINE_CODE
#include <algorithm>
#include <cstdint>
#endif

namespace codesign {

#ifdef CODESIGN_MACHINE_CODE
namespace {

constexpr std::size_t kMostBytes = 512 * 1024;
constexpr std::size_t kBytesPerOperation = 16;  // an instruction has fewer
constexpr int kOne = 15;                        // the register that holds 1

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

class SumsCode final : public StraightLine, private MachineCode {
 public:
  SumsCode(const std::vector<Sum>& sums, int width, const RowLayouts& layouts, std::size_t bytes)
      : MachineCode(bytes), width_(width), layouts_(layouts) {
    enter();
    if (width_ == 1) {
      mov(rbx, std::uint64_t{0x3ff0000000000000});  // the number 1
      vmovq(Xbyak::Xmm(kOne), rbx);
      for (const Sum& sum : sums) emit_one(sum);
    } else {
      for (const Sum& sum : sums) emit_many(sum);
      vzeroupper();
    }
    leave();
    finish();
  }

  void run(const Arrays& arrays) const override { call(arrays.data()); }

 private:
  Xbyak::Address row(const Place& place, int block) {
    const RowLayout& layout = layouts_[static_cast<std::size_t>(place.array)];
    return yword[base(place.array) + 8 * (layout.stride * place.index + layout.offset) + 32 * block];
  }

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

  void start_many(const Sum& sum, Xbyak::Ymm factor) {
    if (sum.start_scale.array >= 0) vbroadcastsd(factor, number(sum.start_scale));
    for (int block = 0; block < width_ / 4; ++block) {
      const Xbyak::Ymm result(block);
      if (sum.start.array < 0)
        vxorpd(result, result, result);
      else if (sum.start_scale.array < 0)
        vmovupd(result, row(sum.start, block));
      else
        vmulpd(result, factor, row(sum.start, block));
    }
  }

  void add_product(const Sum::Product& product, Xbyak::Ymm factor) {
    if (product.factor.array >= 0) vbroadcastsd(factor, number(product.factor));
    for (int block = 0; block < width_ / 4; ++block) {
      const Xbyak::Ymm result(block);
      const Xbyak::Address x = row(product.row, block);
      if (product.factor.array < 0)
        product.added ? vaddpd(result, result, x) : vsubpd(result, result, x);
      else
        product.added ? vfmadd231pd(result, factor, x) : vfnmadd231pd(result, factor, x);
    }
  }

  void emit_many(const Sum& sum) {
    const int blocks = width_ / 4;
    const Xbyak::Ymm factor(15);
    const auto result = [](int block) { return Xbyak::Ymm(block); };
    start_many(sum, factor);
    for (const Sum::Product& product : sum.products) add_product(product, factor);
    if (sum.scale.array >= 0) {
      vbroadcastsd(factor, number(sum.scale));
      for (int block = 0; block < blocks; ++block) vmulpd(result(block), result(block), factor);
    }
    for (int block = 0; block < blocks; ++block) vmovupd(row(sum.target, block), result(block));
  }

  int width_;
  RowLayouts layouts_;
  Registers registers_{14};
};

}  // namespace

std::unique_ptr<StraightLine> StraightLine::compile(const std::vector<Sum>& sums, int width, const RowLayouts& layouts) {
  std::size_t operations = 64;
  for (const Sum& sum : sums) operations += 8 + (1 + static_cast<std::size_t>(width + 3) / 4) * sum.products.size();
  const std::size_t bytes = kBytesPerOperation * operations;
  if (bytes > kMostBytes || !MachineCode::can_run()) return nullptr;
  try {
    return std::make_unique<SumsCode>(sums, width, layouts, bytes);
  } catch (const Xbyak::Error&) {
    return nullptr;
  }
}
#else
std::unique_ptr<StraightLine> StraightLine::compile(const std::vector<Sum>&, int, const RowLayouts&) { return nullptr; }
#endif

std::unique_ptr<StraightLine> StraightLine::compile(const std::vector<Sum>& sums, int width) {
  RowLayouts behind;
  behind.fill({width, 0});
  return compile(sums, width, behind);
}

}  // namespace codesign
