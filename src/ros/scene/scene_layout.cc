// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/scene_layout.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "description/expression.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// Longest arrow, as a share of the size of the mechanism; longer ones are cut.
constexpr double kLongest = 0.4;

/// Arrow length per unit of load: a sixth of `size` for the median of the loads, so that a short
/// peak, such as at the start of a run, does not make all others invisible. Loads below a
/// thousandth of the largest one do not count. @param loads finite and not zero
double metres_per_unit(std::vector<double> loads, double size, double fallback) {
  if (loads.empty()) return fallback;
  std::sort(loads.begin(), loads.end());
  const auto first = std::lower_bound(loads.begin(), loads.end(), 1e-3 * loads.back());
  const double median = *(first + (loads.end() - first) / 2);
  const double scale = size / (6.0 * median);
  const double digits = std::pow(10.0, std::floor(std::log10(scale)) - 1.0);
  return std::floor(scale / digits) * digits;
}

/// About a hundred frames of a run, chosen evenly, which determine the layout.
std::vector<const Frame*> some_frames(const ShownRun& run) {
  std::vector<const Frame*> frames;
  const std::size_t stride = 1 + run.frames.size() / 100;
  for (std::size_t k = 0; k < run.frames.size(); k += stride) frames.push_back(&run.frames[k]);
  return frames;
}

void add_solids(const LinkSample& link, const std::vector<SolidBox>& boxes,
                std::vector<Eigen::Vector3d>* points) {
  for (const SolidBox& solid : boxes)
    for (const Eigen::Vector3d& corner : corners(Eigen::AlignedBox3d(-solid.half, solid.half)))
      points->push_back(link.position + link.orientation * (solid.pose * corner));
}

/// Adds the origins of all links and the corners of the solids of all links except the root.
void add_links(const ShownRun& run, std::vector<Eigen::Vector3d>* points) {
  for (const Frame* frame : some_frames(run))
    for (std::size_t k = 0; k < frame->links.size(); ++k) {
      if (!frame->links[k].position.allFinite()) continue;
      points->push_back(frame->links[k].position);
      if (k > 0 && run.solids) add_solids(frame->links[k], (*run.solids)[k], points);
    }
}

Eigen::AlignedBox3d box_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) box.extend(point);
  return box;
}

/// Adds the corners of the root's solids. The box around the moving links, enlarged on each side by
/// half of its largest side, limits them: corners outside are moved onto it.
void add_root(const std::vector<ShownRun>& runs, std::vector<Eigen::Vector3d>* points) {
  const Eigen::AlignedBox3d moving = box_of(*points);
  const Eigen::Array3d margin = Eigen::Array3d::Constant(0.5 * moving.sizes().maxCoeff());
  std::vector<Eigen::Vector3d> root;
  for (const ShownRun& run : runs)
    if (!run.frames.empty() && run.solids)
      add_solids(run.frames.front().links[0], (*run.solids)[0], &root);
  for (const Eigen::Vector3d& point : root)
    points->emplace_back(point.array()
                             .max(moving.min().array() - margin)
                             .min(moving.max().array() + margin)
                             .matrix());
}

void add_arrows(const ShownRun& run, MarkerStyle style, std::vector<Eigen::Vector3d>* points) {
  style.solids = run.solids;
  for (const Frame* frame : some_frames(run))
    for (std::size_t k = 0; k < frame->frictions.size(); ++k) {
      const ArrowEnds ends =
          friction_arrow(frame->frictions[k], run.names.friction_is_torque[k], *frame, style);
      if (ends.from.allFinite() && ends.to.allFinite())
        points->insert(points->end(), {ends.from, ends.to});
    }
}

