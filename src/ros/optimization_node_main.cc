// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <ros/init.h>

#include "mechanism_codesign/ros/optimization_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "optimization");
  const codesign::OptimizationNode node;
  ros::spin();
  return 0;
}
