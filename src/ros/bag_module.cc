// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The entry of libcodesign_bags.so.
#include "ros/bag_module.h"

#include "ros/identification_bag.h"
#include "ros/joint_trajectory_bag.h"
#include "ros/recording_bag.h"

const codesign::BagFiles* codesign_bag_files() {
  using codesign::IdentificationShow;
  static const codesign::BagFiles files{
      codesign::read_recording_bag,
      [](const std::string& path, const IdentificationShow& show) { codesign::write_identification_bag(path, show, nullptr); },
      codesign::write_joint_trajectory_bag};
  return &files;
}
