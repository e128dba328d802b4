// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "integration/mechanisms.h"

namespace codesign {

/// A compiled model and study, with the objects to start one design.
struct Compiled {
  CompiledSystem system;
  Equations<double> equations;
  Assembly assembly;
  State<double> state;

  /// @param sharing of redundant constraints, see CompiledSystem; planar loops need some, or at
  /// least compliance.
  Compiled(const std::string& urdf, const std::string& study, const ReactionSharing& sharing = {});
  Compiled(const RobotDescription& robot, const std::string& study, const ReactionSharing& sharing);
  ~Compiled();

  /// Assembles the start of a design.
  Status start(const std::vector<double>& parameters);
  Status start();
};

/// A study that only sets the mechanism going.
std::string let_go(const std::string& initial, const std::string& signal,
                   const std::string& more = "");

}  // namespace codesign
