// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/ApplyRequest.h>
#include <mechanism_codesign/ApplyResponse.h>

#include <atomic>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "jobs/robot_gains.h"
#include "jobs/saved_result.h"
#include "ros/apply/gain_ramp.h"
#include "ros/apply/robot_watch.h"

namespace codesign {

/// The arguments of `codesign apply`.
struct ApplyArguments {
  mechanism_codesign::ApplyRequest request;  ///< `result` is the path of the folder or bag
  bool json = false, help = false;
};

/// A word of the command line that cannot be used.
class ApplyUsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the words after `codesign apply`, without ROS's remappings. @throws ApplyUsageError naming
/// the word.
ApplyArguments parse_apply_arguments(const std::vector<std::string>& words);

/// The text for `codesign apply --help`.
std::string apply_usage();

/// The answer for people: a table of the values, and the message.
std::string apply_table(const mechanism_codesign::ApplyResponse& response);

/// The answer as one JSON object, with the fields of the service; without success `error` has code
/// and message.
std::string apply_json(const mechanism_codesign::ApplyResponse& response);

/// The times of the ramp in a request. Zero: the default. @throws InputError for a time below 0 or
/// above 100000 s.
RampOptions ramp_options(const mechanism_codesign::ApplyRequest& request);

/// The options of a request for watching the robot. Zero: the default. @throws InputError for a
/// wrong number, or if the request both names a topic of joint states and switches their watch off.
WatchOptions watch_options(const mechanism_codesign::ApplyRequest& request);

/// The values that a job has for one server of a robot.
struct GainOrder {
  std::string server;  ///< namespace of the server, as the study or the request gives it
  std::optional<RobotGains> gains;  ///< for a server as control_toolbox::Pid makes it
  /// without `gains`: parameters of the study, for a server with parameters of the same names
  GainValues parameters;
};

/// The orders of a job: one for each controller that `hardware:` names; or, if `server` is not
/// empty, one order for that server with all tuned parameters. @throws InputError if the study has
/// no `hardware:` and `server` is empty, or if a value is outside the study's bounds.
std::vector<GainOrder> orders_of(const FinishedJob& job, const std::string& server);

/// The values of an order under the names that the server has. A server of gains must have `p`, `i`
/// and `d`; a clamp goes to `i_clamp`, or to `i_clamp_max` and, negative, to `i_clamp_min`;
/// `antiwindup` is a truth value. A clamp of a controller without an `i` gain and an `antiwindup`
/// that is false may be missing on the server.
/// @param name resolved name of the server, for messages. @throws InputError for a name that the
/// server does not have, and for a value outside the server's limits.
GainValues wanted_values(const GainOrder& order, const GainServerState& state,
                         const std::string& name);

/// The entries of `values` whose names are in `names`.
GainValues only(const GainValues& names, const GainValues& values);

/// Sends the gains of a finished optimization to the servers of a running robot, as doc/results.md
/// describes, for the service `apply` and for `codesign apply`. It serves its callbacks in a thread
/// of its own, and does not throw.
/// @param request whose `result` is the path of the job's folder or bag. @param cancel once set,
/// the values that were sent are rolled back.
mechanism_codesign::ApplyResponse apply_gains(const mechanism_codesign::ApplyRequest& request,
                                              const std::atomic<bool>& cancel);

}  // namespace codesign
