// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/job_bag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "math/arrays.h"
#include "reading/urdf/pictures.h"
#include "ros/bags/bag_writer.h"
#include "ros/scene/event_markers.h"
#include "ros/scene/scene_layout.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr std::array<const char*, 3> kStageNames{"screening", "searching", "validating"};

std::string with_objective(const std::string& name, double objective) {
  return std::isfinite(objective) ? name + ", objective " + readable(objective, 4) : name;
}

/// One design in one run.
struct ShownSide {
  ShownSide(std::string side, const BagSide& from)
      : name(std::move(side)),
        run(from.run),
        drawn(with_sticks(from.urdf)),
        solids(std::make_shared<LinkBoxes>(link_boxes(drawn, run.names.links))) {}

  std::string name;
  const RecordedRun& run;
  std::string drawn;  ///< the URDF, with sticks
  std::shared_ptr<const LinkBoxes> solids;
};

/// Both designs in one run, below a prefix of their topics.
struct ShownRuns {
  std::string place;
  std::array<ShownSide, 2> sides;
};

/// Writes one bag.
class JobBagWriter {
 public:
  JobBagWriter(const std::string& path, const JobRecord& record) : record_(record), writer_(path) {
    const auto add = [this](const std::string& place, const BagRuns& runs) {
      runs_.push_back(
          {place, {ShownSide("initial", runs.initial), ShownSide("tuned", runs.tuned)}});
    };
    add("", record.nominal);
    if (record.worst) add("worst/", *record.worst);
    std::vector<ShownRun> shown;
    for (const ShownRuns& runs : runs_)
      for (const ShownSide& side : runs.sides)
        shown.push_back({side.run.names, side.run.frames, side.solids});
    layout_ = lay_out(shown);
    legend_ = arrow_legend(layout_);
  }

  void write() {
    writer_.write_text("study", record_.study);
    for (const std::string& file : record_.study_files) writer_.write_text("study_files", file);
    writer_.write_latched("request", 0.0, record_.request);
    write_places();
    for (const ShownRuns& runs : runs_) write_runs(runs);
    double duration = 0.0;
    for (const ShownSide& side : runs_.front().sides)
      if (!side.run.frames.empty()) duration = std::max(duration, side.run.frames.back().time);
    write_trials(duration);
    writer_.write_latched("result", duration, record_.result);
    writer_.finish();
  }

 private:
  /// The arrangements of both mechanisms in rviz: side by side, and one over the other.
  void write_places() {
    const Stage beside = write_place("", layout_.apart),
                over = write_place("overlay/", Eigen::Vector3d::Zero());
    const std::string initial = with_objective("initial", record_.result.initial_objective);
    const std::string tuned = with_objective("tuned", record_.result.objective);
    write_labels("", {label("initial", "initial", initial, beside, begin_),
                      label("tuned", "tuned", tuned, beside, begin_)});
    write_labels("overlay/",
                 {label("tuned", "tuned", tuned + "; ghost: " + initial, over, begin_)});
  }

  /// @param apart vector from the initial to the tuned mechanism. @returns the view of both.
  Stage write_place(const std::string& place, const Eigen::Vector3d& apart) {
    Stage stage =
        stage_of(layout_, {-0.5 * apart, 0.5 * apart}, 1 + static_cast<int>(legend_.size()));
    tf2_msgs::TFMessage places;
    places.transforms = {place_in_world("initial", -0.5 * apart, begin_),
                         place_in_world("tuned", 0.5 * apart, begin_),
                         place_in_world("caption", stage.caption, begin_)};
    writer_.write_latched(place + "tf_static", 0.0, places);
    stage.scene.header = header_of({begin_, "world"});
    writer_.write_latched(place + "scene", 0.0, stage.scene);
    return stage;
  }

  void write_labels(const std::string& place,
                    const std::vector<visualization_msgs::Marker>& markers) {
    visualization_msgs::MarkerArray labels;
    labels.markers = markers;
    writer_.write_latched(place + "labels", 0.0, labels);
  }

  void write_runs(const ShownRuns& runs) {
    std::size_t count = 0;
    for (const ShownSide& side : runs.sides) {
      writer_.write_text(runs.place + side.name + "/robot_description", side.drawn);
      count = std::max(count, side.run.frames.size());
    }
    for (std::size_t index = 0; index < count; ++index) {
      for (const ShownSide& side : runs.sides)
        if (index < side.run.frames.size()) write_frame(runs.place, side, side.run.frames[index]);
      write_caption(runs, index);
    }
    for (const ShownSide& side : runs.sides) write_events(runs.place, side);
  }

