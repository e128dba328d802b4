// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/ros/recorded_run.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace codesign {
namespace {

/// How long an arrow of one unit is drawn.
class ArrowScale {
 public:
  void include(double load) {
    if (load == 0.0) return;
    ++count_;
    sum_of_squares_ += load * load;
    largest_ = std::max(largest_, load);
  }

  /// The load is mostly about a third as long as the mechanism, at its peak not longer than it.
  double metres_per_unit(double size, double fallback) const {
    if (count_ == 0) return fallback;
    return std::min(size / (3.0 * std::sqrt(sum_of_squares_ / count_)), size / largest_);
  }

 private:
  int count_ = 0;
  double sum_of_squares_ = 0.0, largest_ = 0.0;
};

/// The box that holds every link frame relative to the root, and the loads to draw.
struct Extent {
  Eigen::AlignedBox3d box{Eigen::Vector3d::Zero()};
  ArrowScale force, torque;

  void include(const RecordedRun& run) {
    for (const Frame& frame : run.frames) {
      for (const LinkSample& link : frame.links) box.extend(link.position - frame.links.front().position);
      for (const FrictionSample& sample : frame.frictions) {
        force.include(sample.force.norm());
        torque.include(sample.torque.norm());
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
  layout.label_size = 0.1 * size;
  layout.style.shaft_diameter = 0.025 * size;
  layout.style.metres_per_newton = extent.force.metres_per_unit(size, layout.style.metres_per_newton);
  layout.style.metres_per_newton_metre = extent.torque.metres_per_unit(size, layout.style.metres_per_newton_metre);
  return layout;
}

}  // namespace codesign
