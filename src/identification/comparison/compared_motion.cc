// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/comparison/compared_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "description/study.h"
#include "identification/effort/effort_residuals.h"
#include "identification/effort/motion_projection.h"
#include "identification/fit/given_motion.h"
#include "math/arrays.h"
#include "observation/observer.h"
#include "problem/load_problem.h"
#include "recordings/measured_motion.h"

namespace codesign {
namespace {

/// Limit for the frames of all recordings [bytes].
constexpr double kMostMemory = 256e6;

double bytes_of_both(const FrameNames& names) {
  return 2.0 * static_cast<double>(sizeof(Frame) + names.joints.size() * sizeof(JointSample) +
                                   names.links.size() * sizeof(LinkSample) +
                                   names.frictions.size() * sizeof(FrictionSample) +
                                   names.loops.size() * sizeof(double));
}

/// Columns of the fitted series with the simulated motion of a joint, theory (40); -1: none, the
/// model has the measured motion.
struct SimulatedColumns {
  Eigen::Index position = -1, velocity = -1, effort = -1;
};

SimulatedColumns simulated_columns(const std::vector<OutputFit>& outputs,
                                   const std::string& joint) {
  const auto column = [&](MeasuredQuantity quantity) -> Eigen::Index {
    const std::string name = joint + "/" + kMeasuredQuantityNames[to_index(quantity)];
    for (std::size_t k = 0; k < outputs.size(); ++k)
      if (outputs[k].joint == name) return to_signed(k);
    return -1;
  };
  return {column(MeasuredQuantity::kPosition), column(MeasuredQuantity::kVelocity),
          column(MeasuredQuantity::kEffort)};
}

/// A measured joint in one recording.
struct ShownJoint {
  const JointMotion* motion;
  std::size_t place;                     ///< index in FrameNames::joints
  std::optional<RecordedEffort> effort;  ///< empty: not recorded
  EffortSensor sensor;                   ///< the identified one
  SimulatedColumns simulated;

