// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// Finds the contacts of a run whose shapes overlap by more than kDeepOverlap of the smaller one.
/// It looks at the end of every step, since an impact is shorter than the distance of samples.
class ContactWatch {
 public:
  explicit ContactWatch(const CompiledSystem& system);

  void start();
  /// To be called after each step. @param equations hold the design.
  void look(const State<double>& state, Equations<double>* equations);
  /// A warning `deep_penetration` for each such contact, with the deepest penetration.
  Warnings warnings() const;

 private:
  struct Deepest {
    double overlap = 0.0, extent = 0.0, time = 0.0;  ///< [m], [m], [s]
  };

  const CompiledSystem& system_;
  std::vector<Deepest> deepest_;  ///< per contact
};

}  // namespace codesign
