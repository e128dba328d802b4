// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// Parameter values that replace the values in model and study, by name, such as ("crank_length",
/// 0.07). If a name occurs twice, the last entry counts.
using ParameterSettings = std::vector<std::pair<std::string, double>>;

struct ProblemContents;

/// A mechanism and a study, read and compiled: the input of simulations, gradients and
/// optimizations. Immutable, thread-safe, and cheap to copy: copies share their contents.
class Problem {
 public:
  /// The model's URDF text, its overlays in the order of their application, and the study's text
  /// (empty without a study).
  const SourceText& urdf() const;
  const std::vector<SourceText>& overlays() const;
  const SourceText& study_text() const;
  /// Warnings about the files and about the mechanism at its start; doc/warnings.md lists the
  /// codes.
  const Warnings& warnings() const;
  /// Processor time from the texts to the compiled system [s].
  double setup_seconds() const;

  /// Duration of the study [s]; 0 without a study.
  double duration() const;
  /// Every named parameter with its start value and bounds: the parameters of the model in their
  /// order, then the parameters of the study.
  const std::vector<Parameter>& all_parameters() const;
  /// Start values of all named parameters, in the order of all_parameters().
  std::vector<double> parameters() const;
  /// Values of all named parameters: the tuned ones from `rho` (order of tuned_names()), the others
  /// at their start values.
  std::vector<double> parameters(const Eigen::VectorXd& rho) const;
  /// Values of all named parameters: those of `settings`, the others at their start values.
  /// @throws InputError for an unknown name, and a value that is not finite or outside its bounds.
  std::vector<double> parameters(const ParameterSettings& settings) const;
  /// Names of the tuned parameters, in the order of rho and of every gradient.
  std::vector<std::string> tuned_names() const;
  /// The start of rho: values of the tuned parameters.
  Eigen::VectorXd start() const;
  /// The study's block `optimizer:`.
  const OptimizerOptions& optimizer_options() const;

 private:
  friend struct ProblemContents;
  explicit Problem(std::shared_ptr<const ProblemContents> contents)
      : contents_(std::move(contents)) {}

  std::shared_ptr<const ProblemContents> contents_;
};

/// Reads model, overlays and study, replaces parameter values by `settings` and compiles the
/// equations of motion. The setting of a tuned parameter replaces its start value; the setting of
/// any other parameter holds in every design.
/// @throws InputError for bad input, a mechanism without equations of motion, a start that cannot
/// be assembled, a setting of an unknown parameter, or a value that is not finite or outside the
/// parameter's bounds.
Problem load_problem(const SourceText& urdf, const std::vector<SourceText>& overlays,
                     const SourceText& study, const ParameterSettings& settings = {});

/// Loads a mechanism without a study: no parameter is tuned, there are no controllers and no loads,
/// and the duration is zero.
/// @throws InputError as load_problem().
Problem load_mechanism(const SourceText& urdf, const std::vector<SourceText>& overlays,
                       const ParameterSettings& settings = {});

/// The same problem with parameter values replaced by `settings`, compiled again. @throws
/// InputError as load_problem().
Problem with_settings(const Problem& problem, const ParameterSettings& settings);

/// Checks that the study has an objective, which evaluations, gradients and optimizations need.
/// @throws InputError if it has none.
void require_objective(const Problem& problem);

}  // namespace codesign