  /// The effort on the child by the sensor, theory (28c) solved for tau.
  double recorded(double time) const {
    if (!effort) return std::numeric_limits<double>::quiet_NaN();
    return sensor.scale * effort->at(time + sensor.delay).value - sensor.offset;
  }
};

/// An instant to show: index of the sample in the measured motion, and row of the series if the
/// series has a simulated motion.
struct Instant {
  double time = 0.0;
  Eigen::Index sample = 0, row = -1;
};

std::vector<ShownJoint> shown_joints(const MeasuredMotion& motion,
                                     const std::vector<MeasuredJoint>& joints,
                                     const FitVariables& variables,
                                     const IdentificationResult& result, const FrameNames& names) {
  std::vector<double> times;
  times.reserve(to_index(motion.times.count));
  for (Eigen::Index k = 0; k < motion.times.count; ++k) times.push_back(motion.times.at(k));
  std::vector<ShownJoint> shown;
  for (const MeasuredJoint& joint : joints) {
    const auto of = std::find_if(motion.joints.begin(), motion.joints.end(),
                                 [&](const JointMotion& each) { return each.joint == joint.name; });
    const auto place =
        std::find(names.joints.begin(), names.joints.end(), joint.name) - names.joints.begin();
    shown.push_back({&*of, to_index(place), std::nullopt, variables.sensor(joint.name, result.x),
                     simulated_columns(result.data, joint.name)});
    if (joint.with_effort)
      shown.back().effort.emplace(times, std::vector<double>(of->effort.begin(), of->effort.end()));
  }
  return shown;
}

Eigen::VectorXd positions_at(const MeasuredMotion& motion, const std::vector<MeasuredJoint>& joints,
                             Eigen::Index sample) {
  Eigen::VectorXd positions(to_signed(joints.size()));
  for (std::size_t k = 0; k < joints.size(); ++k)
    for (const JointMotion& each : motion.joints)
      if (each.joint == joints[k].name) positions[to_signed(k)] = each.position[sample];
  return positions;
}

/// Shifts positions that were integrated from a fitted start to the identified start.
void shift_to_fitted_starts(const FitVariables& variables, const Eigen::VectorXd& x,
                            MeasuredMotion* motion) {
  for (JointMotion& joint : motion->joints)
    if (const int column = variables.start_column(motion->element, joint.joint);
        column >= 0 && column < x.size())
      joint.position.array() += x[column] - variables.start()[column];
}

/// Positions at a few instants, from which the drives are chosen.
Eigen::MatrixXd some_positions(const MeasuredMotion& motion,
                               const std::vector<MeasuredJoint>& joints) {
  constexpr int kInstants = 4;
  Eigen::MatrixXd some(to_signed(joints.size()), kInstants);
  for (int k = 0; k < kInstants; ++k)
    some.col(k) = positions_at(motion, joints,
                               motion.first + k * (motion.end - motion.first - 1) / kInstants);
  return some;
}

/// The measured frame: `model` with the measured values in place of the computed ones, and without
/// efforts and frictions that were not measured.
Frame measured_frame(const Frame& model, const std::vector<ShownJoint>& joints, Eigen::Index sample,
                     double time) {
  Frame frame = model;
  frame.frictions.clear();
  for (JointSample& joint : frame.joints) joint.effort = std::numeric_limits<double>::quiet_NaN();
  for (const ShownJoint& joint : joints)
    frame.joints[joint.place] = {joint.motion->position[sample], joint.motion->velocity[sample],
                                 joint.motion->acceleration[sample], joint.recorded(time)};
  return frame;
}

std::vector<ComparedJoint> compared_joints(const RobotDescription& robot,
                                           const std::vector<MeasuredJoint>& measured,
                                           const std::vector<double>& parameters,
                                           const FrameNames& names) {
  std::vector<ComparedJoint> joints;
  for (const JointDescription& joint : robot.joints) {
    const auto is_compared = [&](const MeasuredJoint& each) {
      return each.name == joint.name && each.with_effort;
    };
    if (joint.is_loop || std::none_of(measured.begin(), measured.end(), is_compared)) continue;
    const auto place =
        std::find(names.joints.begin(), names.joints.end(), joint.name) - names.joints.begin();
    const Eigen::Vector3d axis(joint.axis[0].at(parameters), joint.axis[1].at(parameters),
                               joint.axis[2].at(parameters));
    joints.push_back(
        {to_index(place), to_index(joint.child), axis.normalized(), !joint.is_slide()});
  }
  return joints;
}

/// Samples to show of a recording, `rate` per second [Hz].
std::vector<Instant> instants_of(const MeasuredMotion& motion, double rate) {
  const auto every = std::max<Eigen::Index>(1, std::llround(motion.times.rate() / rate));
  std::vector<Instant> instants;
  for (Eigen::Index k = motion.first; k < motion.end; k += every)
    instants.push_back({motion.times.at(k), k, -1});
  return instants;
}

/// The same for a simulated motion, which is known only at the rows of the series.
std::vector<Instant> instants_of(const MeasuredMotion& motion, const FittedSeries& series,
                                 Eigen::Index begin, Eigen::Index end, double rate) {
  std::vector<Instant> instants;
  for (Eigen::Index row = begin; row < end; ++row) {
    const double time = series.times[to_index(row)];
    if (!instants.empty() && time - instants.back().time < 0.999 / rate) continue;
    const auto sample = to_signed(std::llround((time - motion.times.start) / motion.times.step));
    instants.push_back({time, std::clamp<Eigen::Index>(sample, 0, motion.times.count - 1), row});
  }
  return instants;
}

/// Shows the recordings of one result, one after the other.
class MotionComparison {
 public:
  MotionComparison(const Problem& problem, const std::vector<double>& parameters,
                   const std::vector<MeasuredJoint>& joints, const MeasuredMotion& first,
                   const std::function<bool()>& stop)
      : stop_(stop),
        is_simulated_(study_of(problem).identification->residual == ResidualKind::kMotion),
        model_(*system_of(problem), joints, some_positions(first, joints), parameters) {
    if (is_simulated_)
      measured_.emplace(*system_of(problem), joints, some_positions(first, joints), parameters);
  }

  const FrameNames& names() const { return model_.names(); }
  bool is_simulated() const { return is_simulated_; }

  void compare(const std::vector<ShownJoint>& joints, const std::vector<Instant>& instants,
               const FittedSeries& series, ComparedRecording* compared) {
    for (const Instant& instant : instants) {
      if (stop_ && stop_()) compared->status = {StatusCode::kCancelled, instant.time, "cancelled"};
      if (compared->status.ok()) show(joints, instant, series, compared);
      if (compared->status.ok()) continue;
      compared->status.time = instant.time;
      return;
    }
  }

 private:
  void show(const std::vector<ShownJoint>& joints, const Instant& instant,
            const FittedSeries& series, ComparedRecording* compared) {
    Eigen::VectorXd given[3], simulated[3];
    for (Eigen::VectorXd& column : given) column.resize(to_signed(joints.size()));
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const auto row = to_signed(j);
      given[0][row] = joints[j].motion->position[instant.sample];
      given[1][row] = joints[j].motion->velocity[instant.sample];
      given[2][row] = joints[j].motion->acceleration[instant.sample];
    }
    for (int order = 0; order < 3; ++order) simulated[order] = given[order];
    for (std::size_t j = 0; j < joints.size() && instant.row >= 0; ++j) {
      const auto row = to_signed(j);
      const SimulatedColumns& at = joints[j].simulated;
      if (at.position >= 0) simulated[0][row] = series.computed(instant.row, at.position);
      if (at.velocity >= 0) simulated[1][row] = series.computed(instant.row, at.velocity);
    }
    const bool is_first = compared->model.empty();
    Frame model, measured;
    Status& status = compared->status;
    status = show(instant.time, simulated, is_first, &model_, &model);
    if (status.ok() && measured_)
      status = show(instant.time, given, is_first, &*measured_, &measured);
    if (!status.ok()) return;
    compared->measured.push_back(
        measured_frame(measured_ ? measured : model, joints, instant.sample, instant.time));
    if (is_simulated_) set_efforts(joints, instant, series, &model);
    compared->model.push_back(std::move(model));
  }

