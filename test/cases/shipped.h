// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "assembly/count_equations.h"
#include "assembly/make_system.h"
#include "description/study.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/simulation.h"
#include "paths.h"
#include "problem/load_problem.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "sensitivity/gradient_check.h"

namespace codesign {

/// A shipped case: urdf/NAME.urdf with config/NAME.yaml.
struct Shipped {
  /// @param overlay a name in urdf/overlays, or nothing: then the case's own, if there is one.
  explicit Shipped(const std::string& name, const std::string& overlay = "");
  ~Shipped();
  Shipped(const Shipped&);

  std::vector<double> parameters() const;
  Eigen::VectorXd start() const;

  RobotDescription robot;
  Study study;
};

/// A shipped case as a problem. @param changes texts of its study, each with its replacement.
Problem shipped_problem(const std::string& name,
                        const std::vector<std::pair<std::string, std::string>>& changes,
                        const ParameterSettings& settings = {});

/// Counts of the paper's table.
void expect_counts(const Shipped& shipped, const std::vector<int>& table);

/// Objective and gradient within relative tolerances of those given.
void expect_reference(const Shipped& shipped, double objective, double tolerance,
                      const std::vector<double>& gradient, double gradient_tolerance);

/// A signal at a quarter, half, three quarters and all of the study's duration, and its range over
/// the whole run.
struct SignalPoints {
  std::string signal;
  std::vector<double> values;
  double range;
};

/// Every signal within 1e-5 of its range.
void expect_series(const Shipped& shipped, const std::vector<SignalPoints>& expected);

}  // namespace codesign
