// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/frame.h"
#include "problem/load_problem.h"

namespace codesign {

/// A limit of the URDF that a joint exceeds during a run.
struct LimitCrossing {
  std::string joint;
  std::string limit;   ///< lower, upper, velocity or effort
  double bound = 0.0;  ///< the limit in the file; velocity and effort: a magnitude [rad or m, rad/s or m/s, N m or N]
  double worst = 0.0;  ///< the value farthest beyond the limit
  double time = 0.0;   ///< time of the first sample beyond the limit [s]
};

/// Finds joints that exceed their `<limit>` during a run: velocities always, positions and efforts unless the study enforces them. A limit
/// counts as exceeded if the excess is more than absolute_tolerance + relative_tolerance * |bound| of the solver.
class LimitWatch {
 public:
  /// @param parameters all named parameters. @param names of the frames to observe.
  LimitWatch(const Problem& problem, const std::vector<double>& parameters, const FrameNames& names);

  void observe(const Frame& frame);
  const std::vector<LimitCrossing>& crossings() const { return crossings_; }

 private:
  struct Watched {
    std::size_t sample = 0;  ///< index into Frame::joints
    std::string joint, limit;
    double bound = 0.0;
    int crossing = -1;  ///< index into crossings_ once the limit was exceeded
  };
  void note(Watched* watched, double value, bool beyond, double time);

  double absolute_margin_, relative_margin_;
  std::vector<Watched> watched_;
  std::vector<LimitCrossing> crossings_;
};

/// The sentence that `codesign simulate` and `check` print for a crossing.
std::string describe(const LimitCrossing& crossing);

}  // namespace codesign
