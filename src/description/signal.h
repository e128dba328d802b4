// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/error.h"

namespace codesign {

/// One term of a signal: `+ crank_joint/velocity`, `- plate/position/x`.
struct SignalTerm {
  double factor = 1.0;    ///< +1 or -1
  std::string object;     ///< name of a joint, loop, link or controller
  std::string quantity;   ///< position, velocity, effort, friction, ...; the list is in doc/study.md
  std::string component;  ///< x, y, z (of a link's orientation also w), or empty for scalar quantities
};

/// A sum or difference of named signals, see doc/study.md.
struct SignalDescription {
  std::string text;
  std::vector<SignalTerm> terms;
  SourceLocation where;
};

/// Splits `a/position/x - b/position/x` into terms. Names are not checked here; see check_signal().
/// @throws InputError if the text does not have the form of a signal.
SignalDescription parse_signal(const std::string& text, const SourceLocation& where, const std::string& element);

}  // namespace codesign
