// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

namespace codesign {

/// The value of a parameter on a robot: a number, or a truth value as 0 or 1.
struct GainValue {
  double number = 0.0;
  bool is_flag = false;

  bool operator==(const GainValue& other) const { return number == other.number && is_flag == other.is_flag; }
};

/// Values by the names of their parameters.
using GainValues = std::map<std::string, GainValue>;

/// The parameters of a server of dynamic_reconfigure, as the server publishes them.
struct GainServerState {
  GainValues now;           ///< present numbers and truth values
  GainValues lower, upper;  ///< its limits; a parameter without limits is missing
};

/// Sets parameters of a robot, as a server of dynamic_reconfigure does.
class GainServer {
 public:
  /// The values of all parameters of the server after a request; empty if the server did not answer.
  using Answer = std::optional<GainValues>;

  virtual ~GainServer() = default;
  virtual const std::string& name() const = 0;

  /// Sends `values` to the server and returns at once. Requests are sent one after another.
  /// @param answer called once, maybe in another thread, maybe before send() returns.
  virtual void send(const GainValues& values, std::function<void(const Answer&)> answer) = 0;

  /// Gives up a request that the server has not answered, if a second request waits: the second request is sent at once, and reaches the
  /// server after the first one. The callback of the first request gets an empty answer; whether the server still applies that request is
  /// unknown.
  virtual void overtake() = 0;
};

}  // namespace codesign
