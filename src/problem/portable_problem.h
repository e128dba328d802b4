// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/reference.h"
#include "problem/load_problem.h"

namespace codesign {

/// All data that another process needs to compile the same problem on a machine without its files.
struct PortableProblem {
  SourceText urdf;
  std::vector<SourceText> overlays;
  SourceText study;
  std::vector<LoadedTrajectory> trajectories;
  std::vector<LoadedFile> files;
  std::vector<double> values;      ///< start values of all named parameters
  std::vector<std::string> tuned;  ///< names of the tuned parameters
};

/// @param problem as loaded, or with other tuned parameters or start values; other changes of its study are not included.
PortableProblem make_portable(const Problem& problem);

/// The same problem, with the same order of its systems. @throws InputError as load_problem().
Problem load_portable(const PortableProblem& portable);

}  // namespace codesign
