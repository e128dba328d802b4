// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jobs/finished_job.h"
#include "jobs/robot_gains.h"
#include "ros/gain_server.h"

namespace codesign {

/// The values that a job has for one server of a robot.
struct GainOrder {
  std::string server;               ///< namespace of the server, as the study or the request gives it
  std::optional<RobotGains> gains;  ///< for a server as control_toolbox::Pid makes it
  GainValues parameters;            ///< without `gains`: parameters of the study, for a server with parameters of the same names
};

/// The orders of a job: one for each controller that `hardware:` names; or, if `server` is not empty, one order for that server with all
/// tuned parameters. @throws InputError if the study has no `hardware:` and `server` is empty, or if a value is outside the study's bounds.
std::vector<GainOrder> orders_of(const FinishedJob& job, const std::string& server);

/// The values of an order under the names that the server has. A server of gains must have `p`, `i` and `d`; a clamp goes to `i_clamp`, or
/// to `i_clamp_max` and, negative, to `i_clamp_min`; `antiwindup` is a truth value. A clamp of a controller without an `i` gain and an
/// `antiwindup` that is false may be missing on the server.
/// @param name resolved name of the server, for messages. @throws InputError for a name that the server does not have, and for a value
/// outside the server's limits.
GainValues wanted_values(const GainOrder& order, const GainServerState& state, const std::string& name);

/// The entries of `values` whose names are in `names`.
GainValues only(const GainValues& names, const GainValues& values);

}  // namespace codesign
