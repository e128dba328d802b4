// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "problem/load_problem.h"

namespace codesign {

/// "run \"loaded\", sample 3", for messages; empty for the study's own run. @param run its name;
/// empty if the study has none.
/// @param sample from 0; -1: the nominal values.
std::string scenario_name(const std::string& run, int sample);

/// One run at one sample of the uncertain quantities. A design is evaluated on every scenario.
struct Scenario {
  std::string run;  ///< name of the run; empty if the study has none
  int sample = -1;  ///< number of the sample from 0; -1: the nominal values
  double weight = 1.0;
  /// the law of all joints if the study varies it; empty: the laws of the model
  std::string friction_law;
  std::shared_ptr<const CompiledSystem> system;
  /// values of parameters (index in Study::parameters) that differ from their start values
  std::vector<std::pair<int, double>> values;
  /// What an ensemble of several scenarios takes for psi: (psi - offset) / scale.
  double offset = 0.0, scale = 1.0;
  /// Whether an earlier scenario has the same motion, so that its bounds on signals are these.
  bool repeats_bounds = false;

  /// Values of all named parameters at a design.
  std::vector<double> parameters(const Eigen::VectorXd& rho) const;
  std::string name() const { return scenario_name(run, sample); }
};

/// The scenarios of a problem, weights with sum 1: each run at each sample. Without `runs` and
/// `uncertain` the one scenario is the study's own run. All runs share the same samples, which for
/// kWorst end with the corners().
std::vector<Scenario> make_scenarios(const Problem& problem);

/// Each run at `count` fresh samples, to validate a design: the seed differs from the study's.
std::vector<Scenario> make_validation_scenarios(const Problem& problem, int count);

}  // namespace codesign
