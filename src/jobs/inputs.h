// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "problem/load_problem.h"

namespace codesign {

/// The texts and settings of a job, from a command line or a node.
struct Inputs {
  SourceText urdf;
  std::vector<SourceText> overlays;
  SourceText study;            ///< an empty name: no study, the mechanism alone
  bool study_is_tree = false;  ///< whether the study is from the parameter server instead of a file
  SavedDesign design;          ///< of a saved result, as read_design() reads it
  ParameterSettings settings;  ///< they replace the values of `design`
};

/// Reads and compiles the inputs. @param loader reads trajectories that the study names in a bag; without one they are refused.
/// @throws InputError as load_problem().
Problem load(const Inputs& inputs, const TrajectoryLoader& loader = {});

}  // namespace codesign
