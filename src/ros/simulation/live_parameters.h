// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "mechanism_codesign/parameter.h"
#include "mechanism_codesign/status.h"
#include "ros/common/node_state.h"
#include "ros/simulation/run_clock.h"

namespace codesign {

/// The parameters as dynamic_reconfigure describes them: numbers in one group, with bounds and
/// start values.
dynamic_reconfigure::ConfigDescription describe_parameters(
    const std::vector<Parameter>& parameters);

/// Values of the parameters as dynamic_reconfigure sends them.
dynamic_reconfigure::Config config_of(const std::vector<Parameter>& parameters,
                                      const std::vector<double>& values);

/// The values of a request.
struct WantedParameters {
  std::vector<double> values;  ///< values of all parameters, within their bounds
  /// `parameter_refused`: unknown names and numbers that are not finite; they are ignored;
  /// `parameter_bounded`: values that were replaced by a bound
  Warnings warnings;
};
WantedParameters wanted_parameters(const std::vector<Parameter>& parameters,
                                   const std::vector<double>& values,
                                   const dynamic_reconfigure::Config& request);

/// Parameters that change while the simulation runs, by the service and topics of
/// dynamic_reconfigure, doc/ros_api.md. The service waits for the run, so that its callback needs
/// another thread than the callbacks of topics. Thread-safe.
class LiveParameters {
 public:
  /// @param node the namespace of service and topics; its callback queue serves them. @param bell
  /// rung for each request
  LiveParameters(ros::NodeHandle node, const std::vector<Parameter>& parameters,
                 const std::vector<double>& values, NodeState* state, Bell* bell);

  /// Passes the values of a waiting request to `change`, which tries them, and answers the request.
  /// @returns whether values have changed. To be called by the thread of the run.
  bool serve(const std::function<Status(const std::vector<double>&)>& change);
  /// Ends all waits, when the node ends.
  void stop();

  /// The service. It handles one request after the other, so that each answer reports the outcome
  /// of its own values.
  dynamic_reconfigure::Config set(const dynamic_reconfigure::Config& request);

 private:
  const std::vector<Parameter> parameters_;
  NodeState* state_;
  Bell* bell_;
  std::mutex requests_;  ///< held by the request that is being served, locked before mutex_
  std::mutex mutex_;
  std::condition_variable answered_;
  std::vector<double> values_;
  std::optional<std::vector<double>> wanted_;  ///< values of the request that is not answered yet
  bool stopped_ = false;
  Status status_;  ///< status of the last change
  ros::Publisher descriptions_, updates_;
  ros::ServiceServer server_;
};

}  // namespace codesign