void scale_arrows(const std::vector<ShownRun>& runs, SceneLayout* layout) {
  std::vector<double> forces, torques;
  const auto add = [](double load, std::vector<double>* loads) {
    if (load != 0.0 && std::isfinite(load)) loads->push_back(load);
  };
  for (const ShownRun& run : runs)
    for (const Frame& frame : run.frames)
      for (const FrictionSample& sample : frame.frictions) {
        add(sample.force.norm(), &forces);
        add(sample.torque.norm(), &torques);
      }
  layout->has_forces = !forces.empty();
  layout->has_torques = !torques.empty();
  layout->style.shaft_diameter = 0.015 * layout->size;
  layout->style.longest = kLongest * layout->size;
  layout->style.metres_per_newton =
      metres_per_unit(std::move(forces), layout->size, layout->style.metres_per_newton);
  layout->style.metres_per_newton_metre =
      metres_per_unit(std::move(torques), layout->size, layout->style.metres_per_newton_metre);
}

/// Height of letters divided by the distance of the viewer: letters take 1/36 of the picture's
/// height.
constexpr double kLetter = kHalfHeight / 18.0;
/// Distance of lines, in heights of letters.
constexpr double kLine = 1.6;

/// The points of a mechanism whose root link stands at `place`.
void add_mechanism(const SceneLayout& layout, const Eigen::Vector3d& place,
                   std::vector<Eigen::Vector3d>* points) {
  for (const Eigen::Vector3d& point : layout.points) points->push_back(place + point);
}

/// The displacement that separates both mechanisms, to the right or in depth: the one of the two
/// that makes the farther mechanism look larger.
Eigen::Vector3d apart_in(const SceneLayout& layout) {
  const SceneView& view = layout.view;
  const Eigen::Vector2d sides = view.picture(layout.points).sizes();
  const Eigen::Vector3d beside = 1.08 * sides.x() * view.right();
  const Eigen::Vector3d before = 1.25 * sides.y() / std::sin(view.pitch) *
                                 Eigen::Vector3d(std::cos(view.yaw), std::sin(view.yaw), 0.0);
  const auto farther = [&](const Eigen::Vector3d& apart) {
    std::vector<Eigen::Vector3d> points;
    for (const double side : {-0.5, 0.5}) add_mechanism(layout, side * apart, &points);
    const CameraPlace camera = place_camera(points, view);
    return camera.distance + (camera.focus + 0.5 * apart).dot(view.towards_viewer());
  };
  return farther(beside) <= farther(before) ? beside : before;
}

/// A place above each mechanism as the camera sees it, in the middle of its picture and at the
/// distance of its middle.
Eigen::Vector3d place_of_name(const SceneLayout& layout, const std::vector<Eigen::Vector3d>& places,
                              const CameraPlace& camera) {
  const SceneView& view = layout.view;
  const Eigen::Vector3d middle = box_of(layout.points).center();
  const auto away = [&](const Eigen::Vector3d& point) {
    return camera.distance - (point - camera.focus).dot(view.towards_viewer());
  };
  double height = 0.0;  // above the middle
  for (const Eigen::Vector3d& place : places) {
    double highest = -1.0;
    for (const Eigen::Vector3d& point : layout.points)
      highest =
          std::max(highest, (place + point - camera.focus).dot(view.up()) / away(place + point));
    height = std::max(height, (highest + 1.1 * kLetter) * away(place + middle) -
                                  (place + middle - camera.focus).dot(view.up()));
  }
  return middle +
         (view.picture(layout.points).center().x() - middle.dot(view.right())) * view.right() +
         height * view.up();
}

void set_point(const Eigen::Vector3d& point, boost::array<double, 3>* numbers) {
  for (std::size_t k = 0; k < 3; ++k) (*numbers)[k] = point[to_signed(k)];
}

}  // namespace

visualization_msgs::Marker text_marker(const std::string& text, const Eigen::Vector3d& place,
                                       double letter) {
  visualization_msgs::Marker marker;
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.text = text;
  marker.pose.position = xyz<geometry_msgs::Point>(place);
  marker.pose.orientation.w = 1.0;
  marker.scale.z = letter;
  marker.color.a = 1.0F;
  return marker;
}

