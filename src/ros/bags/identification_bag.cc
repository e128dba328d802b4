// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/job_bag.h"

#include <mechanism_codesign/Residuals.h>

#include <algorithm>
#include <cstdint>
#include <memory>

#include "math/arrays.h"
#include "reading/urdf/pictures.h"
#include "ros/bags/bag_writer.h"
#include "ros/scene/markers.h"
#include "ros/scene/scene_layout.h"

namespace codesign {
namespace {

/// Pause between two recordings [s].
constexpr double kPause = 0.5;
/// Largest number of messages with residuals in a bag; residuals.csv has all residuals.
constexpr Eigen::Index kMostResiduals = 10000;

/// Rows of a series that belong to one recording.
struct SeriesPart {
  const FittedSeries* series;
  Eigen::Index begin, end;
};

std::vector<SeriesPart> parts_of(const IdentificationShow& show) {
  std::vector<SeriesPart> parts;
  for (const FittedSeries* series : {&show.data, &show.holdout}) {
    Eigen::Index row = 0;
    for (const Eigen::Index length : series->lengths) {
      parts.push_back({series, row, row + length});
      row += length;
    }
  }
  return parts;
}

/// Writes one bag.
class ShowWriter {
 public:
  ShowWriter(const std::string& path, const IdentificationShow& show,
             const IdentificationAnswer* answer)
      : show_(show), answer_(answer), writer_(path), drawn_(with_sticks(show.urdf)) {
    const auto solids = std::make_shared<LinkBoxes>(link_boxes(drawn_, show.motion.names.links));
    std::vector<ShownRun> runs;
    for (const ComparedRecording& recording : show.motion.recordings)
      runs.push_back({show.motion.names, recording.model, solids});
    layout_ = lay_out(runs);
    efforts_ = effort_style(show.motion, layout_.size);
    efforts_.towards_viewer = layout_.view.towards_viewer();
    efforts_.solids = solids;
    // The arrows of friction have the same scale, since the friction of a joint is a part of its
    // effort.
    if (!show.motion.joints.empty()) layout_.style = efforts_;
    layout_.style.solids = solids;
    legend_ = effort_legend(efforts_, show.motion);
    const std::vector<CaptionLine> friction = arrow_legend(layout_);
    legend_.insert(legend_.end(), friction.begin(), friction.end());
    stage_ = stage_of(layout_, {Eigen::Vector3d::Zero()}, 1 + static_cast<int>(legend_.size()));
  }

  void write() {
    write_head();
    const std::vector<SeriesPart> parts = parts_of(show_);
    for (std::size_t k = 0; k < std::max(parts.size(), show_.motion.recordings.size()); ++k) {
      const double begin = k == 0 ? 0.0 : end_ + kPause;
      end_ = begin;
      if (k < show_.motion.recordings.size()) write_motion(show_.motion.recordings[k], begin);
      if (k < parts.size()) write_residuals(parts[k], element(k), begin);
    }
    write_tail();
    writer_.finish();
  }

 private:
  std::string element(std::size_t k) const {
    return k < show_.motion.recordings.size() ? show_.motion.recordings[k].element : "";
  }

  void write_head() {
    writer_.write_text("study", show_.study);
    writer_.write_text("identification", show_.json);
    if (answer_) writer_.write_latched("request", 0.0, answer_->request);
    // The measured robot is shown with the identified dimensions.
    for (const char* side : {"measured", "identified"})
      writer_.write_text(std::string(side) + "/robot_description", drawn_);
    tf2_msgs::TFMessage places;
    for (const char* side : {"measured", "identified"})
      places.transforms.push_back(
          place_in_world(side, Eigen::Vector3d::Zero(), BagWriter::stamp(0.0)));
    writer_.write_latched("tf_static", 0.0, places);
    stage_.scene.header = header_of({BagWriter::stamp(0.0), "world"});
    writer_.write_latched("scene", 0.0, stage_.scene);
  }

