// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "description/ensemble.h"
#include "description/excitation.h"
#include "description/identification.h"
#include "description/initial_gains.h"
#include "description/motion_study.h"
#include "description/posture_grid.h"
#include "mechanism_codesign/optimizer_options.h"

namespace codesign {

/// A constraint among parameters, margin(parameters) >= 0, or = 0.
struct ParameterConstraint {
  std::string text;  ///< as written
  std::shared_ptr<const Expression> margin;
  bool is_equality = false;
  SourceLocation where;
  std::string element;  ///< its place in the study, for messages: `constraints[0]`
};

/// Numbers among which those of some tuned parameters are chosen together: `choice` or `integer` of
/// `parameters:`.
struct ParameterChoice {
  std::string name;                       ///< of the parameter, or of a list with several
  std::vector<int> parameters;            ///< indices in Study::parameters
  std::vector<std::vector<double>> rows;  ///< at least two, each with one value per parameter
  std::vector<std::string> labels;        ///< of the rows; empty: they have none
  std::string element;
  SourceLocation where;
};

struct Study;

/// One of the objectives of `tradeoff:`.
struct TradeoffObjective {
  std::string name;
  /// the study with this objective, as read; Study::parameters and Study::tuned of the whole one
  /// count
  std::shared_ptr<const Study> study;
  SourceLocation where;
};

/// A study as its file describes it: the simulations and optimizations of a mechanism.
struct Study : MotionStudy {
  // Defined in one file: the members of all lists would else be compiled wherever one is copied or
  // destroyed.
  Study();
  Study(const Study&);
  Study(Study&&) noexcept;
  Study& operator=(const Study&);
  Study& operator=(Study&&) noexcept;
  ~Study();

  std::vector<ParameterConstraint> constraints;
  std::vector<ParameterChoice> choices;
  OptimizerOptions optimizer;
  EnsembleDescription ensemble;
  std::vector<TradeoffObjective> tradeoff;  ///< two or three; empty: none
  std::optional<IdentificationDescription> identification;
  std::optional<ExcitationDescription> excitation;
  /// Whether the study says how the model's base stands, `base`.
  bool base_is_given = false;
  std::vector<InitialGains> initial_gains;
  PostureGrid grid;                     ///< `efforts.grid`; empty without it
  std::vector<HardwareGains> hardware;  ///< in the order written
};

}  // namespace codesign
