// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/loop_newton.h"
#include "assembly/posture.h"
#include "assembly/posture_walk.h"
#include "assembly/start_design.h"
#include "math/scalar.h"
#include "mechanism_codesign/status.h"

namespace codesign {

struct TreeLoops;

/// The branch of the loops that the posture at the study's own design lies on, doc/theory.md (19b).
/// Not thread-safe.
class DesignBranch {
 public:
  /// @param own_design the start values of the study's parameters. All arguments must outlive this.
  DesignBranch(const TreeLoops& loops, const std::vector<double>& own_design, LoopNewton* newton)
      : loops_(loops), own_design_(own_design), newton_(*newton) {}

  /// The closed posture at the study's own design.
  void begin(const Posture& own);
  bool is_known() const { return is_known_; }

  /// Compares the posture that was found at another design with the continuation of the own one,
  /// which takes its place where they differ. The solution from the study's guesses is kept to the
  /// last bit where it is the continued one.
  /// @param plain its status. @param design its equations hold other designs in between. @param
  /// warnings receives `branch_continued` or `branch_lost`. @returns the status of `posture`.
  Status keep(const Status& plain, const StartDesign& design, Posture* posture, Warnings* warnings);

 private:
  bool follow(const StartDesign& design, Posture* posture);
  void warn_of(const char* code, const std::string& message, const VectorX<double>& theta,
               const VectorX<double>& other, const std::vector<double>& parameters,
               Warnings* warnings) const;

  const TreeLoops& loops_;
  const std::vector<double>& own_design_;
  LoopNewton& newton_;
  // The posture at the own design.
  bool is_known_ = false;
  VectorX<double> theta_;
  std::vector<int> free_;  ///< the dependent coordinates
  double rank_tolerance_ = Posture::kRank;
  // Memory.
  Posture plain_;                ///< to return to
  PostureWay way_;               ///< of the last follow()
  std::vector<double> between_;  ///< a design on the way
};

}  // namespace codesign
