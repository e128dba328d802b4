// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/effort_recorder.h"

#include <cmath>
#include <limits>

#include "description/study.h"
#include "identification/effort/motion_projection.h"
#include "jobs/json.h"
#include "jobs/record_json.h"
#include "jobs/run_fields.h"
#include "math/arrays.h"
#include "problem/load_problem.h"
#include "statics/posture_efforts.h"
#include "statics/setpoint_motion.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

void note(double value, const std::vector<double>& at, Extreme* extreme) {
  if (extreme->at.empty() || std::abs(value) > std::abs(extreme->value)) *extreme = {value, at};
}

std::vector<double> list_of(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

DrivenReplay replay_of(const Problem& problem, const SetpointMotion& motion,
                       const std::vector<double>& parameters,
                       const std::vector<SignalDescription>& signals) {
  try {
    return DrivenReplay(*system_of(problem), motion.joints(),
                        motion.some_positions(study_of(problem).duration), parameters, signals);
  } catch (const InputError& error) {
    throw InputError(in_words_of_study(
        error.fault(), "controllers",
        "its motion is not determined: neither `motion` nor the set-point of a controller gives "
        "it, and the joints whose motion they give do not determine it through the loops",
        "motions or set-points of the positions of as many independent joints as there are degrees "
        "of freedom"));
  }
}

/// Sums up what the drives of a motion need.
class MotionNeeds {
 public:
  explicit MotionNeeds(const DrivenReplay& replay) : places_(replay.drives()) {
    for (const std::size_t place : places_)
      drives_.push_back({replay.names().joints[place],
                         {{"effort", {}}, {"velocity", {}}, {"power", {}}},
                         {{"rms_effort", 0.0}, {"work", 0.0}}});
    last_power_.resize(places_.size());
  }

  /// @param step time since the last frame [s].
  void observe(const Frame& frame, double step) {
    ++rows_;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const JointSample& joint = frame.joints[places_[k]];
      const double power = joint.effort * joint.velocity;
      note(joint.effort, {frame.time}, &drives_[k].extremes[0].second);
      note(joint.velocity, {frame.time}, &drives_[k].extremes[1].second);
      note(power, {frame.time}, &drives_[k].extremes[2].second);
      drives_[k].totals[0].second += joint.effort * joint.effort;
      if (rows_ > 1) drives_[k].totals[1].second += 0.5 * step * (power + last_power_[k]);
      last_power_[k] = power;
    }
  }

  std::vector<DriveNeeds> needs() const {
    std::vector<DriveNeeds> needs = drives_;
    for (DriveNeeds& drive : needs)
      if (rows_ > 0)
        drive.totals[0].second = std::sqrt(drive.totals[0].second / static_cast<double>(rows_));
    return needs;
  }

 private:
  const std::vector<std::size_t> places_;
  std::vector<DriveNeeds> drives_;
  std::vector<double> last_power_;
  std::size_t rows_ = 0;
};

EffortSummary record_motion(const Problem& problem, const std::vector<double>& parameters,
                            const std::vector<SignalDescription>& signals, int samples,
                            const RowSink& sink, const std::atomic<bool>* cancel) {
  if (const auto& until = study_of(problem).until)
    throw InputError(
        {until->where, "until",
         "efforts follow a motion that is given, without a run that would find its end",
         until->text, "a study without until"});
  const double duration = duration_at(study_of(problem), parameters);
  const SetpointMotion motion(study_of(problem), parameters);
  DrivenReplay replay = replay_of(problem, motion, parameters, signals);
  LimitOptions enforced = study_of(problem).limits;
  enforced.effort = false;  // no controller keeps it
  LimitWatch limits(problem, parameters, replay.names(), enforced);
  MotionNeeds needs(replay);
  EffortSummary summary;
  Eigen::VectorXd given[3];
  Frame frame;
  for (int k = 0; k < samples && summary.status.ok(); ++k) {
    const double time = duration * k / (samples - 1);
    motion.at(time, &given);
    if (is_set(cancel)) summary.status = {StatusCode::kCancelled, time, "cancelled"};
    if (summary.status.ok() && k == 0) summary.status = replay.begin(given[0]);
    if (summary.status.ok()) summary.status = replay.show(time, given, &frame);
    summary.status.time = time;
    if (!summary.status.ok()) break;
    limits.observe(frame);
    needs.observe(frame, duration / (samples - 1));
    std::vector<double> row(1, time);
    for (const std::size_t place : replay.drives()) {
      const JointSample& joint = frame.joints[place];
      row.insert(row.end(), {joint.position, joint.velocity, joint.acceleration, joint.effort});
    }
    row.insert(row.end(), frame.signals.begin(), frame.signals.end());
    sink(row);
    ++summary.rows;
  }
  summary.drives = needs.needs();
  summary.crossings = limits.crossings();
  return summary;
}

std::vector<DriveNeeds> posture_needs(const PostureGrid& grid) {
  std::vector<DriveNeeds> drives;
  for (const GridJoint& joint : grid)
    drives.push_back({joint.joint, {{"effort", {}}, {"holding", {}}, {"breakaway", {}}}, {}});
  return drives;
}

/// The postures of a grid one after the other, each found from the one before; beyond a singular
/// posture, and where the way to the next one is barred, from the study's guesses.
class PostureRow {
 public:
  explicit PostureRow(PostureStatics* statics) : statics_(*statics) {}