SceneLayout lay_out(const std::vector<ShownRun>& runs) {
  SceneLayout layout;
  layout.points = {Eigen::Vector3d::Zero()};
  for (const ShownRun& run : runs) add_links(run, &layout.points);
  add_root(runs, &layout.points);
  const Eigen::AlignedBox3d box = box_of(layout.points);
  layout.size = std::max(box.sizes().maxCoeff(), 1e-3);
  layout.floor = box.min().z();
  layout.view = view_of(box.sizes());
  layout.style.towards_viewer = layout.view.towards_viewer();
  scale_arrows(runs, &layout);
  for (const ShownRun& run : runs) add_arrows(run, layout.style, &layout.points);
  layout.apart = apart_in(layout);
  std::vector<Eigen::Vector3d> points = layout.points;
  if (runs.size() > 1) add_mechanism(layout, layout.apart, &points);
  layout.letter = kLetter * place_camera(points, layout.view, 0.7).distance;
  return layout;
}

Stage stage_of(const SceneLayout& layout, const std::vector<Eigen::Vector3d>& places, int lines) {
  const SceneView& view = layout.view;
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& place : places) add_mechanism(layout, place, &points);
  const Eigen::AlignedBox3d box = box_of(points);
  // Below the text there is room for the names.
  const double top = kFilled - kLine * (lines + 2) * kLetter / kHalfHeight;
  const CameraPlace camera = place_camera(points, view, top);
  Stage stage;
  stage.letter = kLetter * camera.distance;
  stage.label = place_of_name(layout, places, camera);
  // The distance at which the letters of the text look as large as the letters of the names.
  const double away = layout.letter / kLetter;
  const Eigen::Vector3d eye = camera.focus + camera.distance * view.towards_viewer();
  stage.caption = eye - away * view.towards_viewer() +
                  ((kFilled * kHalfHeight - 0.5 * kLetter) * away) * view.up();
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

std::vector<CaptionLine> arrow_legend(const SceneLayout& layout) {
  std::vector<CaptionLine> lines;
  const std::string cut = std::isfinite(layout.style.longest)
                              ? ", at most " + readable(layout.style.longest, 2) + " m"
                              : "";
  if (layout.has_forces)
    lines.push_back(
        {"friction force, " + readable(layout.style.metres_per_newton, 6) + " m per N" + cut,
         friction_color(false)});
  if (layout.has_torques)
    lines.push_back({"friction torque, " + readable(layout.style.metres_per_newton_metre, 6) +
                         " m per N m" + cut,
                     friction_color(true)});
  return lines;
}

CaptionLine plain_line(const std::string& text) {
  CaptionLine line{text, {}};
  line.color.a = 1.0F;
  return line;
}

visualization_msgs::MarkerArray caption(const std::vector<CaptionLine>& lines,
                                        const SceneLayout& layout, const Eigen::Vector3d& first,
                                        const MessageContext& context) {
  visualization_msgs::MarkerArray message;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Eigen::Vector3d place =
        first - kLine * static_cast<double>(k) * layout.letter * layout.view.up();
    message.markers.push_back(text_marker(lines[k].text, place, layout.letter));
    visualization_msgs::Marker& marker = message.markers.back();
    marker.header = header_of(context);
    marker.ns = "caption";
    marker.id = static_cast<std::int32_t>(k);
    marker.color = lines[k].color;
  }
  return message;
}

geometry_msgs::TransformStamped place_in_world(const std::string& frame,
                                               const Eigen::Vector3d& place,
                                               const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header = header_of({stamp, "world"});
  transform.child_frame_id = frame;
  transform.transform.translation = xyz<geometry_msgs::Vector3>(place);
  transform.transform.rotation.w = 1.0;
  return transform;
}

visualization_msgs::Marker label(const std::string& name, const std::string& frame,
                                 const std::string& text, const Stage& stage,
                                 const ros::Time& stamp) {
  visualization_msgs::Marker marker = text_marker(text, stage.label, stage.letter);
  marker.header = header_of({stamp, frame});
  marker.ns = name;
  return marker;
}

}  // namespace codesign
