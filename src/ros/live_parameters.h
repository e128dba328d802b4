// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_LIVE_PARAMETERS_H_
#define MECHANISM_CODESIGN_ROS_LIVE_PARAMETERS_H_

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
#include "ros/bell.h"
#include "ros/node_state.h"

namespace codesign {

/// The parameters as dynamic_reconfigure describes them: numbers in one group, with bounds and start values.
dynamic_reconfigure::ConfigDescription describe_parameters(const std::vector<Parameter>& parameters);

/// Values of the parameters as dynamic_reconfigure sends them.
dynamic_reconfigure::Config config_of(const std::vector<Parameter>& parameters, const std::vector<double>& values);

/// What a request asks for.
struct WantedParameters {
  std::vector<double> values;  ///< all of them, within their bounds
  Warnings warnings;           ///< `parameter_refused`: names that are unknown and numbers that are not finite, which are left out;
                               ///< `parameter_bounded`: values that became a bound
};
WantedParameters wanted_parameters(const std::vector<Parameter>& parameters, const std::vector<double>& values,
                                   const dynamic_reconfigure::Config& request);

/// Parameters that change while the simulation runs, by the service and topics of dynamic_reconfigure, doc/ros_api.md. The service waits
/// for the run, so that its callback needs a thread apart from those of topics. Thread-safe.
class LiveParameters {
 public:
  /// @param node below which service and topics are, whose callback queue serves. @param bell rung for each request
  LiveParameters(ros::NodeHandle node, const std::vector<Parameter>& parameters, const std::vector<double>& values, NodeState* state,
                 Bell* bell);

  /// Hands a waiting request to `change`, which tries values, and answers it. @returns whether values have changed. To be called by the
  /// thread of the run.
  bool serve(const std::function<Status(const std::vector<double>&)>& change);
  /// The node ends: nobody waits any more.
  void stop();

  /// The service. One request after the other, so that each one learns what became of its own values.
  dynamic_reconfigure::Config set(const dynamic_reconfigure::Config& request);

 private:
  const std::vector<Parameter> parameters_;
  NodeState* state_;
  Bell* bell_;
  std::mutex requests_;  ///< held by the request that is being served, before mutex_
  std::mutex mutex_;
  std::condition_variable answered_;
  std::vector<double> values_;
  std::optional<std::vector<double>> wanted_;  ///< until it is answered
  bool stopped_ = false;
  Status status_;  ///< of the last change
  ros::Publisher descriptions_, updates_;
  ros::ServiceServer server_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_LIVE_PARAMETERS_H_
