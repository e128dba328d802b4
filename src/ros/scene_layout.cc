// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene_layout.h"

#include <algorithm>
#include <cmath>

namespace codesign {
namespace {

/// Determines the scale of arrows from the loads that they show.
class ArrowScale {
 public:
  void include(double load) {
    if (load == 0.0 || !std::isfinite(load)) return;
    ++count_;
    sum_of_squares_ += load * load;
    largest_ = std::max(largest_, load);
  }

  bool is_used() const { return count_ > 0; }

  /// Arrow length per unit of load: a sixth of `size` for the root mean square of the loads, and at most 0.4 times it for the largest one.
  double metres_per_unit(double size, double fallback) const {
    if (count_ == 0) return fallback;
    const double scale = std::min(size / (6.0 * std::sqrt(sum_of_squares_ / count_)), 0.4 * size / largest_);
    const double digits = std::pow(10.0, std::floor(std::log10(scale)) - 1.0);
    return std::floor(scale / digits) * digits;
  }

 private:
  int count_ = 0;
  double sum_of_squares_ = 0.0, largest_ = 0.0;
};

void include_solids(const LinkSample& link, const std::vector<SolidBox>& boxes, Eigen::AlignedBox3d* box) {
  for (const SolidBox& solid : boxes)
    for (const Eigen::Vector3d& corner : corners(Eigen::AlignedBox3d(-solid.half, solid.half)))
      box->extend(link.position + link.orientation * (solid.pose * corner));
}

/// Around the frames of all links and the solids of those that are not the root.
void include_links(const ShownRun& run, Eigen::AlignedBox3d* box) {
  for (const Frame& frame : run.frames)
    for (std::size_t k = 0; k < frame.links.size(); ++k) {
      if (!frame.links[k].position.allFinite()) continue;
      box->extend(frame.links[k].position);
      if (k > 0 && run.solids) include_solids(frame.links[k], (*run.solids)[k], box);
    }
}

/// The box with the solids of the root, as far as half a size around it.
Eigen::AlignedBox3d with_root(const std::vector<ShownRun>& runs, const Eigen::AlignedBox3d& moving) {
  Eigen::AlignedBox3d root;
  for (const ShownRun& run : runs)
    if (!run.frames.empty() && run.solids) include_solids(run.frames.front().links[0], (*run.solids)[0], &root);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.5 * moving.sizes().maxCoeff());
  const Eigen::AlignedBox3d near(moving.min() - margin, moving.max() + margin);
  return root.isEmpty() ? moving : moving.merged(root.intersection(near));
}

void include_arrows(const ShownRun& run, MarkerStyle style, Eigen::AlignedBox3d* box) {
  style.solids = run.solids;
  for (const Frame& frame : run.frames)
    for (std::size_t k = 0; k < frame.frictions.size(); ++k) {
      const ArrowEnds ends = friction_arrow(frame.frictions[k], run.names.friction_is_torque[k], frame, style);
      if (ends.from.allFinite() && ends.to.allFinite()) box->extend(ends.from).extend(ends.to);
    }
}

void scale_arrows(const std::vector<ShownRun>& runs, SceneLayout* layout) {
  ArrowScale force, torque;
  for (const ShownRun& run : runs)
    for (const Frame& frame : run.frames)
      for (const FrictionSample& sample : frame.frictions) {
        force.include(sample.force.norm());
        torque.include(sample.torque.norm());
      }
  layout->has_forces = force.is_used();
  layout->has_torques = torque.is_used();
  layout->style.shaft_diameter = 0.015 * layout->size;
  layout->style.metres_per_newton = force.metres_per_unit(layout->size, layout->style.metres_per_newton);
  layout->style.metres_per_newton_metre = torque.metres_per_unit(layout->size, layout->style.metres_per_newton_metre);
}

/// Height of letters over the distance of the viewer: 1/36 of the picture's height.
constexpr double kLetter = kHalfHeight / 18.0;
/// From line to line, in letters.
constexpr double kLine = 1.6;

/// The corners of a mechanism's box, where its root link stands at `place`.
void add_mechanism(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& place, std::vector<Eigen::Vector3d>* points) {
  for (const Eigen::Vector3d& corner : corners(box)) points->push_back(place + corner);
}

/// The way to stand clear of each other, to the right or one before the other, in which the farther one looks larger.
Eigen::Vector3d apart_in(const SceneView& view, const Eigen::AlignedBox3d& box) {
  const Eigen::Vector2d half = view.half_picture(box);
  const Eigen::Vector3d beside = 2.15 * half.x() * view.right();
  const Eigen::Vector3d before = 2.5 * half.y() / std::sin(view.pitch) * Eigen::Vector3d(std::cos(view.yaw), std::sin(view.yaw), 0.0);
  const auto farther = [&](const Eigen::Vector3d& apart) {
    std::vector<Eigen::Vector3d> points;
    for (const double side : {-0.5, 0.5}) add_mechanism(box, side * apart, &points);
    const CameraPlace camera = place_camera(points, view);
    return camera.distance + camera.focus.dot(view.towards_viewer()) - (box.center() - 0.5 * apart).dot(view.towards_viewer());
  };
  return farther(beside) <= farther(before) ? beside : before;
}

void set_point(const Eigen::Vector3d& point, boost::array<double, 3>* numbers) {
  for (std::size_t k = 0; k < 3; ++k) (*numbers)[k] = point[static_cast<Eigen::Index>(k)];
}

}  // namespace

