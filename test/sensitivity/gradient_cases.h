// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "assembly/make_system.h"
#include "benchmark/mechanisms.h"
#include "cases/shipped.h"
#include "description/solver_names.h"
#include "description/study.h"
#include "integration/servo.h"
#include "sensitivity/gradient_engine.h"

namespace codesign {

/// A mechanism and a study that has a gradient.
struct GradientCase {
  std::string name;
  RobotDescription robot;
  Study study;

  std::shared_ptr<const CompiledSystem> compile(const std::string& method,
                                                const std::string& gradient) const;
  GradientCase(std::string name, RobotDescription robot, Study study);
  ~GradientCase();
  GradientCase(const GradientCase&);
  GradientCase(GradientCase&&) noexcept;
};

GradientCase from_texts(const std::string& name, const std::string& urdf, const std::string& study);

GradientCase shipped_case(const std::string& name, double duration);

/// A parallelogram with three redundant constraints, whose multipliers are determined by
/// compliance.
GradientCase four_bar_case();

std::vector<GradientCase> gradient_cases();

/// One gradient, with its objective.
struct GradientRun {
  Status status;
  double objective = 0.0;
  Eigen::VectorXd gradient;
  std::int64_t steps = 0;
};

GradientRun run_gradient(GradientEngine* engine, const CompiledSystem& system,
                         const std::vector<double>& parameters, bool with_gradient = true);

}  // namespace codesign
