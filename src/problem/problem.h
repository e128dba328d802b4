// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_PROBLEM_PROBLEM_H_
#define MECHANISM_CODESIGN_PROBLEM_PROBLEM_H_

#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "assembly/make_system.h"
#include "description/robot.h"
#include "description/study.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// Parameter values that replace what model and study say, in the order given: `crank_length=0.07`.
using ParameterSettings = std::vector<std::pair<std::string, double>>;

/// A mechanism and a study, read and compiled: all that the command line and the ROS nodes work on.
struct Problem {
  SourceText urdf;
  std::vector<SourceText> overlays;
  SourceText study_text;  ///< empty where there is none
  RobotDescription robot;
  Study study;
  std::shared_ptr<const CompiledSystem> system;
  double setup_seconds = 0.0;  ///< of processor time, from the texts to `system`
  Warnings warnings;           ///< of the files and of the mechanism they make

  /// All named parameters (Study::parameters order) at their defaults, the tuned ones at their start.
  std::vector<double> parameters() const;

  /// rho at the start, in the order of Study::tuned.
  Eigen::VectorXd start() const;

  /// All named parameters, the tuned ones at `rho` (order of Study::tuned), the others at their defaults.
  std::vector<double> parameters(const Eigen::VectorXd& rho) const;

  /// Names of the tuned parameters, in the order of rho.
  std::vector<std::string> tuned_names() const;
};

/// Replaces parameter values by `settings` and compiles the equations of motion anew, for what model and study now say.
/// @throws InputError for a setting of an unknown parameter or one outside the parameter's bounds, and as make_system() does.
Problem compile(Problem problem, const ParameterSettings& settings);

/// Reads model, overlays and study, replaces parameter values by `settings` and compiles the equations of motion.
/// A setting of a tuned parameter moves its start.
/// @param loader reads trajectories that the study names in a bag; without one they are refused.
/// @throws InputError for bad input, a setting of an unknown parameter, or one outside the parameter's bounds.
Problem load_problem(const SourceText& urdf, const std::vector<SourceText>& overlays, const SourceText& study,
                     const ParameterSettings& settings = {}, const TrajectoryLoader& loader = {});

/// @throws InputError if the study has no objective, so that there is nothing to evaluate, differentiate or optimize.
void require_objective(const Study& study);

/// The mechanism alone: no parameter is tuned, nothing is controlled, and Study::duration is zero.
Problem load_mechanism(const SourceText& urdf, const std::vector<SourceText>& overlays, const ParameterSettings& settings = {});

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_PROBLEM_PROBLEM_H_
