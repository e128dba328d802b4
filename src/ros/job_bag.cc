// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/job_bag.h"

#include <algorithm>

#include "ros/bag_writer.h"
#include "ros/scene_layout.h"

namespace codesign {
namespace {

/// @param place prefix of the topics.
void write_frame(const std::string& place, const std::string& side, const RecordedRun& run, std::size_t index, const MarkerStyle& style,
                 BagWriter* writer) {
  if (index >= run.frames.size()) return;
  const Frame& frame = run.frames[index];
  const std::string prefix = side + "/";
  writer->write_frame(place + prefix, prefix + run.names.links[0], run.names, frame, style);
  writer->write(place + "tf", frame.time, all_link_transforms(run.names, frame, BagWriter::stamp(frame.time), prefix));
}

void write_head(const JobRecord& record, const SceneLayout& layout, BagWriter* writer) {
  writer->write_text("study", record.study);
  for (const std::string& file : record.study_files) writer->write_text("study_files", file);
  writer->write_latched("request", 0.0, record.request);
  tf2_msgs::TFMessage places;
  const ros::Time begin = BagWriter::stamp(0.0);
  places.transforms = {place_in_world("initial", 0.5 * layout.separation, begin), place_in_world("tuned", -0.5 * layout.separation, begin)};
  writer->write_latched("tf_static", 0.0, places);
  visualization_msgs::MarkerArray labels;
  for (const char* side : {"initial", "tuned"}) labels.markers.push_back(label(side, side, side, layout, begin));
  writer->write_latched("labels", 0.0, labels);
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

void write_runs(const std::string& place, const BagRuns& runs, const MarkerStyle& style, BagWriter* writer) {
  writer->write_text(place + "initial/robot_description", runs.initial.urdf);
  writer->write_text(place + "tuned/robot_description", runs.tuned.urdf);
  const std::size_t count = std::max(runs.initial.run.frames.size(), runs.tuned.run.frames.size());
  for (std::size_t i = 0; i < count; ++i) {
    write_frame(place, "initial", runs.initial.run, i, style, writer);
    write_frame(place, "tuned", runs.tuned.run, i, style, writer);
  }
}

void write_contents(const JobRecord& record, BagWriter* writer) {
  const BagRuns& nominal = record.nominal;
  const SceneLayout layout = lay_out({&nominal.initial.run.frames, &nominal.tuned.run.frames});
  write_head(record, layout, writer);
  double duration = 0.0;
  for (const RecordedRun* run : {&nominal.initial.run, &nominal.tuned.run})
    if (!run->frames.empty()) duration = std::max(duration, run->frames.back().time);
  write_runs("", nominal, layout.style, writer);
  if (record.worst) write_runs("worst/", *record.worst, layout.style, writer);
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
