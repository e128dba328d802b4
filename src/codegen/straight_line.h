// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CODEGEN_STRAIGHT_LINE_H_
#define MECHANISM_CODESIGN_CODEGEN_STRAIGHT_LINE_H_

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "codegen/machine_code.h"

namespace codesign {

/// target = (start * start_scale - sum of rows[i] * factors[i]) * scale, or one over that.
///
/// `target`, `start` and `row` are rows of so many numbers side by side as the StraightLine is wide, the rest are single numbers. No target
/// is among the rows of its own sum.
struct Sum {
  struct Product {
    Place row, factor;   ///< a row without a factor counts as it is, if the StraightLine is wide
    bool added = false;  ///< rather than subtracted; only if it is wide
  };
  Place target, start, start_scale, scale;
  bool reciprocal = false;  ///< only of width 1  ///< only of width 1
  std::vector<Product> products;
};

/// Sums of products at fixed places, compiled into machine code without loops or branches: what a sparse factorization does with numbers
/// does not change from one refactorization to the next. Rows that were computed or read last are kept in registers.
class StraightLine {
 public:
  /// Row k of an array begins at its number stride * k + offset.
  struct RowLayout {
    int stride, offset;
  };
  using RowLayouts = std::array<RowLayout, kCodeArrays>;
  using Arrays = std::array<const double*, kCodeArrays>;

  /// More products than this never fit into half a megabyte of code: each takes four bytes at least.
  static constexpr std::size_t kMostProducts = std::size_t{128} * 1024;

  virtual ~StraightLine() = default;

  /// @param width of rows: 1, 4 or 8; they lie one behind the other. Null where that cannot be: other processors than x86-64 with AVX2 and
  /// FMA, a system that lets no program write code, or more than half a megabyte of it, which loops would beat.
  static std::unique_ptr<StraightLine> compile(const std::vector<Sum>& sums, int width);
  /// @param layouts where rows lie. @param most_bytes of code, by a generous estimate.
  static std::unique_ptr<StraightLine> compile(const std::vector<Sum>& sums, int width, const RowLayouts& layouts, std::size_t most_bytes);

  /// @param arrays their first numbers; those that targets lie in are written to.
  virtual void run(const Arrays& arrays) const = 0;
};

/// The same sums for rows of every width, each compiled when it is first asked for.
class LazyStraightLine {
 public:
  /// @param allowed false to have none, so that loops do the work.
  explicit LazyStraightLine(bool allowed = true) : allowed_(allowed) {}

  /// @param sums () -> std::vector<Sum>, the same at every call.
  template <class Sums>
  const StraightLine* get(const Sums& sums, int width) {
    Compiled& compiled = compiled_[static_cast<std::size_t>(width / 4)];
    if (allowed_ && !compiled.tried) compiled = {true, StraightLine::compile(sums(), width)};
    return compiled.code.get();
  }

 private:
  struct Compiled {
    bool tried = false;
    std::unique_ptr<StraightLine> code;
  };

  bool allowed_;
  std::array<Compiled, 3> compiled_;  ///< of widths 1, 4 and 8
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CODEGEN_STRAIGHT_LINE_H_
