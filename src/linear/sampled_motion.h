// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "control/control_clock.h"
#include "linear/linear_motion.h"
#include "linear/state_space.h"

namespace codesign {

/// The events of sampled controllers in one period of all of them, theory (68).
struct SamplePattern {
  struct Instant {
    double time = 0.0;  ///< [s], from 0 to below the period
    std::vector<ControlEvent> events;
  };
  double period = 0.0;  ///< [s] least common multiple of the sample times; 0: nothing is sampled
  std::vector<Instant> instants;
  std::vector<int> samples;  ///< per controller: its samples in a period; 0: continuous
};

/// The number of a sample long after the start, a multiple of the queue's length, above every
/// number of a sample that still waits.
std::int64_t first_sample(const ControlRealization& realization);

/// The pattern long after the start, when delayed outputs are in effect.
/// @throws InputError for sample times whose common period has more than 10000 samples of one.
SamplePattern sample_pattern(const MotionStudy& study);

/// The motion from one period to the next, from just before its first samples: exact, by matrix
/// exponentials between instants and the derivatives of the samples at them. Queues of delayed
/// outputs are counted from the next sample on. Outputs are those at the begin of a period.
StateSpace sampled_motion(LinearMotion* motion, const SamplePattern& pattern);

/// The loop that is opened at the output of a sampled controller: inputs w are added to each new
/// output, outputs y are those that the controller computes, one each per sample in the period.
/// x(k+1) = A x(k) + B w(k), y(k) = C x(k) + D w(k), with D strictly lower triangular.
StateSpace sampled_loop(LinearMotion* motion, const SamplePattern& pattern, int controller);

/// The pieces of a period for a loop that is opened where it flows.
/// @param states number of states x. @param jump events at one instant -> the states s behind them
/// by [x | w].
PeriodPieces period_pieces(
    const System& system, Eigen::Index motions, Eigen::Index states, const SamplePattern& pattern,
    const std::function<Eigen::MatrixXcd(const std::vector<ControlEvent>&)>& jump);

}  // namespace codesign
