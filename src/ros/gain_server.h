// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_GAIN_SERVER_H_
#define MECHANISM_CODESIGN_ROS_GAIN_SERVER_H_

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

/// By the names of the parameters.
using GainValues = std::map<std::string, GainValue>;

/// What a server of dynamic_reconfigure says of itself.
struct GainServerState {
  GainValues now;           ///< numbers and truth values that it has
  GainValues lower, upper;  ///< its limits; a parameter without limits is missing
};

/// Sets parameters of a robot, as a server of dynamic_reconfigure does.
class GainServer {
 public:
  /// What the server has after a request, of all its parameters; empty if it did not answer.
  using Answer = std::optional<GainValues>;

  virtual ~GainServer() = default;
  virtual const std::string& name() const = 0;

  /// Asks the server to take `values` and returns at once. Requests are sent one after another.
  /// @param answer called once, maybe in another thread, maybe before send() returns.
  virtual void send(const GainValues& values, std::function<void(const Answer&)> answer) = 0;

  /// Gives up a request that the server has not answered, if another one waits behind it: that one is sent at once, and reaches the server
  /// after it. The request that is given up is answered as by a server that is gone; whether the server still takes it is unknown.
  virtual void overtake() = 0;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_GAIN_SERVER_H_
