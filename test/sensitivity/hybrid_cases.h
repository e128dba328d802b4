// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sensitivity/gradient_cases.h"

namespace codesign {

/// A mechanism whose motion switches, is sampled or ends by itself, with a study without `solver`.
struct HybridCase {
  std::string name, urdf, study;

  /// @param solver the rest of the block, such as "method: rodas4".
  std::shared_ptr<const CompiledSystem> compile(const std::string& solver) const;
};

/// Double pendulums and parallelograms whose loads and objectives switch by times, positions and
/// speeds that depend on parameters; with kinks, sampled controllers and conditions that end the
/// run.
std::vector<HybridCase> hybrid_cases();

/// The gradient at the study's own design of a run up to its end, wherever that is.
GradientRun run_to_end(GradientEngine* engine, const CompiledSystem& system);

}  // namespace codesign
