// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/watched_messages.h"

#include <limits>

namespace codesign {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

mechanism_codesign::WatchedSignal to_message(const WatchedSignal& signal, const WatchedResult& result,
                                             const std::vector<double>& parameters) {
  mechanism_codesign::WatchedSignal message;
  message.element = result.element;
  message.signal = result.signal;
  message.lower = signal.lower ? signal.lower->at(parameters) : -kNone;
  message.upper = signal.upper ? signal.upper->at(parameters) : kNone;
  message.after = signal.after;
  message.before = signal.before;
  message.initial_smallest = result.initial_smallest;
  message.initial_largest = result.initial_largest;
  message.smallest = result.smallest;
  message.largest = result.largest;
  message.smallest_time = result.smallest_time;
  message.largest_time = result.largest_time;
  message.violation = result.violation;
  return message;
}

}  // namespace

std::vector<mechanism_codesign::WatchedSignal> watched_messages(const Problem& problem, const std::vector<WatchedResult>& watched,
                                                                const Eigen::VectorXd& rho) {
  std::vector<mechanism_codesign::WatchedSignal> messages;
  const std::vector<WatchedSignal>& signals = problem.study().watched;
  if (watched.size() != signals.size()) return messages;
  const std::vector<double> parameters = problem.parameters(rho);
  for (std::size_t k = 0; k < signals.size(); ++k) messages.push_back(to_message(signals[k], watched[k], parameters));
  return messages;
}

}  // namespace codesign
