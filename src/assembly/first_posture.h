// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/posture.h"
#include "math/scalar.h"

namespace codesign {

struct TreeLoops;

/// The posture that a start begins to look for a closed one from, doc/theory.md (19): the positions
/// that the study gives, else its guesses, else zero.
class FirstPosture {
 public:
  /// @param loops must outlive this.
  explicit FirstPosture(const TreeLoops& loops);

  /// Assembly::begin_at().
  void begin_at(double time, const VectorX<double>& theta);
  double time() const { return time_; }  ///< [s]
  /// Sets coordinates and rates, of the posture whose number `posture` has.
  /// @param parameters all named parameters (Study::parameters order).
  void set(const std::vector<double>& parameters, Posture* posture) const;

  /// Whether begin_at() gave coordinates in place of the study's guesses.
  bool has_guess() const { return guess_.size() > 0; }
  /// Whether a start is that of the study itself, at the start values of its parameters.
  bool is_own(const std::vector<double>& parameters) const {
    return !has_guess() && parameters == own_design_;
  }
  const std::vector<double>& own_design() const { return own_design_; }

  /// Small guesses [rad or m] that every start of the study begins with, so that a linkage that is
  /// stretched out in a line bends; empty: none.
  const VectorX<double>& nudge() const { return nudge_; }
  void nudge(const VectorX<double>& nudge) { nudge_ = nudge; }

 private:
  const TreeLoops& loops_;
  const std::vector<double> own_design_;  ///< the start values of the study's parameters
  double time_ = 0.0;
  VectorX<double> guess_;  ///< of theta, instead of the study's; empty: none
  VectorX<double> nudge_;
};

}  // namespace codesign
