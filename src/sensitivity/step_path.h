// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_STEP_PATH_H_
#define MECHANISM_CODESIGN_SENSITIVITY_STEP_PATH_H_

#include <vector>

#include "system/state.h"

namespace codesign {

/// What a Rosenbrock step is taken up from: where the last one ended, before its projection, and to which turns angles belong there.
struct PathPoint {
  State<double> state;
  std::vector<std::vector<double>> turns;  ///< Equations::turn_references()
};

/// The points that an integration passed, to go back along them. Keeps its memory from run to run.
///
/// Of a path with more points than there is room for only every second is kept, then every fourth, and so on. Whoever goes back makes
/// those between once more and keeps as many of them as there is room for, beside what lies before.
class StepPath {
 public:
  /// @param most points of an integration that are kept; as many again as are made once more. 0: what fits into 32 MB.
  explicit StepPath(const Layout& layout, int most = 0);

  void clear();
  /// @param h size of the step [s] that ended here; 0 for the start.
  void append(double h, const State<double>& state, const std::vector<std::vector<double>>& turns);

  int size() const { return static_cast<int>(sizes_.size()); }
  /// Size [s] of the step that ended at point k.
  double step_size(int k) const { return sizes_[static_cast<std::size_t>(k)]; }

  /// The last point up to k that was kept.
  int kept_before(int k) const;
  /// @param k a point that was kept. @param point its state is of the layout's sizes.
  void point(int k, PathPoint* point) const;

  /// Forgets what lies behind point `from` of a path that is not kept as a whole. Returns how far apart points from there to `to` can be
  /// kept.
  int make_room(int from, int to);
  /// Keeps a point that was made once more, behind all that are kept.
  void keep(int k, const PathPoint& point);

 private:
  struct Kept {
    int k = 0;
    std::vector<double> numbers;  ///< t, q, v, s, z
    std::vector<std::vector<double>> turns;
  };

  void push(int k, const State<double>& state, const std::vector<std::vector<double>>& turns);
  void thin_out();

  std::size_t most_;
  std::vector<double> sizes_;  ///< of all steps
  std::vector<Kept> kept_;     ///< ascending; those behind the first `count_` are memory to be used again
  std::size_t count_ = 0;
  int stride_ = 1;  ///< of the points of the integration that are kept
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_STEP_PATH_H_
