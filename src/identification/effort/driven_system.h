// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assembly/driven_motion.h"
#include "description/study.h"
#include "mechanism_codesign/error.h"
#include "mechanism_codesign/status.h"
#include "system/state.h"

namespace codesign {

class CompiledSystem;

/// A joint whose motion was measured.
struct MeasuredJoint {
  std::string name;
  bool with_effort = false;  ///< its effort was measured, too, or is known to be zero
  /// standard deviation of its measured position [rad or m]; only the ratios between joints count,
  /// theory (28a)
  double deviation = 1.0;
  SourceLocation where;  ///< where the joint is named, for messages
};

/// @param of the mechanism as make_system() compiled it; its redundant reactions are shared as in
/// that system.
/// @param positions measured positions, one column per instant, at which the rank of the loops is
/// examined if the rank at the study's start is an exception, as in a stretched-out linkage; may
/// have no columns.
/// @throws InputError for unknown or repeated joints and joints without one coordinate, for a joint
/// whose motion the measured joints do not determine, for more joints with an effort than degrees
/// of freedom, for friction laws with states, for loads that read a set-point, and for signals that
/// cannot be resolved without controllers.
/// @param signals that the system watches
DrivenSystem make_driven_system(const CompiledSystem& of,
                                const std::vector<MeasuredJoint>& measured,
                                const Eigen::MatrixXd& positions = {},
                                const std::vector<SignalDescription>& signals = {});

/// A signal whose values are compared with a recording, as a study watches it.
WatchedSignal compared_signal(const SignalDescription& signal, double duration);

/// A fault of make_driven_system() in the words of a study that names the joints itself, in place
/// of recordings. @param element where it names them. @param undetermined, allowed message and
/// remedy for a joint whose motion the named ones do not determine.
InputFault in_words_of_study(InputFault fault, const std::string& element,
                             const std::string& undetermined, const std::string& allowed);

/// @throws InputError for loads that depend on the time; `reason` says why there is none.
void refuse_loads_of_time(const CompiledSystem& system, const std::string& reason);

/// The measured joints that determine the motion of the mechanism, as make_driven_system() chooses
/// drives, but for joints whose motion the study gives; then the motors behind elastic gears, which
/// move by themselves. Friction laws with states are allowed. @throws InputError as
/// make_driven_system() otherwise does
std::vector<std::string> independent_joints(const CompiledSystem& of,
                                            std::vector<MeasuredJoint> measured,
                                            const Eigen::MatrixXd& positions = {});

/// A position of the mechanism from which the first instant of a recording is assembled: all
/// measured joints are near `positions` [rad or m, order of `measured`], the drives exactly at
/// them.
/// @param of, measured as in make_driven_system(). @param driven its result. @param parameters all
/// named parameters. @param state of driven.system; velocities, accelerations and multipliers are
/// zero.
Status assemble_driven(const CompiledSystem& of, const std::vector<MeasuredJoint>& measured,
                       const DrivenSystem& driven, const std::vector<double>& parameters,
                       const Eigen::VectorXd& positions, State<double>* state);

}  // namespace codesign
