// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "equations/compiled_system.h"
#include "integration/step_watch.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

/// The part of its range by which a stop may give way without a word.
constexpr double kStopGivesWay = 0.02;

/// Finds the stops of a run, theory (13d), that give way by more than kStopGivesWay of their range.
class StopWatch : public StepWatch {
 public:
  explicit StopWatch(const CompiledSystem& system);

  bool has_work() const override { return has_stops_; }
  void start() override { excesses_.clear(); }
  void look(const Formulas<double>& formulas, double t) override;
  /// In the order in which they gave way.
  const std::vector<StopExcess>& excesses() const { return excesses_; }

 private:
  void note(const JointLoad& load, bool is_upper, double bound, double position, double time);

  const CompiledSystem& system_;
  std::vector<StopExcess> excesses_;
  bool has_stops_ = false;
};

}  // namespace codesign
