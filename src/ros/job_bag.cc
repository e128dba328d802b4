// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/job_bag.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "reading/urdf/pictures.h"
#include "ros/bag_writer.h"
#include "ros/scene_text.h"
#include "text/number_text.h"

namespace codesign {
namespace {

ShownRun shown(const BagSide& side) {
  const std::vector<std::string>& links = side.run.names.links;
  return {side.run.names, side.run.frames, std::make_shared<LinkBoxes>(link_boxes(with_sticks(side.urdf), links))};
}

/// The arrangement of both mechanisms in rviz: side by side, or one over the other.
struct BagScene {
  SceneLayout layout;
  std::vector<CaptionLine> legend;

  explicit BagScene(const JobRecord& record) {
    std::vector<ShownRun> runs{shown(record.nominal.initial), shown(record.nominal.tuned)};
    if (record.worst)
      for (const BagSide* side : {&record.worst->initial, &record.worst->tuned}) runs.push_back(shown(*side));
    layout = lay_out(runs);
    legend = arrow_legend(layout);
  }

  Stage stage(const Eigen::Vector3d& apart) const {
    return stage_of(layout, {-0.5 * apart, 0.5 * apart}, 1 + static_cast<int>(legend.size()));
  }
};

/// @param place prefix of the topics. @param apart vector from the initial to the tuned mechanism. @returns the view of both.
Stage write_places(const std::string& place, const Eigen::Vector3d& apart, const BagScene& scene, BagWriter* writer) {
  const ros::Time begin = BagWriter::stamp(0.0);
  Stage stage = scene.stage(apart);
  tf2_msgs::TFMessage places;
  places.transforms = {place_in_world("initial", -0.5 * apart, begin), place_in_world("tuned", 0.5 * apart, begin),
                       place_in_world("caption", stage.caption, begin)};
  writer->write_latched(place + "tf_static", 0.0, places);
  stage.scene.header.stamp = begin;
  stage.scene.header.frame_id = "world";
  writer->write_latched(place + "scene", 0.0, stage.scene);
  return stage;
}

/// @param place prefix of the topics.
void write_frame(const std::string& place, const std::string& side, const RecordedRun& run, std::size_t index, const MarkerStyle& style,
                 BagWriter* writer) {
  if (index >= run.frames.size()) return;
  const Frame& frame = run.frames[index];
  const std::string prefix = side + "/";
  writer->write_frame(place + prefix, prefix + run.names.links[0], run.names, frame, style);
  writer->write(place + "tf", frame.time, placed_link_transforms(run.names, run.link_parents, frame, BagWriter::stamp(frame.time), prefix));
}

std::string with_objective(const std::string& name, double objective) {
  return std::isfinite(objective) ? name + ", objective " + readable(objective, 4) : name;
}

void write_labels(const std::string& place, const std::vector<visualization_msgs::Marker>& markers, BagWriter* writer) {
  visualization_msgs::MarkerArray labels;
  labels.markers = markers;
  writer->write_latched(place + "labels", 0.0, labels);
}

void write_head(const JobRecord& record, const BagScene& scene, BagWriter* writer) {
  writer->write_text("study", record.study);
  for (const std::string& file : record.study_files) writer->write_text("study_files", file);
  writer->write_latched("request", 0.0, record.request);
  const Stage apart = write_places("", scene.layout.apart, scene, writer),
              over = write_places("overlay/", Eigen::Vector3d::Zero(), scene, writer);
  const ros::Time begin = BagWriter::stamp(0.0);
  const std::string initial = with_objective("initial", record.result.initial_objective);
  const std::string tuned = with_objective("tuned", record.result.objective);
  write_labels("", {label("initial", "initial", initial, apart, begin), label("tuned", "tuned", tuned, apart, begin)}, writer);
  write_labels("overlay/", {label("tuned", "tuned", tuned + "; ghost: " + initial, over, begin)}, writer);
}

void write_progress(const JobRecord& record, double duration, BagWriter* writer) {
  const double spacing = duration / static_cast<double>(std::max<std::size_t>(record.progress.size(), 2) - 1);
  double time = 0.0;
  for (mechanism_codesign::OptimizationProgress progress : record.progress) {
    progress.header.stamp = BagWriter::stamp(time);
    writer->write_latched("optimization_progress", time, progress);
    time += spacing;
  }
}

/// The text of an instant: time, the objective of each run so far, and the legend of the arrows.
void write_caption(const std::string& place, const BagRuns& runs, std::size_t index, const BagScene& scene, BagWriter* writer) {
  double time = 0.0;
  std::string text = "objective so far:";
  const std::pair<const char*, const RecordedRun*> sides[] = {{" initial ", &runs.initial.run}, {" tuned ", &runs.tuned.run}};
  for (const auto& [name, run] : sides) {
    if (index >= run->frames.size()) continue;
    time = run->frames[index].time;
    text += name + readable(run->frames[index].objective, 4);
  }
  std::vector<CaptionLine> lines{plain_line("t = " + readable(time, 4) + " s, " + text)};
  lines.insert(lines.end(), scene.legend.begin(), scene.legend.end());
  writer->write(place + "caption", time, caption(lines, scene.layout, Eigen::Vector3d::Zero(), {BagWriter::stamp(time), "caption"}));
}

void write_runs(const std::string& place, const BagRuns& runs, const BagScene& scene, BagWriter* writer) {
  writer->write_text(place + "initial/robot_description", with_sticks(runs.initial.urdf));
  writer->write_text(place + "tuned/robot_description", with_sticks(runs.tuned.urdf));
  MarkerStyle initial = scene.layout.style, tuned = scene.layout.style;
  initial.solids = shown(runs.initial).solids;
  tuned.solids = shown(runs.tuned).solids;
  const std::size_t count = std::max(runs.initial.run.frames.size(), runs.tuned.run.frames.size());
  for (std::size_t i = 0; i < count; ++i) {
    write_frame(place, "initial", runs.initial.run, i, initial, writer);
    write_frame(place, "tuned", runs.tuned.run, i, tuned, writer);
    write_caption(place, runs, i, scene, writer);
  }
}

void write_contents(const JobRecord& record, BagWriter* writer) {
  const BagRuns& nominal = record.nominal;
  const BagScene scene(record);
  write_head(record, scene, writer);
  double duration = 0.0;
  for (const RecordedRun* run : {&nominal.initial.run, &nominal.tuned.run})
    if (!run->frames.empty()) duration = std::max(duration, run->frames.back().time);
  write_runs("", nominal, scene, writer);
  if (record.worst) write_runs("worst/", *record.worst, scene, writer);
  write_progress(record, duration, writer);
  writer->write_latched("result", duration, record.result);
}

}  // namespace

void write_bag(const std::string& path, const JobRecord& record) {
  BagWriter writer(path);
  write_contents(record, &writer);
  writer.finish();
}

}  // namespace codesign
