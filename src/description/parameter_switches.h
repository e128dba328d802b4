// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "description/expression.h"

namespace codesign {

struct Study;

/// A part of an expression that may make the objective jump as parameters change, without a run
/// that passes the jump: floor, ceil, sign or a comparison of parameters alone, or of signals at
/// one instant. No derivative sees it; doc/theory.md (24k).
struct ParameterSwitch {
  std::string text;             ///< the part, "floor(n)"
  std::vector<int> parameters;  ///< that it reads, indices in Study::parameters; empty: signals
  /// The whole expression by all named parameters, with the time and signals at some numbers: it
  /// jumps where one of these functions does.
  std::vector<std::function<double(const std::vector<double>&)>> values{};
};

/// What a variable of an expression is.
enum class VariableKind { kParameter, kTime, kSignal };
struct ExpressionVariable {
  VariableKind kind = VariableKind::kSignal;
  int parameter = -1;  ///< index in Study::parameters
};

/// The parts of an expression that jump by parameters alone. With `at_instant` those count that
/// read the time, too, and floor, ceil and sign of signals: of an expression that is read at single
/// instants.
/// @param variable index of a variable -> what it is. @param text of the expression.
std::vector<ParameterSwitch> find_switches(const ExpressionSteps& steps, const std::string& text,
                                           const std::function<ExpressionVariable(int)>& variable,
                                           bool at_instant = false);

/// A tuned parameter by which the objective may jump.
struct ParameterJump {
  int parameter = -1;  ///< index in Study::parameters; -1: all of them, by a signal
  std::string text;    ///< the part of an expression that does
};

/// The switches of a study and its runs that jump by a tuned parameter within its bounds, or
/// without bounds within its extent of the design, the others as in the design.
std::vector<ParameterJump> find_jumps(const Study& study, const Eigen::VectorXd& rho);

}  // namespace codesign
