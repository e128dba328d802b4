// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_LIMIT_WATCH_H_
#define MECHANISM_CODESIGN_CLI_LIMIT_WATCH_H_

#include <string>
#include <vector>

#include "mechanism_codesign/frame.h"
#include "problem/load_problem.h"

namespace codesign::cli {

/// A joint beyond one of URDF's limits.
struct LimitCrossing {
  std::string joint;
  std::string limit;   ///< lower, upper, velocity or effort
  double bound = 0.0;  ///< what the file says; of velocity and effort the magnitude
  double worst = 0.0;  ///< the value farthest beyond it
  double time = 0.0;   ///< first seen [s]
};

/// Watches a run for joints beyond their `<limit>`. Velocities are only ever reported; positions and efforts where the study does not
/// enforce them. Beyond is what the solver's tolerances cannot explain: more than absolute_tolerance + relative_tolerance * |bound|.
class LimitWatch {
 public:
  LimitWatch(const Problem& problem, const std::vector<double>& parameters, const FrameNames& names);

  void observe(const Frame& frame);
  const std::vector<LimitCrossing>& crossings() const { return crossings_; }

 private:
  struct Watched {
    std::size_t sample = 0;  ///< index into Frame::joints
    std::string joint, limit;
    double bound = 0.0;
    int crossing = -1;  ///< index into crossings_ once crossed
  };
  void note(Watched* watched, double value, bool beyond, double time);

  double absolute_margin_, relative_margin_;
  std::vector<Watched> watched_;
  std::vector<LimitCrossing> crossings_;
};

/// One sentence each, as `codesign simulate` and `check` print them.
std::string describe(const LimitCrossing& crossing);

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_LIMIT_WATCH_H_
