// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/run_node.h"

namespace {

const char* const kHelp =
    R"(usage: rosrun mechanism_codesign simulation _study:=PATH [_PARAMETER:=VALUE ...]

Runs a study and publishes it: joint_states, joint_friction, controller_states, loop_errors, signals, friction_markers,
caption, and scene for the camera of rviz.
Takes commands as a robot: ~command/effort, ~command/efforts, ~command/trajectory, CONTROLLER/command; ~pause, ~resume, ~step, ~restart;
and parameters by dynamic_reconfigure.
doc/ros_api.md has more.

parameters
  ~model PATH              annotated URDF; without it the text in robot_description
  ~study PATH              study file, or the study itself as a tree
  ~overlays [PATH, ...]    annotations to merge into the model
  ~result PATH             a result.json, whose design is taken
  ~set {NAME: VALUE}       parameter values that replace those of model and study
  ~rate NUMBER             frames per second of the run, by default 50
  ~mode MODE               real_time (the default) or as_fast_as_possible, with /clock
  ~time_scale NUMBER       seconds of the run in one second, by default 1
  ~loop true               start again when the duration is over
  ~wait_for_subscribers [TOPIC, ...]   topics that must have a subscriber, other than robot_state_publisher
  ~publish_limit NUMBER    frames per second, as fast as possible and while somebody listens, by default 500
  ~command_joints [JOINT, ...]   joints that take efforts, in order, by default all that can be driven
  ~command_timeout SECONDS after which efforts end if no new ones come, by default never
  ~disconnect [CONTROLLER, ...]  controllers of the study that an outside controller replaces
  ~duration SECONDS        of a run, by default the study's
  ~lock_step true          wait for a command after each frame
  ~start_paused true       pause after the first frame
  ~step_frames NUMBER      frames of a ~step, by default 1
  ~float_topics true       each number on a topic of its own, too
  ~bag PATH                a bag of the first run, every frame in it
  ~world_frame NAME        a TF frame at the root link
  ~frame_prefix TEXT       before the name of each TF frame
  ~force_scale, ~torque_scale, ~arrow_width   how friction is drawn; by default as the run needs
)";

}  // namespace

int main(int argc, char** argv) {
  return codesign::run_node(argc, argv, "simulation", kHelp, codesign::make_simulation_node);
}
