// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "integration/tableau.h"
#include "math/arrays.h"
#include "system/state.h"

namespace codesign {

/// The ends of the steps of an integration, for the backward pass of the adjoint. clear() keeps the
/// memory for the next run.
///
/// If the path has more points than `most`, only every second point is stored, then every fourth,
/// and so on. The backward pass repeats the steps between stored points; it stores their ends with
/// make_room() and keep(), as far as memory allows.
class StepPath {
 public:
  /// @param most largest number of stored points of an integration; there is room for as many
  /// repeated points. 0: what fits into 32 MB.
  explicit StepPath(const Layout& layout, int most = 0);

  void clear();
  /// Appends the end of a step of size h [s]; h = 0 for the start. @param tableau the method of the
  /// step. @param next where the next step begins [s]: the time of `state`, but that behind a break
  /// time where the step has ended a rounding before it.
  void append(double h, const RosenbrockTableau& tableau, const State<double>& state, double next);

  int size() const { return static_cast<int>(sizes_.size()); }
  /// Size [s] of the step that ended at point k.
  double step_size(int k) const { return sizes_[to_index(k)]; }

  /// Where the step begins that follows point k [s].
  double next_start(int k) const { return starts_[to_index(k)]; }
  /// The method of the step that ended at point k.
  const RosenbrockTableau& tableau(int k) const { return *tableaus_[to_index(k)]; }

  /// Index of the last stored point that is not after k.
  int kept_before(int k) const;
  /// Reads a stored point k. @param point must have the sizes of the layout.
  void point(int k, State<double>* point) const;

  /// Discards the stored points after `from`, unless the whole path is stored. @returns the spacing
  /// at which the points between `from` and `to` can be stored.
  int make_room(int from, int to);
  /// Stores the repeated point k, which must be after all stored points.
  void keep(int k, const State<double>& point);

 private:
  struct Kept {
    int k = 0;
    std::vector<double> numbers;  ///< t, q, v, s, z
    std::vector<double> turns;
  };

  void grow(const State<double>& state);
  void push(int k, const State<double>& state);
  void thin_out();

  std::size_t most_;
  std::vector<double> sizes_;   ///< sizes of all steps [s]
  std::vector<double> starts_;  ///< where the steps behind them begin [s]
  std::vector<const RosenbrockTableau*> tableaus_;
  /// the stored points, ascending, in the first `count_` entries; the others are spare memory
  std::vector<Kept> kept_;
  std::size_t count_ = 0;
  int stride_ = 1;  ///< every stride-th point of the integration is stored
};

}  // namespace codesign
