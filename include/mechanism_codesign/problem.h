// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_PROBLEM_H_
#define MECHANISM_CODESIGN_PROBLEM_H_

#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanism_codesign/optimizer_options.h"
#include "mechanism_codesign/parameter.h"
#include "mechanism_codesign/source_text.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

// Internal types: the library's own code reads them, a caller passes them on.
class CompiledSystem;
struct RobotDescription;
struct Study;

/// Parameter values that replace those of model and study, in the order given: `crank_length=0.07`.
using ParameterSettings = std::vector<std::pair<std::string, double>>;

/// A mechanism and a study, read and compiled: the input of simulations, gradients and optimizations. Immutable, thread-safe, and cheap to
/// copy: copies share their contents.
class Problem {
 public:
  struct Contents;
  explicit Problem(std::shared_ptr<const Contents> contents) : contents_(std::move(contents)) {}

  const SourceText& urdf() const;
  const std::vector<SourceText>& overlays() const;
  const SourceText& study_text() const;  ///< empty where there is none
  /// Warnings of the files and of the mechanism.
  const Warnings& warnings() const;
  /// Processor time from the texts to the compiled system [s].
  double setup_seconds() const;

  /// [s]
  double duration() const;
  /// Every named parameter with its start value and bounds: the model's in their order, then the study's own.
  const std::vector<Parameter>& all_parameters() const;
  /// Values of all named parameters at the start.
  std::vector<double> parameters() const;
  /// Values of all named parameters with the tuned ones at `rho`.
  std::vector<double> parameters(const Eigen::VectorXd& rho) const;
  /// Names of the tuned parameters, in the order of rho.
  std::vector<std::string> tuned_names() const;
  /// The tuned parameters at the start.
  Eigen::VectorXd start() const;
  /// The study's block `optimizer:`.
  const OptimizerOptions& optimizer_options() const;

  const RobotDescription& robot() const;
  const Study& study() const;
  const std::shared_ptr<const CompiledSystem>& system() const;

 private:
  std::shared_ptr<const Contents> contents_;
};

/// Reads model, overlays and study, replaces parameter values by `settings` and compiles the equations of motion. A setting of a tuned
/// parameter moves its start.
/// @throws InputError for bad input, a setting of an unknown parameter, or a value outside the parameter's bounds.
Problem load_problem(const SourceText& urdf, const std::vector<SourceText>& overlays, const SourceText& study,
                     const ParameterSettings& settings = {});

/// Loads the mechanism alone: no parameter is tuned, nothing is controlled, and the duration is zero. @throws InputError as load_problem().
Problem load_mechanism(const SourceText& urdf, const std::vector<SourceText>& overlays, const ParameterSettings& settings = {});

/// The problem compiled anew with parameter values replaced by `settings`. @throws InputError as load_problem().
Problem with_settings(const Problem& problem, const ParameterSettings& settings);

/// @throws InputError if the study has no objective, so that there is nothing to evaluate, differentiate or optimize.
void require_objective(const Problem& problem);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_PROBLEM_H_