  static Status show(double time, const Eigen::VectorXd (&given)[3], bool is_first,
                     DrivenReplay* replay, Frame* frame) {
    if (is_first)
      if (Status status = replay->begin(given[0]); !status.ok()) return status;
    return replay->show(time, given, frame);
  }

  /// The efforts of a simulated motion: computed by its controllers, or recorded and applied to the
  /// model.
  static void set_efforts(const std::vector<ShownJoint>& joints, const Instant& instant,
                          const FittedSeries& series, Frame* model) {
    for (const ShownJoint& joint : joints)
      model->joints[joint.place].effort = joint.simulated.effort >= 0
                                              ? series.computed(instant.row, joint.simulated.effort)
                                              : joint.recorded(instant.time);
  }

  const std::function<bool()>& stop_;
  const bool is_simulated_;
  DrivenReplay model_;
  /// for a simulated motion, where measured and simulated positions differ
  std::optional<DrivenReplay> measured_;
};

/// The begin of each recording in the rows of a series, and their number.
std::vector<Eigen::Index> begins_of(const FittedSeries& series) {
  std::vector<Eigen::Index> begins{0};
  for (const Eigen::Index length : series.lengths) begins.push_back(begins.back() + length);
  return begins;
}

void compare_all(const Problem& problem, const StudyRecordings& recordings,
                 const IdentificationResult& result, double rate, const std::function<bool()>& stop,
                 ComparedMotion* compared) {
  std::vector<JointRecording> all = recordings.data;
  all.insert(all.end(), recordings.holdout.begin(), recordings.holdout.end());
  const std::vector<MeasuredJoint> joints = require_same_joints(all);
  std::vector<MeasuredMotion> motions;
  Warnings known_warnings;
  double seconds = 0.0;
  for (const JointRecording& recording : all) {
    motions.push_back(
        measured_motion(recording, study_of(problem).identification->filter, &known_warnings));
    seconds +=
        static_cast<double>(motions.back().end - motions.back().first) * motions.back().times.step;
  }
  const FitVariables variables(study_of(problem));
  for (MeasuredMotion& motion : motions) shift_to_fitted_starts(variables, result.x, &motion);
  MotionComparison comparison(problem, result.parameters, joints, motions.front(), stop);
  compared->names = comparison.names();
  compared->link_parents = link_parents(robot_of(problem));
  compared->joints = compared_joints(robot_of(problem), joints, result.parameters, compared->names);
  const double shown_rate =
      std::min(rate, kMostMemory / (bytes_of_both(compared->names) * std::max(seconds, 1e-3)));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool is_data = k < recordings.data.size();
    const FittedSeries& series = is_data ? result.data_series : result.holdout_series;
    const std::size_t of_series = is_data ? k : k - recordings.data.size();
    const std::vector<Eigen::Index> begins = begins_of(series);
    std::vector<Instant> instants;
    if (!comparison.is_simulated())
      instants = instants_of(motions[k], shown_rate);
    else if (of_series + 1 < begins.size())
      instants =
          instants_of(motions[k], series, begins[of_series], begins[of_series + 1], shown_rate);
    std::optional<MotionComparison> with_settings;
    if (!all[k].settings.empty()) {
      const FitVariables own(study_of(problem), nullptr, all[k].settings);
      with_settings.emplace(problem, own.parameters(result.x), joints, motions[k], stop);
    }
    (with_settings ? *with_settings : comparison)
        .compare(shown_joints(motions[k], joints, variables, result, compared->names), instants,
                 series, &compared->recordings[k]);
  }
}

}  // namespace

ComparedMotion compare_motion(const Problem& problem, const StudyRecordings& recordings,
                              const IdentificationResult& result, double rate,
                              const std::function<bool()>& stop) {
  ComparedMotion compared;
  for (const std::vector<JointRecording>* list : {&recordings.data, &recordings.holdout})
    for (const JointRecording& recording : *list)
      compared.recordings.push_back({recording.element, {}, {}, {}});
  try {
    const std::optional<StudyRecordings> completed = with_given_motions(problem, recordings);
    compare_all(problem, completed ? *completed : recordings, result, rate, stop, &compared);
  } catch (const InputError& error) {
    for (ComparedRecording& recording : compared.recordings)
      recording.status = {StatusCode::kAssemblyFailed, 0.0,
                          "the motion cannot be shown: " + std::string(error.what())};
  }
  return compared;
}

}  // namespace codesign
