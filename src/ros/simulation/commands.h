// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/Commands.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "integration/command_inputs.h"
#include "integration/interactive_simulation.h"
#include "ros/simulation/run_clock.h"

// Commands from messages, and the run that takes them. Each read_...() throws InputError, whose
// text names topic, joint and value, for a message that cannot be used.

namespace codesign {

/// Efforts [N m or N] by the index of their joint in CommandInputs::joints.
struct EffortCommand {
  std::vector<std::pair<std::size_t, double>> efforts;
};

/// A set-point in the unit of the controller's input. @param controller index in
/// CommandInputs::controllers
struct SetpointCommand {
  std::size_t controller = 0;
  double value = 0.0;
};

/// A trajectory of one joint; times count from the begin of the trajectory. Without points the
/// joint holds its position.
struct JointCourse {
  std::string joint;
  TrajectoryFollower follower;
  std::vector<CoursePoint> points;
};

struct TrajectoryCommand {
  ros::Time begin;  ///< zero: it begins when it takes effect
  std::vector<JointCourse> joints;
};

using Command = std::variant<EffortCommand, SetpointCommand, TrajectoryCommand>;

EffortCommand read_efforts(const CommandInputs& inputs, const std::string& topic,
                           const sensor_msgs::JointState& message);
EffortCommand read_efforts(const CommandInputs& inputs, const std::string& topic,
                           const std_msgs::Float64MultiArray& message);
SetpointCommand read_setpoint(const CommandInputs& inputs, const std::string& topic,
                              std::size_t controller, const std_msgs::Float64& message);
/// Without joints and points: every joint whose controller can follow trajectories holds its
/// position.
TrajectoryCommand read_trajectory(const CommandInputs& inputs, const std::string& topic,
                                  const trajectory_msgs::JointTrajectory& message);

/// Applies commands to a run, and ends efforts that are not renewed.
class CommandedRun {
 public:
  /// @param run must outlive this. @param timeout [s] of the run after which efforts are zero; 0:
  /// never
  CommandedRun(InteractiveSimulation* run, double timeout) : run_(run), timeout_(timeout) {}

  /// Drops all commands, for a new run.
  void clear();

  /// The outcome of the commands at an instant.
  struct Outcome {
    Status status;         ///< of InteractiveSimulation::apply()
    bool changed = false;  ///< whether the commands in effect have changed
  };
  /// Applies the last command of each joint and controller in `commands`. @param frame the last
  /// frame, sampled at the present instant.
  /// @param clock gives the time of a trajectory's stamp.
  Outcome apply(const std::vector<Command>& commands, const Frame& frame, const RunClock& clock);
  /// Whether a timeout has ended the efforts and no command has arrived since.
  bool is_timed_out() const { return timed_out_; }

  /// The commands in effect at `time` [s]; the stamp is for the caller to set.
  mechanism_codesign::Commands message(double time) const;

 private:
  void take(const EffortCommand& command, const Frame& frame, const RunClock& clock);
  void take(const SetpointCommand& command, const Frame& frame, const RunClock& clock);
  void take(const TrajectoryCommand& command, const Frame& frame, const RunClock& clock);
  void follow(const JointCourse& course, double begin, const Frame& frame);
  bool end_efforts(double time);

  InteractiveSimulation* run_;
  double timeout_;
  std::optional<double> last_effort_;  ///< time of the last effort command [s]
  bool timed_out_ = false;
};

}  // namespace codesign