  void write_tail() {
    if (!answer_) return;
    const double spacing =
        end_ / static_cast<double>(std::max<std::size_t>(answer_->progress.size(), 2) - 1);
    double time = 0.0;
    for (mechanism_codesign::IdentificationProgress progress : answer_->progress) {
      progress.header.stamp = BagWriter::stamp(time);
      writer_.write_latched("identification_progress", time, progress);
      time += spacing;
    }
    writer_.write_latched("result", end_, answer_->result);
  }

  /// @param begin the begin of the recording in the bag [s].
  void write_motion(const ComparedRecording& recording, double begin) {
    std::vector<CaptionLine> lines{plain_line(recording.element)};
    lines.insert(lines.end(), legend_.begin(), legend_.end());
    writer_.write_latched(
        "labels", begin,
        caption(lines, layout_, stage_.caption, {BagWriter::stamp(begin), "world"}));
    for (std::size_t k = 0; k < recording.model.size(); ++k) {
      const double time = begin + recording.model[k].time - recording.model.front().time;
      write_measured(recording.measured[k], time);
      write_model(recording.model[k], time);
      const MessageContext context{BagWriter::stamp(time),
                                   "identified/" + show_.motion.names.links[0]};
      writer_.write("efforts", time,
                    effort_markers(show_.motion, recording.measured[k], recording.model[k], context,
                                   efforts_));
      end_ = std::max(end_, time);
    }
  }

  void write_measured(const Frame& frame, double time) {
    const FrameNames& names = show_.motion.names;
    const ros::Time stamp = BagWriter::stamp(time);
    writer_.write("measured/joint_states", time,
                  joint_states(names, frame, {stamp, "measured/" + names.links[0]}));
    writer_.write(
        "tf", time,
        placed_link_transforms(names, show_.motion.link_parents, frame, stamp, "measured/"));
  }

  void write_model(Frame frame, double time) {
    const FrameNames& names = show_.motion.names;
    frame.time = time;
    writer_.write_frame("identified/", "identified/" + names.links[0], names, frame, layout_.style);
    writer_.write("tf", time,
                  placed_link_transforms(names, show_.motion.link_parents, frame,
                                         BagWriter::stamp(time), "identified/"));
  }

  void write_residuals(const SeriesPart& part, const std::string& recording, double begin) {
    const FittedSeries& series = *part.series;
    const Eigen::Index rows = show_.data.recorded.rows() + show_.holdout.recorded.rows();
    for (Eigen::Index row = part.begin; row < part.end; row += 1 + rows / kMostResiduals) {
      const double clock = series.times[to_index(row)];
      const double time = begin + clock - series.times[to_index(part.begin)];
      mechanism_codesign::Residuals message;
      message.header.stamp = BagWriter::stamp(time);
      message.recording = recording;
      message.time = clock;
      message.name = show_.joints;
      for (Eigen::Index k = 0; k < series.recorded.cols(); ++k) {
        message.recorded.push_back(series.recorded(row, k));
        message.computed.push_back(series.computed(row, k));
        message.residual.push_back(series.computed(row, k) - series.recorded(row, k));
      }
      writer_.write("residuals", time, message);
      end_ = std::max(end_, time);
    }
  }

  const IdentificationShow& show_;
  const IdentificationAnswer* answer_;
  BagWriter writer_;
  const std::string drawn_;  ///< the URDF, with sticks
  SceneLayout layout_;
  Stage stage_;
  std::vector<CaptionLine> legend_;
  MarkerStyle efforts_;  ///< scales of the arrows of efforts
  double end_ = 0.0;     ///< end of the part written so far
};

}  // namespace

void write_identification_bag(const std::string& path, const IdentificationShow& show,
                              const IdentificationAnswer* answer) {
  ShowWriter(path, show, answer).write();
}

}  // namespace codesign
