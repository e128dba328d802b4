// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_IDENTIFICATION_SEGMENT_FIT_H_
#define MECHANISM_CODESIGN_IDENTIFICATION_SEGMENT_FIT_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identification/segment_run.h"

namespace codesign {

/// A segment of a recording.
struct Segment {
  SegmentBegin begin;
  std::vector<double> times;  ///< of its samples [s] on the system's clock; the first is begin.time
  Eigen::MatrixXd recorded;   ///< times x outputs; efforts as they were recorded at these times
  Eigen::VectorXd start;      ///< its start as measured
};

/// All that the start of a segment is fitted with, at one x.
struct SegmentProblem {
  const SegmentSystem& of;
  const FitVariables& variables;
  const std::vector<std::optional<RecordedEffort>>& efforts;  ///< per output, for those that are efforts
  const Segment& segment;
  const Eigen::VectorXd& x;
  const Eigen::VectorXd& spreads;
  const LossOptions& loss;
};

/// What is to be found out about a segment.
enum class SegmentWork {
  kElimination,  ///< at one start, by one run with all derivatives: how residuals and the start follow x
  kBetterStart,  ///< a better start, by a few runs with the derivatives by the start alone
  kBestStart     ///< the start with which the segment fits best, by such runs
};

/// A segment with its start.
struct SegmentSolution {
  Status status;
  Eigen::VectorXd start;
  double value = 0.0;          ///< sum of rho(r / s)
  double promise = 0.0;        ///< by how much the best start would lower it, to first order; 0 for what a simulation does not resolve
  Eigen::MatrixXd residuals;   ///< computed minus recorded, times x outputs
  Eigen::VectorXd correction;  ///< what is still to be taken off the start, to first order
  // Of kElimination alone.
  Eigen::MatrixXd jacobian;      ///< of these residuals by x, with the start that follows x: (times outputs) x variables, output 0 first
  Eigen::MatrixXd slope;         ///< of minus the best start by x
  int runs = 0, whole_runs = 0;  ///< simulations; those of them with all derivatives
};

/// Eliminates the start of a segment, or finds the best one by Levenberg-Marquardt; doc/theory.md (42).
/// @param guesses starts to begin with; the first one from which the segment can be simulated counts. At least one.
SegmentSolution fit_segment(const SegmentProblem& problem, const std::vector<Eigen::VectorXd>& guesses, SegmentWork work, SegmentRun* run);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_IDENTIFICATION_SEGMENT_FIT_H_
