// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "problem/load_problem.h"

namespace codesign {

/// Ranges in which signals of a robot must stay: `JOINT/position`, `JOINT/velocity`, `JOINT/effort` of joint states, and topics of numbers,
/// whose names begin with a slash.
class SafeRanges {
 public:
  /// Adds the `<limit>` of every joint: positions of joints with stops, velocities and efforts with a limit that is not zero.
  /// @param parameters all named parameters.
  void add_limits_of(const Problem& problem, const std::vector<double>& parameters);

  /// Adds a range given as `SIGNAL=LOW:HIGH`; LOW or HIGH may be empty for no limit. The range replaces the limit of the model.
  /// @throws InputError naming `element` for any other text.
  void add(const std::string& text, const std::string& element);

  /// Why a value is not safe, as a sentence; empty if it is, or if there is no range for the signal. NaN is unsafe for a range that was
  /// given; for a limit of the model it counts as not measured.
  std::string check(const std::string& signal, double value) const;

  /// Signals of joints with a given range, which the robot must publish; likewise topics.
  std::vector<std::string> joint_signals() const { return given(false); }
  std::vector<std::string> topics() const { return given(true); }

 private:
  struct Range {
    double lower, upper;
    bool is_given;
  };
  std::vector<std::string> given(bool topics) const;

  std::map<std::string, Range> ranges_;
};

}  // namespace codesign
