// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/watched_messages.h"

#include <cstdint>

namespace codesign {
namespace {

mechanism_codesign::WatchedSignal to_message(const WatchedResult& result, bool is_ensemble) {
  mechanism_codesign::WatchedSignal message;
  message.element = result.element;
  message.signal = result.signal;
  message.lower = result.lower;
  message.upper = result.upper;
  message.after = result.after;
  message.before = result.before;
  message.initial_smallest = result.initial_smallest;
  message.initial_largest = result.initial_largest;
  message.smallest = result.smallest;
  message.largest = result.largest;
  message.smallest_time = result.smallest_time;
  message.largest_time = result.largest_time;
  message.smallest_scenario = is_ensemble ? static_cast<std::uint32_t>(result.smallest_scenario) + 1 : 0;
  message.largest_scenario = is_ensemble ? static_cast<std::uint32_t>(result.largest_scenario) + 1 : 0;
  message.violation = result.violation;
  return message;
}

}  // namespace

std::vector<mechanism_codesign::WatchedSignal> watched_messages(const std::vector<WatchedResult>& watched, bool is_ensemble) {
  std::vector<mechanism_codesign::WatchedSignal> messages;
  for (const WatchedResult& one : watched) messages.push_back(to_message(one, is_ensemble));
  return messages;
}

}  // namespace codesign
