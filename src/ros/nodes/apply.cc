// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <ros/init.h>
#include <ros/master.h>

#include <atomic>
#include <iostream>
#include <string>
#include <vector>

#include "ros/apply/apply.h"
#include "ros/common/run_node.h"

namespace {

/// Set by a request to end; the values that were sent are then rolled back.
std::atomic<bool> is_cancelled{false};

constexpr int kSuccess = 0, kFailure = 1, kMistake = 2;

int apply(const codesign::ApplyArguments& arguments) {
  if (!ros::master::check()) {
    std::cerr << "codesign apply: no ROS master answers at " << ros::master::getURI() << std::endl;
    return kFailure;
  }
  ros::start();
  const mechanism_codesign::ApplyResponse response =
      codesign::apply_gains(arguments.request, is_cancelled);
  std::cout << (arguments.json ? codesign::apply_json(response) : codesign::apply_table(response))
            << std::flush;
  if (!response.success)
    std::cerr << "codesign apply: " << response.code << ": " << response.message << std::endl;
  ros::shutdown();
  return response.success ? kSuccess : response.code == "bad_input" ? kMistake : kFailure;
}

}  // namespace

/// The program that `codesign apply` starts with its arguments.
int main(int argc, char** argv) {
  ros::init(argc, argv, "codesign_apply",
            ros::init_options::AnonymousName | ros::init_options::NoSigintHandler |
                ros::init_options::NoRosout);
  codesign::on_end_request([] { is_cancelled = true; });
  try {
    const codesign::ApplyArguments arguments =
        codesign::parse_apply_arguments({argv + 1, argv + argc});
    if (!arguments.help) return apply(arguments);
    std::cout << codesign::apply_usage();
    return kSuccess;
  } catch (const codesign::ApplyUsageError& error) {
    std::cerr << codesign::apply_usage() << "\ncodesign apply: " << error.what() << std::endl;
    return kMistake;
  }
}