SceneLayout lay_out(const std::vector<ShownRun>& runs) {
  Eigen::AlignedBox3d moving(Eigen::Vector3d::Zero());
  for (const ShownRun& run : runs) include_links(run, &moving);
  SceneLayout layout;
  layout.box = with_root(runs, moving);
  layout.size = std::max(layout.box.sizes().maxCoeff(), 1e-3);
  layout.floor = layout.box.min().z();
  layout.view = view_of(layout.box.sizes());
  layout.style.towards_viewer = layout.view.towards_viewer();
  scale_arrows(runs, &layout);
  for (const ShownRun& run : runs) include_arrows(run, layout.style, &layout.box);
  layout.apart = apart_in(layout.view, layout.box);
  std::vector<Eigen::Vector3d> points;
  add_mechanism(layout.box, Eigen::Vector3d::Zero(), &points);
  if (runs.size() > 1) add_mechanism(layout.box, layout.apart, &points);
  layout.letter = kLetter * place_camera(points, layout.view, 0.7).distance;
  return layout;
}

Stage stage_of(const SceneLayout& layout, const std::vector<Eigen::Vector3d>& places, int lines) {
  const SceneView& view = layout.view;
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& place : places) add_mechanism(layout.box, place, &points);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) box.extend(point);
  // Below the text there is room for the names.
  const double top = kFilled - kLine * (lines + 2) * kLetter / kHalfHeight;
  const CameraPlace camera = place_camera(points, view, top);
  Stage stage;
  stage.letter = kLetter * camera.distance;
  stage.label = layout.box.center() + (view.half_picture(layout.box).y() + stage.letter) * view.up();
  // The text is as far away as makes its letters look as large as those of the names.
  const double away = layout.letter / kLetter;
  const Eigen::Vector3d eye = camera.focus + camera.distance * view.towards_viewer();
  stage.caption = eye - away * view.towards_viewer() + ((kFilled * kHalfHeight - 0.5 * kLetter) * away) * view.up();
  mechanism_codesign::Scene& scene = stage.scene;
  set_point(box.min(), &scene.smallest);
  set_point(box.max(), &scene.largest);
  scene.floor = layout.floor;
  scene.grid_cell = round_down(0.15 * layout.size);
  set_point(camera.focus, &scene.focal_point);
  scene.distance = camera.distance;
  scene.yaw = layout.view.yaw;
  scene.pitch = layout.view.pitch;
  scene.metres_per_newton = layout.style.metres_per_newton;
  scene.metres_per_newton_metre = layout.style.metres_per_newton_metre;
  return stage;
}

}  // namespace codesign