  /// The events between the first and the last frame.
  void write_events(const std::string& place, const ShownSide& side) {
    const std::string prefix = side.name + "/";
    const std::vector<Frame>& frames = side.run.frames;
    for (std::size_t k = 0; k < side.run.events.size(); ++k) {
      const Event& event = side.run.events[k].event;
      const auto frame = std::find_if(frames.begin(), frames.end(),
                                      [&](const Frame& f) { return f.time >= event.time; });
      if (frame == frames.end()) return;
      const MessageContext context{BagWriter::stamp(event.time), prefix + side.run.names.links[0]};
      writer_.write(place + prefix + "events", event.time, event_message(event, context));
      writer_.write(place + prefix + "event_markers", event.time,
                    event_markers(side.run, k, *frame, layout_, context));
    }
  }

  void write_frame(const std::string& place, const ShownSide& side, const Frame& frame) {
    const std::string prefix = side.name + "/";
    MarkerStyle style = layout_.style;
    style.solids = side.solids;
    writer_.write_frame(place + prefix, prefix + side.run.names.links[0], side.run.names, frame,
                        style);
    writer_.write(place + "tf", frame.time,
                  placed_link_transforms(side.run.names, side.run.link_parents, frame,
                                         BagWriter::stamp(frame.time), prefix));
  }

  /// The text of an instant: time, the objective of each run so far, and the legend of the arrows.
  void write_caption(const ShownRuns& runs, std::size_t index) {
    double time = 0.0;
    std::string text = "objective so far:";
    for (const ShownSide& side : runs.sides) {
      if (index >= side.run.frames.size()) continue;
      time = side.run.frames[index].time;
      text += " " + side.name + " " + readable(side.run.frames[index].objective, 4);
    }
    std::vector<CaptionLine> lines{plain_line("t = " + readable(time, 4) + " s, " + text)};
    lines.insert(lines.end(), legend_.begin(), legend_.end());
    writer_.write(
        runs.place + "caption", time,
        caption(lines, layout_, Eigen::Vector3d::Zero(), {BagWriter::stamp(time), "caption"}));
  }

  void write_trials(double duration) {
    const double spacing =
        duration / static_cast<double>(std::max<std::size_t>(record_.trials.size(), 2) - 1);
    double time = 0.0;
    for (const LoggedTrial& logged : record_.trials) {
      mechanism_codesign::OptimizationProgress message =
          optimization_progress(logged.trial, record_.result.job, record_.result.parameters);
      set_progress(logged.progress, &message);
      message.header.stamp = BagWriter::stamp(time);
      writer_.write_latched("optimization_progress", time, message);
      time += spacing;
    }
  }

  const JobRecord& record_;
  BagWriter writer_;
  const ros::Time begin_ = BagWriter::stamp(0.0);
  std::vector<ShownRuns> runs_;
  SceneLayout layout_;
  std::vector<CaptionLine> legend_;
};

}  // namespace

void write_bag(const std::string& path, const JobRecord& record) {
  JobBagWriter(path, record).write();
}

std::vector<double> to_array(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

mechanism_codesign::OptimizationProgress optimization_progress(
    const Trial& trial, const std::string& job, const std::vector<std::string>& parameters) {
  mechanism_codesign::OptimizationProgress message;
  message.job = job;
  message.evaluation = static_cast<std::uint32_t>(trial.evaluation);
  message.iteration = static_cast<std::uint32_t>(trial.iteration);
  message.code = name_of(trial.status.code);
  message.message = trial.status.cause;
  message.objective = trial.objective;
  message.best_objective = trial.best_objective;
  message.gradient_norm = trial.gradient_norm;
  message.search = static_cast<std::uint32_t>(trial.start);
  message.parameters = parameters;
  message.values = to_array(trial.rho);
  message.gradient = to_array(trial.gradient);
  return message;
}

void set_progress(const Progress& progress, mechanism_codesign::OptimizationProgress* message) {
  message->stage = kStageNames[to_index(progress.stage)];
  message->done = static_cast<std::uint64_t>(progress.done);
  message->of = static_cast<std::uint64_t>(progress.of);
  message->runs = static_cast<std::uint64_t>(progress.runs);
  message->remembered_runs = static_cast<std::uint64_t>(progress.remembered);
  message->runs_per_second = progress.runs_per_second;
  message->seconds_left = progress.seconds_left.value_or(std::numeric_limits<double>::quiet_NaN());
  message->at_most = progress.is_bound;
}

}  // namespace codesign
