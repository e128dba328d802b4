// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mechanism_codesign/problem.h"
#include "mechanism_codesign/warning.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// Below this share of a joint's effort, a fit counts as one that does not explain it.
constexpr double kExplainedHalf = 0.5;

/// A variation below this share of the recorded root mean square counts as this much: efforts, and
/// motions in segments.
constexpr double kLeastVariation = 0.1, kLeastOfSegments = 0.01;

/// The share of a recorded column that the computed one explains: one minus the sum of squares of
/// the residuals over that of the variation, which is at least `least` times that of the recorded
/// values. Negative: worse than nothing.
double explained_share(const Eigen::VectorXd& recorded, const Eigen::VectorXd& variation,
                       const Eigen::VectorXd& residuals, double least);
/// With the variation about the mean, at least kLeastVariation.
double explained_share(const Eigen::VectorXd& recorded, const Eigen::VectorXd& residuals);

/// By how much more a mended mistake must explain than the recording as it is, or than a fit.
constexpr double kClearly = 0.2;

/// What the efforts of a joint, inverse dynamics and a drive's friction and inertia, say about a
/// recorded column; doc/theory.md (39c).
struct DriveLineFit {
  double share = 0.0;  ///< explained_share() of the column, at least 0
  /// factor of the computed effort, at least 0; 0 where friction and rotor explain nearly all
  double scale = 0.0;
};

/// @param computed, velocity, acceleration of the joint. @param recorded any column at the same
/// times
DriveLineFit fit_drive_line(const Eigen::VectorXd& computed, const Eigen::VectorXd& velocity,
                            const Eigen::VectorXd& acceleration, const Eigen::VectorXd& recorded);

/// A joint whose recorded efforts contradict inverse dynamics of the model as it stands.
struct EffortDoubt {
  std::string joint;
  double share = 0.0;  ///< DriveLineFit::share of the effort as recorded
  /// what would explain it: `with the other sign`; empty if no simple mistake does
  std::string mistake;
  double mended = 0.0;  ///< share with the mistake mended
  /// whether the mistake is a unit: with one, a fit explains the recording by wrong numbers
  bool is_unit = false;
  /// the lower cutoff of the study's filter, if that leaves less than half of the recorded motion
  /// of the joint, which then says nothing about the recording [Hz]; 0: it leaves more
  double cutoff = 0.0;
  double motion_left = 1.0;  ///< share of the squares of the positions about their mean
};

/// Compares recorded efforts with inverse dynamics of the model as it stands and looks for the
/// mistake that explains a contradiction: another sign, another unit, exchanged columns, exchanged
/// or reversed joints. A unit is no mistake where other values of the numbers that are to be found
/// explain the recording. About 400 samples of each recording are used. Empty if nothing
/// contradicts, if no joint has efforts in all recordings, if the model cannot follow the recorded
/// motion, or if inverse dynamics cannot compute its efforts while residuals are in motion.
/// @param explained least share that a fit explains of a joint: orders of joints are only looked
/// for if one could explain clearly more
/// @throws InputError as identify()
std::vector<EffortDoubt> find_effort_doubts(const Problem& problem,
                                            const std::vector<JointRecording>& recordings,
                                            double explained = 0.0);

/// Warnings `recording_effort` for the doubts whose mistake is known.
Warnings warnings_of(const IdentificationDescription& options,
                     const std::vector<EffortDoubt>& doubts);

/// `with the other sign the model as it stands would explain 93 % of it`, or what the filter leaves
/// of the motion; empty without a mistake.
std::string sentence_of(const EffortDoubt& doubt);

}  // namespace codesign
