// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "problem/load_problem.h"
#include "ros/scene_text.h"

namespace codesign {

/// The picture of the mechanism of the node `simulation`. Runs the study once and samples it at 100 instants to determine the range of the
/// motion and the magnitude of the friction. If the run takes longer than 2 s, is stopped or fails, the part until then counts.
class SimulationScene {
 public:
  /// @param urdf with sticks, as viewers get it. @param given scales that the user has set; zero: the scale follows from the run.
  /// @param stop called repeatedly; true ends the run.
  SimulationScene(const Problem& problem, const std::string& urdf, const MarkerStyle& given, const std::function<bool()>& stop);

  /// Scales and solids for friction_markers().
  const MarkerStyle& style() const { return layout_.style; }
  mechanism_codesign::Scene message(const MessageContext& context) const;
  /// Time, objective so far if the study has integral terms, and the legend of the arrows.
  visualization_msgs::MarkerArray text(const Frame& frame, const MessageContext& context) const;

 private:
  SceneLayout layout_;
  Stage stage_;
  std::vector<CaptionLine> legend_;
  bool has_objective_;
};

}  // namespace codesign
