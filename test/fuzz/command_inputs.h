// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fuzz/dice.h"
#include "fuzz/input.h"

namespace codesign::fuzz {

/// A valid case, from which inputs are made by changes.
struct Seed {
  std::string name, urdf, study, overlay;
  std::map<std::string, std::string> files{};  ///< recordings that the study names
  /// commands for this case beside those for all
  std::vector<std::vector<std::string>> commands{};
};

/// The shipped cases, their studies cut short so that a run takes milliseconds, and an overlay for
/// one that has none of its own; then language_seeds().
std::vector<Seed> shipped_seeds();

/// A command line made from a seed: the files, the expressions in them or the words of the command
/// are changed, once or a few times; some may write only so many bytes.
Input random_input(const std::vector<Seed>& seeds, Dice* dice);

}  // namespace codesign::fuzz
