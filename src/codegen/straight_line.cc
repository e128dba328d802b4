// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/straight_line.h"

#include <algorithm>

#ifdef CODESIGN_MACHINE_CODE
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "codegen/machine_code.h"
#include "math/arrays.h"
#endif

namespace codesign {

std::vector<Sum> with_starts(std::vector<Sum> sums) {
  for (Sum& sum : sums) {
    const auto leading = std::find_if(sum.products.begin(), sum.products.end(),
                                      [](const Sum::Product& p) { return p.added; });
    if (sum.start.array >= 0 || leading == sum.products.end()) continue;
    sum.start = leading->row;
    sum.start_scale = leading->factor;
    sum.products.erase(leading);
  }
  return sums;
}

#ifdef CODESIGN_MACHINE_CODE
namespace {

constexpr std::size_t kBytesPerOperation = 16;  // upper bound
constexpr int kOne = 15;                        // register of the number 1 (width 1)
constexpr int kSecond = 14;                     // register of the second partial sum (width 1)
constexpr int kFactor = 15;  // register with four copies of a factor (widths 4 and 8)
constexpr int kNone = -1;

/// Assigns registers to rows. It knows all reads in advance; the register that is freed is the one
/// whose row is next read last (Belady's rule). Reads are numbered from 0 in the order of the sums.
class RowRegisters {
 public:
  RowRegisters(const std::vector<Sum>& sums, int count) : held_(to_index(count)) {
    for (const Sum& sum : sums) {
      if (sum.start.array >= 0) add_read(sum.start);
      for (const Sum::Product& product : sum.products) add_read(product.row);
    }
    following_.assign(reads_.size(), kNever);
    next_.assign(rows_.size(), kNever);
    for (std::size_t k = reads_.size(); k-- > 0;) {
      following_[k] = next_[to_index(reads_[k])];
      next_[to_index(reads_[k])] = static_cast<int>(k);
    }
  }

  /// Goes on to the next read.
  void pass() {
    next_[to_index(reads_[now_])] = following_[now_];
    ++now_;
  }

  int find(const Place& row) const {
    for (std::size_t r = 0; r < held_.size(); ++r)
      if (held_[r].place == row) return static_cast<int>(r);
    return kNone;
  }

  /// Whether to load the row that is read now into a register: if two more reads of it follow soon,
  /// the first before the row that it would replace is read.
  bool is_worth_loading(int busy) const {
    constexpr int kSoon = 48;
    const int first = following_[now_],
              second = first == kNever ? kNever : following_[to_index(first)];
    if (second == kNever || second > static_cast<int>(now_) + kSoon) return false;
    const Held& victim = held_[to_index(farthest(busy))];
    return victim.place.array < 0 || next_read(victim) > first;
  }

  /// Frees a register other than `busy` and returns it.
  int take(int busy) {
    const int r = farthest(busy);
    held_[to_index(r)] = {};
    return r;
  }

  /// Notes that register r, and no other, holds this row from now on.
  void hold(const Place& row, int r) {
    if (const int before = find(row); before >= 0) held_[to_index(before)] = {};
    const auto known = rows_.find(key(row));
    held_[to_index(r)] = {row, known == rows_.end() ? kNone : known->second};
  }

 private:
  struct Held {
    Place place;
    int row = kNone;  ///< index among the rows that are read
  };
  static constexpr int kNever = std::numeric_limits<int>::max();

  static std::int64_t key(const Place& row) {
    return (static_cast<std::int64_t>(row.array) << 32) | row.index;
  }

  void add_read(const Place& row) {
    const auto count = static_cast<int>(rows_.size());
    reads_.push_back(rows_.try_emplace(key(row), count).first->second);
  }

  /// The first read of a row after the present one.
  int next_read(const Held& held) const {
    if (held.row < 0) return kNever;
    const int next = next_[to_index(held.row)];
    return next == static_cast<int>(now_) ? following_[now_] : next;
  }

