// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mpi/run_on_ranks.h"
#include "ros/common/run_node.h"

namespace {

const char* const kHelp =
    R"(usage: rosrun mechanism_codesign optimization _study:=PATH [_PARAMETER:=VALUE ...]

Tunes a mechanism, or fits it to recordings, on request: services and actions `optimize` and `identify`, services `evaluate`, `apply` and
`~cancel`. doc/ros_api.md has more.

parameters
  ~model PATH              annotated URDF; without it the text in robot_description
  ~study PATH              study file, or the study itself as a tree
  ~overlays [PATH, ...]    annotations to merge into the model
  ~result PATH             a result.json, whose design is taken
  ~set {NAME: VALUE}       parameter values that replace those of model and study
  ~output_directory PATH   where bags go; by default $ROS_HOME/mechanism_codesign or ~/.ros/mechanism_codesign
  ~rate NUMBER             samples per second of the runs in the bag, by default 50
)";

}  // namespace

int main(int argc, char** argv) {
  return codesign::run_on_ranks("optimization", [&](codesign::Dispatcher* ranks) {
    return codesign::run_node(argc, argv, "optimization", kHelp,
                              [ranks] { return codesign::make_optimization_node(ranks); });
  });
}
