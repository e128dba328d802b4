// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/node_arguments.h"

#include <ros/init.h>

#include <csignal>
#include <iostream>

namespace codesign {
namespace {

extern "C" void on_termination(int) { ros::requestShutdown(); }

}  // namespace

int run_node(int argc, char** argv, const std::string& name, const std::string& help, const std::function<std::shared_ptr<void>()>& make) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word != "--help" && word != "-h") continue;
    std::cout << help;
    return 0;
  }
  ros::init(argc, argv, name);
  if (argc > 1) {
    std::cerr << name << ": unexpected argument \"" << argv[1] << "\"; parameters are given as _name:=value\n\n" << help;
    return 2;
  }
  std::signal(SIGTERM, on_termination);
  const std::shared_ptr<void> node = make();
  ros::spin();
  return 0;
}

}  // namespace codesign