  /// A free register, or else the one whose row is next read last.
  int farthest(int busy) const {
    int best = -1, best_read = -1;
    for (std::size_t r = 0; r < held_.size(); ++r) {
      if (static_cast<int>(r) == busy) continue;
      if (held_[r].place.array < 0) return static_cast<int>(r);
      if (const int read = next_read(held_[r]); read > best_read) {
        best = static_cast<int>(r);
        best_read = read;
      }
    }
    return best;
  }

  std::unordered_map<std::int64_t, int> rows_;  ///< index of each row that is read
  std::vector<int> reads_, following_;  ///< per read: the row, and the next read of the same row
  std::vector<int> next_;               ///< per row: the first read from now on
  std::vector<Held> held_;
  std::size_t now_ = 0;
};

class SumsCode final : public StraightLine, private MachineCode {
 public:
  SumsCode(const std::vector<Sum>& sums, int width, const RowLayouts& layouts, std::size_t bytes)
      : MachineCode(bytes), blocks_((width + 3) / 4), layouts_(layouts) {
    enter();
    width == 1 ? emit_all_ones(sums) : emit_all_many(with_starts(sums));
    leave();
    finish();
  }

  void run(const Arrays& arrays) const override { call(arrays.data()); }

 private:
  Xbyak::Address row(const Place& place, int block) {
    const RowLayout& layout = layouts_[to_index(place.array)];
    return yword[base(place.array) + 8 * (layout.stride * place.index + layout.offset) +
                 32 * block];
  }

  void emit_all_ones(const std::vector<Sum>& sums) {
    mov(rbx, std::uint64_t{0x3ff0000000000000});  // the number 1
    vmovq(Xbyak::Xmm(kOne), rbx);
    RowRegisters registers(sums, kSecond);
    for (const Sum& sum : sums) emit_one(sum, &registers);
  }

  // Long sums are computed as two partial sums side by side, since each addition must wait for the
  // one before it.
  void emit_one(const Sum& sum, RowRegisters* registers) {
    const int target = registers->take(kNone);
    const Xbyak::Xmm result(target), second(kSecond);
    if (sum.start.array < 0)
      vxorpd(result, result, result);
    else if (sum.start_scale.array < 0)
      vmovsd(result, number(sum.start));
    else
      vmovsd(result, number(sum.start)), vmulsd(result, result, number(sum.start_scale));
    if (sum.start.array >= 0) registers->pass();
    const std::size_t in_second = sum.products.size() < 4 ? 0 : sum.products.size() / 2;
    for (std::size_t k = 0; k < sum.products.size(); ++k) {
      const Sum::Product& product = sum.products[k];
      int held = registers->find(product.row);
      if (held < 0) {
        held = registers->take(target);
        registers->hold(product.row, held);
        vmovsd(Xbyak::Xmm(held), number(product.row));
      }
      if (k >= in_second)
        vfnmadd231sd(result, Xbyak::Xmm(held), number(product.factor));
      else if (k == 0)
        vmulsd(second, Xbyak::Xmm(held), number(product.factor));
      else
        vfmadd231sd(second, Xbyak::Xmm(held), number(product.factor));
      registers->pass();
    }
    if (in_second > 0) vsubsd(result, result, second);
    if (sum.scale.array >= 0) vmulsd(result, result, number(sum.scale));
    if (sum.reciprocal) vdivsd(result, Xbyak::Xmm(kOne), result);
    vmovsd(number(sum.target), result);
    registers->hold(sum.target, target);
  }

  void emit_all_many(const std::vector<Sum>& sums) {
    RowRegisters registers(sums, kFactor / blocks_);
    for (const Sum& sum : sums) emit_many(sum, &registers);
    vzeroupper();
  }

  /// The register of block `block` (four numbers) of the row held in position `held`.
  Xbyak::Ymm part(int held, int block) const { return Xbyak::Ymm(blocks_ * held + block); }

