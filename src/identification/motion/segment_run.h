// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <vector>

#include "identification/motion/segment_system.h"
#include "integration/rosenbrock_integrator.h"
#include "sensitivity/lane_directions.h"
#include "sensitivity/tangent_step.h"

namespace codesign {

/// Time and position at which a segment begins.
struct SegmentBegin {
  double time = 0.0;      ///< [s] on the system's clock
  VectorX<double> theta;  ///< tree coordinates near the start, from which loops are closed
};

/// The tuned parameters of a SegmentSystem by which a run has derivatives.
enum class SegmentLanes { kNone, kStart, kAll };

/// The simulated outputs of one segment and their exact derivatives by all tuned parameters of a
/// SegmentSystem, start included; doc/theory.md (41). A workspace: not thread-safe. Results do not
/// depend on earlier runs, to the last bit.
class SegmentRun {
 public:
  /// @param of must outlive this. @param first the first segment; pivots are chosen near its start.
  SegmentRun(const SegmentSystem& of, const SegmentBegin& first);

  /// Integrates from begin.time to the last of `times`. @param parameters all parameters of the
  /// system. @param times [s] on the system's clock, ascending, none before begin.time. @param
  /// lanes of the derivatives; the values do not depend on them, to the last bit
  Status run(const std::vector<double>& parameters, const SegmentBegin& begin,
             const std::vector<double>& times, SegmentLanes lanes = SegmentLanes::kAll);
  /// times x outputs, of the last run
  const Eigen::MatrixXd& values() const { return values_; }
  /// (times outputs) x tuned parameters, the rows of output 0 first; the last columns are the
  /// derivatives by the start. Columns outside the lanes of the last run have no valid values.
  const Eigen::MatrixXd& slopes() const { return slopes_; }
  void obey(const std::atomic<bool>* cancel) { integrator_.obey(cancel); }
  /// Steps of all runs so far, rejected ones included.
  std::int64_t steps() const { return steps_; }

 private:
  template <int N>
  struct Group {
    Group(const CompiledSystem& system, LaneRange<N> lanes, const RosenbrockTableau& tableau)
        : range(lanes), step(system, tableau) {}
    LaneRange<N> range;
    TangentStep<N> step;
    Directions<N> outputs;  ///< derivatives at a sample, one column per output
  };

  template <class Action>
  void for_each_group(const Action& action) {
    groups_.for_each([&](auto* group) {
      if (group->range.first + group->range.count > first_lane_) action(group);
    });
  }
  void choose(SegmentLanes lanes);
  Status start(const std::vector<double>& parameters, const SegmentBegin& begin);
  bool are_finite(SegmentLanes lanes) const;
  /// Takes one step with its derivatives.
  Status advance(double limit);
  Status sample(double time, Eigen::Index row);

  const CompiledSystem& system_;
  const int starts_;
  RosenbrockIntegrator integrator_;
  LaneGroups<Group> groups_;
  RosenbrockIntegrator::BeforeAccept stages_;
  int first_lane_ = 0;        ///< groups of lanes that lie entirely before it are not computed
  bool reads_rates_ = false;  ///< whether an output depends on accelerations or reactions
  State<double> state_;
  SparseGradient<double> sparse_;
  Eigen::MatrixXd values_, slopes_;
  std::int64_t steps_ = 0;
};

}  // namespace codesign
