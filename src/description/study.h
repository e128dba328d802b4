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
  OptimizerOptions optimizer;
  EnsembleDescription ensemble;
  std::optional<IdentificationDescription> identification;
  std::optional<ExcitationDescription> excitation;
  /// Whether the study says how the model's base stands, `base`.
  bool base_is_given = false;
  std::vector<InitialGains> initial_gains;
  PostureGrid grid;                     ///< `efforts.grid`; empty without it
  std::vector<HardwareGains> hardware;  ///< in the order written
};

}  // namespace codesign
