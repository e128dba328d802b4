// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// From now on, `act` replaces the reaction of roscpp when the process is asked to end: by SIGINT, SIGTERM or SIGHUP, by `rosnode kill`, or
/// by the master because another node has taken the name. SIGHUP stays ignored where it is ignored already, as under nohup. Call it once,
/// after ros::init() with ros::init_options::NoSigintHandler and before the first node handle or ros::start().
/// @param act called in a signal handler or in a thread of ROS, at each request; may only do what a signal handler may do.
void on_end_request(void (*act)());

}  // namespace codesign
