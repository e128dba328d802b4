// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "codegen/value_program.h"
#include "math/arrays.h"

namespace codesign {

/// target = (start * start_scale - sum_i row_i * factor_i) * scale, or the reciprocal of this
/// number.
///
/// `target`, `start` and each `row` consist of `width` numbers side by side (the width of the
/// StraightLine); `start_scale`, `scale` and each `factor` are single numbers. An absent start
/// counts as 0, an absent scale as 1. The target must not be among the rows of its own sum.
struct Sum {
  struct Product {
    Place row, factor;   ///< an absent factor counts as 1; only for widths above 1
    bool added = false;  ///< the product is added instead of subtracted; only for widths above 1
  };
  Place target, start, start_scale, scale;
  bool reciprocal = false;  ///< only for width 1
  std::vector<Product> products;
};

/// The sums as they are computed: the first added product of a sum without a start is its start,
/// which saves setting the target to zero.
std::vector<Sum> with_starts(std::vector<Sum> sums);

/// Sums of products at fixed places, compiled into machine code without loops or branches. It
/// serves sparse factorizations, whose sequence of operations is the same in every refactorization.
/// Rows that are read again soon stay in registers.
class StraightLine {
 public:
  /// Row k of an array begins at index stride * k + offset [doubles].
  struct RowLayout {
    int stride, offset;
  };
  using RowLayouts = std::array<RowLayout, kCodeArrays>;
  using Arrays = std::array<const double*, kCodeArrays>;  ///< addresses, as MachineCode loads them

  /// With more products than this the code is certainly longer than half a megabyte, since each
  /// takes at least four bytes.
  static constexpr std::size_t kMostProducts = std::size_t{128} * 1024;

  virtual ~StraightLine() = default;

  /// Compiles the sums, to be computed in the given order, for rows that follow one another in
  /// memory. Returns null if the processor is not an x86-64 with AVX2 and FMA, if the system does
  /// not allow programs to make code, or if the code would take more than half a megabyte (loops
  /// are faster then).
  /// @param width numbers per row: 1, 4 or 8.
  static std::unique_ptr<StraightLine> compile(const std::vector<Sum>& sums, int width);
  /// As above, for rows with the given `layouts`.
  /// @param most_bytes null is returned if an upper estimate of the code's size exceeds this.
  static std::unique_ptr<StraightLine> compile(const std::vector<Sum>& sums, int width,
                                               const RowLayouts& layouts, std::size_t most_bytes);

  /// @param arrays the address of each array; null for arrays that no sum uses. The code writes to
  /// arrays that contain targets.
  virtual void run(const Arrays& arrays) const = 0;
};

/// One list of sums for rows of width 1, 4 and 8. Each width is compiled when it is first needed.
/// Copies share the compiled code.
class LazyStraightLine {
 public:
  /// @param allowed false: get() always returns null, so that the caller uses its loops.
  explicit LazyStraightLine(bool allowed = true) : allowed_(allowed) {}

  /// The compiled sums for rows of this width; null where StraightLine::compile() gives null.
  /// @param sums () -> std::vector<Sum>, the same at every call.
  template <class Sums>
  const StraightLine* get(const Sums& sums, int width) {
    Compiled& compiled = compiled_[to_index(width / 4)];
    if (allowed_ && !compiled.tried) compiled = {true, StraightLine::compile(sums(), width)};
    return compiled.code.get();
  }

 private:
  struct Compiled {
    bool tried = false;
    std::shared_ptr<const StraightLine> code;
  };

  bool allowed_;
  std::array<Compiled, 3> compiled_;  ///< of widths 1, 4 and 8
};

}  // namespace codesign
