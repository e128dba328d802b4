// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "assembly/extension_workspace.h"
#include "assembly/rate_solution.h"
#include "assembly/stuck_start.h"
#include "equations/equations.h"
#include "mechanism_codesign/status.h"
#include "system/state.h"

namespace codesign {

class CompiledSystem;

/// Holds the joints of a start that start stuck by the deflections of their bristles, doc/theory.md
/// (13h). Not thread-safe.
class StuckJoints {
 public:
  /// @param system must outlive this.
  explicit StuckJoints(const CompiledSystem& system);

  /// A joint that starts stuck does not move, as far as its own start says: a loop's joint follows
  /// the others. @param contradicting receives the index of its entry in Study::initial_state.
  /// @returns kInitialVelocityFailed.
  Status require_rest(const State<double>& state, Equations<double>* equations,
                      std::vector<std::size_t>* contradicting) const;
  /// Sets the rates z of the state and the deflections with which the joints rest or begin to
  /// slide. @param warnings receives `start_slides`. @returns kInitialReactionsFailed, or a status
  /// of RateSolution::solve().
  Status hold(Equations<double>* equations, State<double>* state, RateSolution* rates,
              Warnings* warnings);
  /// Sets the deflections with their exact first-order parts: those of the slip accelerations at
  /// fixed deflections are taken back by the deflections. @param start the state that the last
  /// hold() found, with `rates`. @param state its positions and velocities with derivatives.
  template <class T>
  void extend(const State<double>& start, const RateSolution& rates, Equations<T>* equations,
              ExtensionWorkspace<T>* workspace, State<T>* state) const;

 private:
  void find_response(const State<double>& state, const RateSolution& rates,
                     Equations<double>* equations);
  void warn_of_slides(Warnings* warnings) const;

  const CompiledSystem& system_;
  StuckStart stuck_;  ///< of the last hold()
};

}  // namespace codesign