  void emit_start(const Sum& sum, int result, const RowRegisters& registers) {
    const Xbyak::Ymm factor(kFactor);
    const int held = sum.start.array < 0 ? kNone : registers.find(sum.start);
    if (sum.start_scale.array >= 0) vbroadcastsd(factor, number(sum.start_scale));
    for (int block = 0; block < blocks_; ++block) {
      const Xbyak::Ymm to = part(result, block);
      if (sum.start.array < 0)
        vxorpd(to, to, to);
      else if (sum.start_scale.array < 0)
        held < 0 ? vmovupd(to, row(sum.start, block)) : vmovapd(to, part(held, block));
      else
        held < 0 ? vmulpd(to, factor, row(sum.start, block))
                 : vmulpd(to, factor, part(held, block));
    }
  }

  void add_to(const Xbyak::Ymm& to, const Sum::Product& product, const Xbyak::Operand& x) {
    const Xbyak::Ymm factor(kFactor);
    if (product.factor.array < 0)
      product.added ? vaddpd(to, to, x) : vsubpd(to, to, x);
    else
      product.added ? vfmadd231pd(to, factor, x) : vfnmadd231pd(to, factor, x);
  }

  void emit_product(const Sum::Product& product, int result, RowRegisters* registers) {
    int held = registers->find(product.row);
    if (held < 0 && registers->is_worth_loading(result)) {
      held = registers->take(result);
      registers->hold(product.row, held);
      for (int block = 0; block < blocks_; ++block)
        vmovupd(part(held, block), row(product.row, block));
    }
    if (product.factor.array >= 0) vbroadcastsd(Xbyak::Ymm(kFactor), number(product.factor));
    for (int block = 0; block < blocks_; ++block) {
      if (held >= 0)
        add_to(part(result, block), product, part(held, block));
      else
        add_to(part(result, block), product, row(product.row, block));
    }
    registers->pass();
  }

  void emit_many(const Sum& sum, RowRegisters* registers) {
    const int held = sum.start.array < 0 ? kNone : registers->find(sum.start);
    const int result = registers->take(held);
    emit_start(sum, result, *registers);
    if (sum.start.array >= 0) registers->pass();
    for (const Sum::Product& product : sum.products) emit_product(product, result, registers);
    const Xbyak::Ymm factor(kFactor);
    if (sum.scale.array >= 0) {
      vbroadcastsd(factor, number(sum.scale));
      for (int block = 0; block < blocks_; ++block)
        vmulpd(part(result, block), part(result, block), factor);
    }
    for (int block = 0; block < blocks_; ++block)
      vmovupd(row(sum.target, block), part(result, block));
    registers->hold(sum.target, result);
  }

  int blocks_;
  RowLayouts layouts_;
};

}  // namespace

std::unique_ptr<StraightLine> StraightLine::compile(const std::vector<Sum>& sums, int width,
                                                    const RowLayouts& layouts,
                                                    std::size_t most_bytes) {
  std::size_t operations = 64;
  for (const Sum& sum : sums) operations += 8 + (1 + to_index(width + 3) / 4) * sum.products.size();
  const std::size_t bytes = kBytesPerOperation * operations;
  if (bytes > most_bytes || !MachineCode::can_run()) return nullptr;
  try {
    return std::make_unique<SumsCode>(sums, width, layouts, bytes);
  } catch (const Xbyak::Error&) {
    return nullptr;
  }
}
#else
std::unique_ptr<StraightLine> StraightLine::compile(const std::vector<Sum>&, int, const RowLayouts&,
                                                    std::size_t) {
  return nullptr;
}
#endif

std::unique_ptr<StraightLine> StraightLine::compile(const std::vector<Sum>& sums, int width) {
  constexpr std::size_t kMostBytes = 512 * 1024;
  RowLayouts behind;
  behind.fill({width, 0});
  return compile(sums, width, behind, kMostBytes);
}

}  // namespace codesign
