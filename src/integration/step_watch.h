// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "equations/equations.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// Finds what a law is not made for in a run. It looks at the end of every step, since an impact is
/// shorter than the distance of samples.
class StepWatch {
 public:
  virtual ~StepWatch() = default;
  StepWatch() = default;
  StepWatch(const StepWatch&) = delete;
  StepWatch& operator=(const StepWatch&) = delete;

  /// Whether the mechanism has what is watched; else look() need not be called.
  virtual bool has_work() const = 0;
  virtual void start() = 0;
  /// To be called after each step. @param formulas hold the design, with the state at its end
  /// loaded. @param t its time [s].
  virtual void look(const Formulas<double>& formulas, double t) = 0;
  /// About the run so far.
  virtual Warnings warnings() const { return {}; }
};

}  // namespace codesign
