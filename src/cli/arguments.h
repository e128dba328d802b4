// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "linear/linear_study.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"

namespace codesign::cli {

/// An invalid command line. what() is a sentence for the user.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The parts of the command line `codesign COMMAND MODEL [STUDY] [OPTIONS]`. Members of options
/// name their command.
struct Arguments {
  std::string topic;  ///< help; the command that it is about, empty: all
  /// check, urdf, overlay, simulate, efforts, equilibrium, linearize, gradient, optimize, identify,
  /// tradeoff, excite, new, help or version
  std::string command;
  std::string model;  ///< path; new: of the folder to be made, empty: the machines are listed
  std::string study;  ///< path; empty: none given
  std::vector<std::string> overlays;  ///< paths, in order
  bool floating_base = false;         ///< --base floating
  std::string result;          ///< path of the result.json with the design to use; empty: none
  ParameterSettings settings;  ///< --set NAME=VALUE, in order; they replace the values of `result`
  bool json = false;
  bool quiet = false;                ///< no progress on the error stream
  bool sticks = false;               ///< urdf; with_sticks()
  bool fill = false;                 ///< urdf; write_filled_urdf()
  std::string run;                   ///< of the study's runs; empty: the study itself
  std::vector<std::string> signals;  ///< simulate, efforts, equilibrium, linearize
  /// equilibrium, linearize; what of friction about rest counts
  LinearFriction friction = LinearFriction::kOff;
  double time = -1.0;           ///< linearize; [s] of the run, negative: about the equilibrium
  std::string csv;              ///< simulate, efforts, linearize, tradeoff; empty: standard output
  int points = 0;               ///< tradeoff; 0: the default
  int samples = 101;            ///< simulate, efforts; equally spaced instants, at least 2
  bool verify = false;          ///< gradient
  bool each_parameter = false;  ///< gradient; verify each parameter, instead of a few directions
  CheckMethod method = CheckMethod::kComplexStep;
  bool evaluate = false;  ///< identify; judge the model as it stands
  std::string compare;    ///< excite; a table of a trajectory, empty: none
  std::string against;    ///< identify; an identification.json to compare with, empty: none
  std::string output;     ///< optimize, identify, excite; empty: no files
  bool resume = false;    ///< optimize; continue with the journal in `output`
  std::string from;       ///< new; the machine of the gallery
};

/// @param words the command line without the program's name.
/// @throws UsageError that names the word and, for an unknown option or command, the nearest known
/// one.
Arguments parse_arguments(const std::vector<std::string>& words);

}  // namespace codesign::cli
