// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace codesign {

/// The value of a parameter on a robot: a number, or a truth value as 0 or 1.
struct GainValue {
  double number = 0.0;
  bool is_flag = false;

  bool operator==(const GainValue& other) const {
    return number == other.number && is_flag == other.is_flag;
  }
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
  /// The values of all parameters of the server after a request; empty if the server did not
  /// answer.
  using Answer = std::optional<GainValues>;

  virtual ~GainServer() = default;
  virtual const std::string& name() const = 0;

  /// Sends `values` to the server and returns at once. Requests are sent one after another.
  /// @param answer called once, maybe in another thread, maybe before send() returns.
  virtual void send(const GainValues& values, std::function<void(const Answer&)> answer) = 0;

  /// Gives up a request that the server has not answered, if a second request waits: the second
  /// request is sent at once, and reaches the server after the first one. The callback of the first
  /// request gets an empty answer; whether the server still applies that request is unknown.
  virtual void overtake() = 0;
};

struct RampOptions {
  double ramp = 2.0;      ///< duration of the ramp from the previous to the new values [s]
  double hold = 1.0;      ///< time for which the robot is watched with the new values [s]
  double step = 0.05;     ///< between two steps of the ramp [s]
  double patience = 1.0;  ///< longest wait for the answers to one step [s]
  /// time that the rollback waits for the answer to a pending step before it gives that step up [s]
  double grace = 0.1;
  double rollback_patience = 10.0;  ///< longest wait for the answers to the rollback [s]
};

/// Why a ramp must not go on.
struct RampAlarm {
  std::string sentence;
  /// time at which the cause was known
  std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
};

/// One server with its values.
struct RampServer {
  /// not null; must outlive the ramp, and may get a last request after the ramp
  GainServer* server = nullptr;
  GainValues before, after;  ///< the same names
};

struct RampOutcome {
  std::string alarm;  ///< why the ramp ended early; empty: all values are set
  /// The values that each server has: `after`, or `before` once it has confirmed the rollback;
  /// empty: unknown.
  std::vector<GainServer::Answer> now;
  /// from the alarm to the last confirmation; NaN: no rollback
  double rollback_seconds = std::numeric_limits<double>::quiet_NaN();

  bool is_known() const;  ///< whether the values of every server are known
};

/// Moves gains of a running robot from their previous values to new ones: after k of n steps each
/// number is before + (after - before) k / n, with n the next whole number above ramp / step; truth
/// values change with the first step. All servers get a step at the same time, and the next step
/// when all have confirmed this one.
///
/// The ramp ends with a rollback if the guard gives an alarm, if a server does not answer, or if a
/// server answers with other values than it was sent. Each server that was sent anything then gets
/// its previous values, once, at once, and without waiting for the other servers. If a server has
/// not answered its last step within the grace time, that step is given up for the rollback.
class GainRamp {
 public:
  /// @return the reason if the ramp must not go on. It is called every few milliseconds.
  using Guard = std::function<std::optional<RampAlarm>()>;

  GainRamp(std::vector<RampServer> servers, const RampOptions& options, Guard guard);

  /// Returns after the hold time with the new values, or when the rollback has ended.
  RampOutcome run();

 private:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  /// The last request to a server. Its callback, which may run after the end of the ramp, shares
  /// the promise.
  struct Request {
    std::shared_ptr<std::promise<GainServer::Answer>> answered;
    std::shared_future<GainServer::Answer> answer;

    bool was_sent() const { return answer.valid(); }
    bool is_answered() const {
      return was_sent() && answer.wait_for(Clock::duration::zero()) == std::future_status::ready;
    }
    /// Empty as long as there is no answer.
    GainServer::Answer last() const { return is_answered() ? answer.get() : GainServer::Answer(); }
  };

  bool send_step(double share);
  bool wait_until(Time end);
  bool wait_for_answers(Clock::duration longest) const;
  bool wait_for_step();
  bool confirm(const std::vector<GainValues>& sent);
  void send(std::size_t server, const GainValues& values);
  void roll_back();

  std::vector<RampServer> servers_;
  const RampOptions options_;
  const Guard guard_;
  std::vector<Request> sent_;
  std::optional<RampAlarm> alarm_;
  RampOutcome outcome_;
};

/// The values at a share of the way, from 0 to 1: exactly `after` at 1.
GainValues between(const GainValues& before, const GainValues& after, double share);

/// A sentence about the first value of `sent` that the server did not accept, with both values;
/// empty if it accepted all.
std::string altered(const GainValues& sent, const GainValues& answer);

}  // namespace codesign
