// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "integration/mode_watch.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

class CompiledSystem;
class RosenbrockIntegrator;

/// The guard on which a run ends, crossed.
struct EndCrossing {
  std::vector<bool> mode;      ///< before it
  const SwitchOrigin* origin;  ///< of the switch
  ModeChange change;
};

/// Crosses the guard on which a run has come to its end; std::nullopt if there is none, and if it
/// has ended the run. The equations then hold the mode behind it, until hold(mode).
std::optional<EndCrossing> cross_end(RosenbrockIntegrator* integrator);

/// Runs that start or end exactly on a guard, doc/theory.md (18i): designs on one side of this one
/// have an event that those on the other side do not have, so that derivatives by what moves the
/// guard hold on one side only. Warnings `one_sided_gradient` say so.
class OneSidedGradient {
 public:
  /// @param system must outlive it.
  explicit OneSidedGradient(const CompiledSystem& system) : system_(&system) {}

  /// The derivatives of a guard by the tuned parameters at the start of a run.
  using GuardDerivatives = std::function<void(int guard, Eigen::VectorXd* derivatives)>;

  /// Forgets all warnings.
  void start() { warnings_.clear(); }
  void look_at_start(RosenbrockIntegrator* integrator, const GuardDerivatives& derivatives);
  /// Compares the gradient of a run that ends on a guard with that of runs which end behind it.
  /// @param origin of the switch. @param moves whether the motion jumps there, and watched signals
  /// with it.
  void compare(const SwitchOrigin* origin, const Eigen::VectorXd& before,
               const Eigen::VectorXd& behind, bool moves);
  const Warnings& warnings() const { return warnings_; }

 private:
  /// The parameter over whose range a derivative changes most.
  Eigen::Index largest(const Eigen::VectorXd& derivatives) const;
  double range(Eigen::Index tuned) const;
  void add(const SwitchOrigin* origin, const std::string& text);

  const CompiledSystem* system_;
  Warnings warnings_;
};

}  // namespace codesign
