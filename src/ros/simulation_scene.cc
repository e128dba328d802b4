// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation_scene.h"

#include <memory>

#include "ros/recorded_run.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kInstants = 100.0;
/// [s] of wall time.
constexpr double kPatience = 2.0;

void replace_if_given(double given, double* value) {
  if (given > 0.0) *value = given;
}

}  // namespace

SimulationScene::SimulationScene(const Problem& problem, const std::string& urdf, const MarkerStyle& given,
                                 const std::function<bool()>& stop)
    : has_objective_(!problem.study().integral.empty()) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience);
  const RecordedRun run = record_run(problem.system(), problem.parameters(), kInstants / problem.study().duration,
                                     [&] { return stop() || ros::WallTime::now() > end; });
  const auto solids = std::make_shared<LinkBoxes>(link_boxes(urdf, run.names.links));
  layout_ = lay_out({{run.names, run.frames, solids}});
  layout_.style.solids = solids;
  // With a scale of the user's own, lengths are what the user has chosen.
  if (given.metres_per_newton > 0.0 || given.metres_per_newton_metre > 0.0) layout_.style.longest = MarkerStyle().longest;
  replace_if_given(given.metres_per_newton, &layout_.style.metres_per_newton);
  replace_if_given(given.metres_per_newton_metre, &layout_.style.metres_per_newton_metre);
  replace_if_given(given.shaft_diameter, &layout_.style.shaft_diameter);
  legend_ = arrow_legend(layout_);
  stage_ = stage_of(layout_, {Eigen::Vector3d::Zero()}, 1 + static_cast<int>(legend_.size()));
}

mechanism_codesign::Scene SimulationScene::message(const MessageContext& context) const {
  mechanism_codesign::Scene scene = stage_.scene;
  scene.header.stamp = context.stamp;
  scene.header.frame_id = context.root_frame;
  return scene;
}

visualization_msgs::MarkerArray SimulationScene::text(const Frame& frame, const MessageContext& context) const {
  std::string first = "t = " + readable(frame.time, 4) + " s";
  if (has_objective_) first += ", objective so far " + readable(frame.objective, 4);
  std::vector<CaptionLine> lines{plain_line(first)};
  lines.insert(lines.end(), legend_.begin(), legend_.end());
  return caption(lines, layout_, stage_.caption, context);
}

}  // namespace codesign