  Status show(const Eigen::VectorXd& positions, Frame* frame, std::vector<PostureEffort>* efforts) {
    const bool was_singular = is_singular_, was_shown = is_shown_;
    Status status;
    if (!has_begun_ || was_singular) status = begin(positions);
    if (has_begun_) status = statics_.show(positions, frame, efforts);
    if (!status.ok() && was_shown && !was_singular && begin(positions).ok())
      status = statics_.show(positions, frame, efforts);
    is_shown_ = status.ok();
    is_singular_ = has_begun_ && statics_.is_singular();
    return status;
  }
  bool is_singular() const { return is_singular_; }

 private:
  Status begin(const Eigen::VectorXd& positions) {
    Status status = statics_.begin(positions);
    has_begun_ = has_begun_ || status.ok();
    return status;
  }

  PostureStatics& statics_;
  bool has_begun_ = false, is_shown_ = false, is_singular_ = false;
};

Warning singular_posture(const PostureGrid& grid, std::size_t first, std::size_t count) {
  const Eigen::VectorXd at = posture(grid, first);
  std::string text;
  for (std::size_t k = 0; k < grid.size(); ++k)
    text += (k > 0 ? ", " : "") + grid[k].joint + " = " + readable(at[to_signed(k)]);
  return warn("singular_posture",
              {grid.front().where, "efforts.grid",
               "at a dead centre, or where several motions meet, the joints of the grid do not "
               "determine how the mechanism moves on, and no effort of theirs moves it; postures "
               "beyond it are found from the study's guesses; choose postures beside it to silence "
               "this",
               text + (count > 1 ? ", and " + std::to_string(count - 1) + " more" : ""), ""});
}

EffortSummary record_postures(const Problem& problem, const std::vector<double>& parameters,
                              const std::vector<SignalDescription>& signals, const RowSink& sink,
                              const std::atomic<bool>* cancel) {
  const PostureGrid& grid = study_of(problem).grid;
  PostureStatics statics(*system_of(problem), grid, parameters, signals);
  EffortSummary summary;
  summary.drives = posture_needs(grid);
  std::vector<PostureEffort> efforts;
  Status last;
  Frame frame;
  PostureRow in_turn(&statics);
  std::size_t singular = 0, first_singular = 0;
  const std::size_t columns = effort_columns(problem, signals).size();
  for (std::size_t k = 0; k < count_postures(grid); ++k) {
    if (is_set(cancel)) summary.status = {StatusCode::kCancelled, 0.0, "cancelled"};
    if (!summary.status.ok()) return summary;
    const Eigen::VectorXd positions = posture(grid, k);
    last = in_turn.show(positions, &frame, &efforts);
    if (in_turn.is_singular() && singular++ == 0) first_singular = k;
    std::vector<double> row = list_of(positions);
    const std::vector<double> at = row;
    if (last.ok()) {
      for (std::size_t d = 0; d < efforts.size(); ++d) {
        const PostureEffort& effort = efforts[d];
        row.insert(row.end(), {effort.rest, effort.lower, effort.upper, effort.holding()});
        note(effort.rest, at, &summary.drives[d].extremes[0].second);
        note(effort.holding(), at, &summary.drives[d].extremes[1].second);
        note(effort.lower, at, &summary.drives[d].extremes[2].second);
        note(effort.upper, at, &summary.drives[d].extremes[2].second);
      }
      row.insert(row.end(), frame.signals.begin(), frame.signals.end());
    } else {
      row.resize(columns, std::numeric_limits<double>::quiet_NaN());
      ++summary.unreachable;
    }
    sink(row);
    ++summary.rows;
  }
  if (summary.unreachable == summary.rows) summary.status = last;
  if (singular > 0) summary.warnings.push_back(singular_posture(grid, first_singular, singular));
  return summary;
}

}  // namespace

std::vector<std::string> effort_columns(const Problem& problem,
                                        const std::vector<SignalDescription>& signals) {
  std::vector<std::string> columns;
  const auto add = [&](const std::string& joint, const std::vector<const char*>& quantities) {
    for (const char* quantity : quantities) columns.push_back(joint + "/" + quantity);
  };
  const PostureGrid& grid = study_of(problem).grid;
  for (const GridJoint& joint : grid) add(joint.joint, {"position"});
  for (const GridJoint& joint : grid)
    add(joint.joint, {"effort", "breakaway_down", "breakaway_up", "holding"});
  if (grid.empty()) {
    columns.emplace_back("time");
    const SetpointMotion motion(study_of(problem), problem.parameters());
    for (const MeasuredJoint& joint : motion.joints())
      add(joint.name, {"position", "velocity", "acceleration", "effort"});
  }
  for (const SignalDescription& signal : signals) columns.push_back(signal.text);
  return columns;
}

EffortSummary record_efforts(const Problem& problem, const std::vector<double>& parameters,
                             const std::vector<SignalDescription>& signals, int samples,
                             const RowSink& sink, const std::atomic<bool>* cancel) {
  return study_of(problem).grid.empty()
             ? record_motion(problem, parameters, signals, samples, sink, cancel)
             : record_postures(problem, parameters, signals, sink, cancel);
}

Json to_json(const std::vector<DriveNeeds>& drives) {
  Json object = Json::object();
  for (const DriveNeeds& drive : drives) {
    Json& joint = object[drive.joint] = Json::object();
    for (const auto& [name, extreme] : drive.extremes) joint[name] = record_json(extreme);
    for (const auto& [name, total] : drive.totals) joint[name] = total;
  }
  return object;
}

}  // namespace codesign
