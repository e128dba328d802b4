// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/ros/job_bag.h"

#include <rosbag/bag.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <filesystem>

#include "mechanism_codesign/ros/frame_messages.h"

namespace codesign {
namespace {

/// rosbag refuses stamps near zero.
constexpr double kStart = 1.0;

class Writer {
 public:
  explicit Writer(const std::string& path) : bag_(path, rosbag::bagmode::Write) {}

  /// Writes the index; to be called, since a destructor cannot report a full disk.
  void close() { bag_.close(); }

  template <class Message>
  void write(const std::string& topic, double time, const Message& message) {
    bag_.write(topic, ros::Time(kStart + time), message);
  }

  /// As `rosbag record` marks a latched topic, so that `rosbag play` latches it again.
  template <class Message>
  void write_latched(const std::string& topic, double time, const Message& message) {
    auto header = boost::make_shared<ros::M_string>();
    (*header)["type"] = ros::message_traits::datatype(message);
    (*header)["md5sum"] = ros::message_traits::md5sum(message);
    (*header)["message_definition"] = ros::message_traits::definition(message);
    (*header)["latching"] = "1";
    bag_.write(topic, ros::Time(kStart + time), message, header);
  }

  void write_text(const std::string& topic, const std::string& text) {
    std_msgs::String message;
    message.data = text;
    write_latched(topic, 0.0, message);
  }

  void write_frame(const std::string& side, const RecordedRun& run, std::size_t index, const MarkerStyle& style) {
    if (index >= run.frames.size()) return;
    const Frame& frame = run.frames[index];
    const std::string prefix = side + "/";
    const MessageContext context{ros::Time(kStart + frame.time), prefix + run.names.links[0]};
    FrameMessages(run.names, frame, context, style).visit([&](const std::string& topic, const auto& message) {
      write(prefix + topic, frame.time, message);
    });
    write("tf", frame.time, all_link_transforms(run.names, frame, context.stamp, prefix));
  }

 private:
  rosbag::Bag bag_;
};

geometry_msgs::TransformStamped place(const std::string& side, double y) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time(kStart);
  transform.header.frame_id = "world";
  transform.child_frame_id = side;
  transform.transform.translation.y = y;
  transform.transform.rotation.w = 1.0;
  return transform;
}

visualization_msgs::Marker label(const std::string& side, const SceneLayout& layout) {
  visualization_msgs::Marker marker;
  marker.header.stamp = ros::Time(kStart);
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

void write_head(const JobRecord& record, const SceneLayout& layout, Writer* writer) {
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

void write_progress(const JobRecord& record, double duration, Writer* writer) {
  const double spacing = duration / static_cast<double>(std::max<std::size_t>(record.progress.size(), 2) - 1);
  double time = 0.0;
  for (mechanism_codesign::OptimizationProgress progress : record.progress) {
    progress.header.stamp = ros::Time(kStart + time);
    writer->write_latched("optimization_progress", time, progress);
    time += spacing;
  }
}

void write_contents(const JobRecord& record, Writer* writer) {
  const SceneLayout layout = lay_out(record.initial.run, record.tuned.run);
  write_head(record, layout, writer);
  const std::size_t count = std::max(record.initial.run.frames.size(), record.tuned.run.frames.size());
  double duration = 0.0;
  for (const RecordedRun* run : {&record.initial.run, &record.tuned.run})
    if (!run->frames.empty()) duration = std::max(duration, run->frames.back().time);
  for (std::size_t i = 0; i < count; ++i) {
    writer->write_frame("initial", record.initial.run, i, layout.style);
    writer->write_frame("tuned", record.tuned.run, i, layout.style);
  }
  write_progress(record, duration, writer);
  writer->write_latched("result", duration, record.result);
}

std::string file_name_of(std::string robot) {
  for (char& c : robot)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return robot.empty() ? "robot" : robot;
}

}  // namespace

std::string new_bag_path(const std::string& directory, const std::string& robot) {
  std::filesystem::create_directories(directory);
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char stamp[32];
  std::strftime(stamp, sizeof(stamp), "%Y-%m-%d-%H-%M-%S", &local);
  const std::string stem = (std::filesystem::path(directory) / (file_name_of(robot) + "_" + stamp)).string();
  std::string path = stem + ".bag";
  for (int i = 2; std::filesystem::exists(path) || std::filesystem::exists(path + ".active"); ++i)
    path = stem + "-" + std::to_string(i) + ".bag";
  return path;
}

void write_bag(const std::string& path, const JobRecord& record) {
  const std::string active = path + ".active";
  Writer writer(active);
  write_contents(record, &writer);
  writer.close();
  std::filesystem::rename(active, path);
}

}  // namespace codesign
