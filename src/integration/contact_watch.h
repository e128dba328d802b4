// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "equations/compiled_system.h"
#include "integration/step_watch.h"

namespace codesign {

/// Finds the contacts of a run whose shapes overlap by more than kDeepOverlap of the smaller one.
class ContactWatch : public StepWatch {
 public:
  explicit ContactWatch(const CompiledSystem& system);

  bool has_work() const override { return !deepest_.empty(); }
  void start() override;
  void look(const Formulas<double>& formulas, double t) override;
  /// A warning `deep_penetration` for each such contact, with the deepest penetration.
  Warnings warnings() const override;

 private:
  struct Deepest {
    double overlap = 0.0, extent = 0.0, time = 0.0;  ///< [m], [m], [s]
  };

  const CompiledSystem& system_;
  std::vector<Deepest> deepest_;  ///< per contact
};

}  // namespace codesign
