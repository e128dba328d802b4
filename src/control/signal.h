// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "description/expression.h"
#include "description/signal_table.h"
#include "mechanism/topology.h"
#include "mechanism_codesign/parameter.h"

namespace codesign {

struct ControllerDescription;
struct RobotDescription;
struct SignalDescription;

/// One term of a signal with its names resolved to indices.
/// The coordinate is that of a joint.
struct SignalReference : CoordinateIndex {
  double factor = 1.0;
  SignalKind kind = SignalKind::kJointPosition;
  int link = -1;  ///< index of a link
  int axis = 0;   ///< component of a vector (x, y, z) or a quaternion (w, x, y, z), from 0
  /// link in whose axes a vector is told; -1: the root's, and of a reaction those of the joint
  /// frame that the child carries
  int axes = -1;
  int controller = -1;  ///< index of a controller
  /// index of an element between links, in the list of its kind, LinkElement::index
  int link_element = -1;
};

/// An expression of signals with its names resolved.
struct ResolvedFormula {
  struct Variable {
    int term = -1;                                ///< index among the terms of the signal; or
    std::shared_ptr<const Expression> parameter;  ///< a parameter; neither: the time t
  };
  ExpressionSteps steps;
  std::vector<Variable> variables;
  std::string text;  ///< of the steps, as the user wrote it
};

/// A sum of resolved terms, or an expression of them.
struct Signal : std::vector<SignalReference> {
  using std::vector<SignalReference>::vector;
  std::shared_ptr<const ResolvedFormula> formula;  ///< null: the sum
  /// The time derivative of the formula; the terms are followed by as many, their derivatives.
  bool is_rate = false;
};

/// Whether a signal contains the time t.
bool reads_time(const Signal& signal);

/// Resolves the names of a signal. @param parameters that an expression may contain.
/// @throws InputError for unknown names and for quantities that cannot be read.
Signal resolve_signal(const SignalDescription& signal, const RobotDescription& robot,
                      const Topology& topology,
                      const std::vector<ControllerDescription>& controllers,
                      const std::vector<Parameter>& parameters = {});

/// The time derivative of a resolved signal; std::nullopt if the derivative of a term is not
/// available.
std::optional<Signal> differentiate(const Signal& resolved);

/// As above, with an error. @param signal, element for messages.
/// @throws InputError for a quantity whose derivative is not available.
Signal differentiate(const Signal& resolved, const SignalDescription& signal,
                     const std::string& element);

}  // namespace codesign
