// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/job_bag.h"

#include <algorithm>

#include "ros/bag_writer.h"

namespace codesign {
namespace {

void write_frame(const std::string& side, const RecordedRun& run, std::size_t index, const MarkerStyle& style, BagWriter* writer) {
  if (index >= run.frames.size()) return;
  const Frame& frame = run.frames[index];
  const std::string prefix = side + "/";
  writer->write_frame(prefix, prefix + run.names.links[0], run.names, frame, style);
  writer->write("tf", frame.time, all_link_transforms(run.names, frame, BagWriter::stamp(frame.time), prefix));
}

geometry_msgs::TransformStamped place(const std::string& side, double y) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = BagWriter::stamp(0.0);
  transform.header.frame_id = "world";
  transform.child_frame_id = side;
  transform.transform.translation.y = y;
  transform.transform.rotation.w = 1.0;
  return transform;
}

visualization_msgs::Marker label(const std::string& side, const SceneLayout& layout) {
  visualization_msgs::Marker marker;
  marker.header.stamp = BagWriter::stamp(0.0);
  marker.header.frame_id = side;
  marker.ns = side;
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.text = side;
  marker.pose.position.z = layout.label_height;
  marker.pose.orientation.w = 1.0;
  marker.scale.z = layout.label_size;
  marker.color.a = 1.0F;
  return marker;
}

void write_head(const JobRecord& record, const SceneLayout& layout, BagWriter* writer) {
  writer->write_text("study", record.study);
  writer->write_text("initial/robot_description", record.initial.urdf);
  writer->write_text("tuned/robot_description", record.tuned.urdf);
  writer->write_latched("request", 0.0, record.request);
  tf2_msgs::TFMessage places;
  places.transforms = {place("initial", 0.5 * layout.separation), place("tuned", -0.5 * layout.separation)};
  writer->write_latched("tf_static", 0.0, places);
  visualization_msgs::MarkerArray labels;
  labels.markers = {label("initial", layout), label("tuned", layout)};
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

void write_contents(const JobRecord& record, BagWriter* writer) {
  const SceneLayout layout = lay_out(record.initial.run, record.tuned.run);
  write_head(record, layout, writer);
  const std::size_t count = std::max(record.initial.run.frames.size(), record.tuned.run.frames.size());
  double duration = 0.0;
  for (const RecordedRun* run : {&record.initial.run, &record.tuned.run})
    if (!run->frames.empty()) duration = std::max(duration, run->frames.back().time);
  for (std::size_t i = 0; i < count; ++i) {
    write_frame("initial", record.initial.run, i, layout.style, writer);
    write_frame("tuned", record.tuned.run, i, layout.style, writer);
  }
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
