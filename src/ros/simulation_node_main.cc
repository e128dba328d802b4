// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <ros/init.h>

#include "mechanism_codesign/ros/simulation_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "simulation");
  const codesign::SimulationNode node;
  ros::spin();
  return 0;
}
