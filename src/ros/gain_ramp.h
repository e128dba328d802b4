// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_GAIN_RAMP_H_
#define MECHANISM_CODESIGN_ROS_GAIN_RAMP_H_

#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ros/gain_server.h"

namespace codesign {

struct RampOptions {
  double ramp = 2.0;                ///< from the values before to the new ones [s]
  double hold = 1.0;                ///< how long the robot is watched with the new values [s]
  double step = 0.05;               ///< between two steps of the ramp [s]
  double patience = 1.0;            ///< longest wait for the answers to one step [s]
  double grace = 0.1;               ///< how long the rollback waits behind a step without an answer, before that step is given up [s]
  double rollback_patience = 10.0;  ///< longest wait for the answers to the rollback [s]
};

/// Why a ramp must not go on.
struct RampAlarm {
  std::string sentence;
  std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();  ///< when it was known
};

/// One server on its way.
struct RampServer {
  GainServer* server = nullptr;  ///< not null; must outlive the ramp, and may be asked a last time after it
  GainValues before, after;      ///< the same names
};

struct RampOutcome {
  std::string alarm;  ///< why the ramp was ended; empty: all values are set
  /// What each server has: `after`, or `before` once it has confirmed the rollback; empty: unknown.
  std::vector<GainServer::Answer> now;
  double rollback_seconds = std::numeric_limits<double>::quiet_NaN();  ///< from the alarm to the last confirmation; NaN: no rollback

  bool is_known() const;  ///< whether every server has said what it has
};

/// Carries gains of a running robot from the values before to new ones: after k of n steps each number is before + (after - before) k / n,
/// with n the next whole number above ramp / step; truth values change with the first step. All servers get a step at the same time, and
/// the next one when all have confirmed it.
///
/// An alarm of the guard, a server that does not answer, and one that answers with other values than it was sent end the ramp: each server
/// that was sent anything gets its values before, once, at once, and without waiting for the other servers. A server that is busy with the
/// step before gets them past that step.
class GainRamp {
 public:
  /// @return why the ramp must not go on, if so. It is asked every few milliseconds.
  using Guard = std::function<std::optional<RampAlarm>()>;

  GainRamp(std::vector<RampServer> servers, const RampOptions& options, Guard guard);
  ~GainRamp();

  /// Returns when the values are set and were held, or when the rollback has ended.
  RampOutcome run();

 private:
  class Answers;
  using Time = std::chrono::steady_clock::time_point;

  bool send_step(double share);
  bool wait_until(Time end);
  bool wait_for_answers();
  bool confirm(const std::vector<GainValues>& sent);
  void send(std::size_t server, const GainValues& values);
  void roll_back();

  std::vector<RampServer> servers_;
  const RampOptions options_;
  const Guard guard_;
  std::shared_ptr<Answers> answers_;  ///< shared with answers that come after the end
  std::vector<bool> was_sent_;
  std::optional<RampAlarm> alarm_;
  RampOutcome outcome_;
};

/// The values at a share of the way, from 0 to 1: exactly `after` at 1.
GainValues between(const GainValues& before, const GainValues& after, double share);

/// The first of `sent` that the server did not take, as a sentence with both values; empty if it took all.
std::string altered(const GainValues& sent, const GainValues& answer);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_GAIN_RAMP_H_
