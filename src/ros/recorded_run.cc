// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/ros/recorded_run.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace codesign {
namespace {

/// The largest friction force and torque, and the box that holds every link frame relative to the root.
struct Extent {
  Eigen::AlignedBox3d box{Eigen::Vector3d::Zero()};
  double force = 0.0, torque = 0.0;

  void include(const RecordedRun& run) {
    for (const Frame& frame : run.frames) {
      for (const LinkSample& link : frame.links) box.extend(link.position - frame.links.front().position);
      for (const FrictionSample& sample : frame.frictions) {
        force = std::max(force, sample.force.norm());
        torque = std::max(torque, sample.torque.norm());
      }
    }
  }
};

}  // namespace

RecordedRun record_run(const Problem& problem, const std::vector<double>& parameters, double rate, const std::function<bool()>& stop) {
  RecordedRun run;
  Simulation simulation(problem.system, parameters);
  run.names = simulation.names();
  const int count = static_cast<int>(std::lround(problem.study.duration * rate)) + 1;
  run.status = simulate(&simulation, problem.study.duration, std::max(count, 2), [&](const Frame& frame) {
    run.frames.push_back(frame);
    return !stop || !stop();
  });
  return run;
}

SceneLayout lay_out(const RecordedRun& initial, const RecordedRun& tuned) {
  Extent extent;
  extent.include(initial);
  extent.include(tuned);
  const double size = std::max(extent.box.sizes().maxCoeff(), 1e-3);
  SceneLayout layout;
  layout.separation = extent.box.sizes().y() + 0.5 * size;
  layout.label_height = extent.box.max().z() + 0.15 * size;
  layout.label_size = 0.08 * size;
  layout.style.shaft_diameter = 0.02 * size;
  if (extent.force > 0.0) layout.style.metres_per_newton = size / (3.0 * extent.force);
  if (extent.torque > 0.0) layout.style.metres_per_newton_metre = size / (3.0 * extent.torque);
  return layout;
}

}  // namespace codesign
