// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "identification/motion/segment_run.h"
#include "identification/motion/segment_system.h"

namespace codesign {

/// A segment of a recording.
struct Segment {
  SegmentBegin begin;
  /// times of its samples [s] on the system's clock; the first is begin.time
  std::vector<double> times;
  Eigen::MatrixXd recorded;  ///< times x outputs; efforts as they were recorded at these times
  Eigen::VectorXd start;     ///< its measured start
};

/// The data for fitting the start of a segment at one x.
struct SegmentProblem {
  const SegmentSystem& of;
  const FitVariables& variables;
  /// per output; only outputs that are efforts have one
  const std::vector<std::optional<RecordedEffort>>& efforts;
  const Segment& segment;
  const Eigen::VectorXd& x;
  const Eigen::VectorXd& spreads;
  const LossOptions& loss;
};

/// The task of fit_segment().
enum class SegmentWork {
  /// at one start, by one run with all derivatives: the derivatives of residuals and start by x
  kElimination,
  kBetterStart,  ///< a better start, by a few runs with derivatives by the start alone
  kBestStart     ///< the start with which the segment fits best, by runs of the same kind
};

/// A segment with its start.
struct SegmentSolution {
  Status status;
  Eigen::VectorXd start;
  double value = 0.0;  ///< sum of rho(r / s)
  /// decrease of the value by the best start, to first order; 0 if a simulation does not resolve it
  double predicted_decrease = 0.0;
  Eigen::MatrixXd residuals;  ///< computed minus recorded, times x outputs
  /// to be subtracted from the start for the best start, to first order
  Eigen::VectorXd correction;
  // Only for kElimination.
  /// derivatives of these residuals by x, the start following x: (times outputs) x variables,
  /// output 0 first
  Eigen::MatrixXd jacobian;
  Eigen::MatrixXd slope;  ///< derivative of minus the best start by x
  /// number of simulations, and of these the number with all derivatives
  int runs = 0, whole_runs = 0;
};

/// Eliminates the start of a segment, or finds the best one by Levenberg-Marquardt; doc/theory.md
/// (42).
/// @param guesses starts to begin with, at least one; the first one from which the segment can be
/// simulated is used.
SegmentSolution fit_segment(const SegmentProblem& problem,
                            const std::vector<Eigen::VectorXd>& guesses, SegmentWork work,
                            SegmentRun* run);

/// Cuts a recording into segments of about `segment.segment` seconds, each sample in one segment;
/// only every `filter.decimate`th sample counts. Starts are the recorded positions, filtered at
/// `filter.cutoff`, with recorded or differentiated velocities; integrals are zero. The tree
/// coordinates are empty; set_branches() sets them.
/// @param independent joints whose positions and velocities make up a start.
/// @throws InputError if a segment has fewer samples than its start has numbers.
std::vector<Segment> cut_into_segments(const JointRecording& recording, const SegmentSystem& of,
                                       const FitVariables& variables,
                                       const std::vector<std::string>& independent,
                                       const IdentificationDescription& options,
                                       Warnings* warnings);

/// Follows the recorded positions from the start of the study `usual` through the recording, so
/// that each segment of a mechanism with loops starts on the recorded branch. @param x the start of
/// the fit
Status set_branches(const JointRecording& recording, const SegmentSystem& of,
                    const CompiledSystem& usual, const FitVariables& variables,
                    const Eigen::VectorXd& x, const std::vector<std::string>& independent,
                    const std::atomic<bool>* cancel, std::vector<Segment>* segments);

}  // namespace codesign
