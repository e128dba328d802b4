// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_SIMULATION_SCENE_H_
#define MECHANISM_CODESIGN_ROS_SIMULATION_SCENE_H_

#include <functional>
#include <string>

#include "problem/load_problem.h"
#include "ros/scene_text.h"

namespace codesign {

/// How the node `simulation` shows its mechanism. The study is run once, at 100 instants, to know where the mechanism goes and how large
/// its friction is; of a run that takes longer than 2 s, is stopped or fails, as far as it came.
class SimulationScene {
 public:
  /// @param urdf with sticks, as viewers get it. @param given scales that the user has set; those that are zero follow from the run.
  /// @param stop called repeatedly; true ends the run.
  SimulationScene(const Problem& problem, const std::string& urdf, const MarkerStyle& given, const std::function<bool()>& stop);

  /// Scales and solids for friction_markers().
  const MarkerStyle& style() const { return layout_.style; }
  mechanism_codesign::Scene message(const MessageContext& context) const;
  /// Time, objective so far if the study has integral terms, and what the arrows mean.
  visualization_msgs::MarkerArray text(const Frame& frame, const MessageContext& context) const;

 private:
  SceneLayout layout_;
  Stage stage_;
  std::vector<CaptionLine> legend_;
  bool has_objective_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_SIMULATION_SCENE_H_
