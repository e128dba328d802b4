// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_ARGUMENTS_H_
#define MECHANISM_CODESIGN_CLI_ARGUMENTS_H_

#include <stdexcept>
#include <string>
#include <vector>

#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"

namespace codesign::cli {

/// A command line that makes no sense, as a sentence.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `codesign COMMAND MODEL [STUDY] [OPTIONS]`, taken apart.
struct Arguments {
  std::string command;  ///< check, urdf, simulate, gradient, optimize or help
  std::string model;
  std::string study;  ///< empty: none given
  std::vector<std::string> overlays;
  ParameterSettings settings;
  bool json = false;
  std::vector<std::string> signals;  ///< simulate
  std::string csv;                   ///< simulate; empty: standard output
  int samples = 101;                 ///< simulate
  bool verify = false;               ///< gradient
  CheckMethod method = CheckMethod::kComplexStep;
  std::string output;  ///< optimize; empty: no files
};

/// @param words the command line without the program's name.
/// @throws UsageError naming the word and, of a misspelt one, the nearest known.
Arguments parse_arguments(const std::vector<std::string>& words);

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_ARGUMENTS_H_
