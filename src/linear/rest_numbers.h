// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <vector>

#include "linear/equilibrium.h"
#include "linear/linear_derivatives.h"

namespace codesign {

/// The numbers of a study's linearization about the equilibrium near its start, theory (70), with
/// derivatives by the tuned parameters: of each watched signal that is a LinearMeasure, as many as
/// LinearMeasure::places(). Each result depends on the design alone. Not thread-safe.
class RestNumbers {
 public:
  /// @param system must outlive this.
  explicit RestNumbers(const CompiledSystem& system) : system_(system) {}

  struct Entry {
    Eigen::VectorXd values;
    Eigen::MatrixXd gradients;  ///< one column per value; empty without derivatives
  };

  /// @param parameters all named ones. Statuses: those of find_equilibrium() and LinearMotion;
  /// kNonFinite for a margin that is infinite, kUnstableMotion for margins of a loop that is
  /// unstable, kNonFiniteGradient where poles meet, or the number depends on a posture that nothing
  /// determines.
  Status evaluate(const std::vector<double>& parameters, bool with_gradient,
                  const std::atomic<bool>* cancel);
  /// One per such signal, in the order of Study::watched.
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  Status set_poles(const LinearMeasure& measure, const Equilibrium& rest, Entry* entry) const;
  Status set_margin(const LinearMeasure& measure, const Equilibrium& rest, Entry* entry) const;
  Status prepare(const std::vector<double>& parameters, const Equilibrium& rest);
  Status differentiate_along(std::size_t direction, const Equilibrium& rest);
  Status check(const WatchedSignal& watched, const Entry& entry, double change,
               std::size_t direction) const;

  const CompiledSystem& system_;
  std::vector<Entry> entries_;
  std::unique_ptr<LinearDerivatives> derivatives_;
  std::vector<bool> without_gain_;  ///< per controller, of derivatives_: its integral has no gain
};

}  // namespace codesign
