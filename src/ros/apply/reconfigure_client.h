// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <ros/node_handle.h>
#include <ros/service_client.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "ros/apply/gain_ramp.h"

namespace codesign {

/// A server of dynamic_reconfigure in another process: the topics `parameter_descriptions` and
/// `parameter_updates` and the service `set_parameters` below its namespace. It reads and sets
/// numbers of type double and truth values, and leaves other parameters alone. Requests go out from
/// a thread of their own, so that a server that does not answer does not delay other servers.
class ReconfigureClient : public GainServer {
 public:
  /// @param node whose callback queue is served by another thread. @param name_space resolved.
  ReconfigureClient(ros::NodeHandle node, std::string name_space);
  /// Drops a request that is not answered yet.
  ~ReconfigureClient() override;
  ReconfigureClient(const ReconfigureClient&) = delete;
  ReconfigureClient& operator=(const ReconfigureClient&) = delete;

  /// Waits until the server has published its parameters and offers its service. @return the name
  /// of the missing topic or service; empty: none is missing.
  std::string wait(double patience, const std::atomic<bool>& cancel);

  /// The last published state of the server. Call it after wait() was successful.
  GainServerState state() const;

  const std::string& name() const override { return name_; }
  void send(const GainValues& values, std::function<void(const Answer&)> answer) override;
  void overtake() override;

 private:
  struct Order {
    GainValues values;
    std::function<void(const Answer&)> answer;
  };
  void serve();
  Answer ask(const GainValues& values);

  ros::NodeHandle node_;
  const std::string name_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<dynamic_reconfigure::ConfigDescription> description_;
  std::optional<dynamic_reconfigure::Config> now_;
  std::deque<Order> orders_;
  ros::ServiceClient service_;
  bool is_asking_ = false;  ///< whether a request waits for the server's answer
  bool ending_ = false;
  ros::Subscriber descriptions_, updates_;
  std::thread thread_;  // last: it uses all of the above
};

/// The numbers of type double and the truth values of a message.
GainValues values_of(const dynamic_reconfigure::Config& config);
dynamic_reconfigure::Config config_of(const GainValues& values);
/// @param now the last message of the topic `parameter_updates`.
GainServerState state_of(const dynamic_reconfigure::ConfigDescription& description,
                         const dynamic_reconfigure::Config& now);

}  // namespace codesign
