// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace codesign {

struct SwitchOrigin;

/// The events of one run, as the integrator meets them: event_names.h gives them names. Adding one
/// allocates nothing.
class EventLog {
 public:
  static constexpr std::size_t kMost = 500;  ///< that are kept; others are counted

  struct Entry {
    double time = 0.0;                     ///< [s]
    const SwitchOrigin* origin = nullptr;  ///< of the switch that changed
    bool becomes_true = false;             ///< whether its comparison x < y holds afterwards
    bool is_jump = false;
    bool is_touched = false;  ///< a jump whose instant has no derivative
  };

  /// Begins a run. @param has_switches whether there can be events.
  void start(bool has_switches) {
    entries_.clear();
    touched_.clear();
    count_ = 0;
    if (!has_switches) return;
    entries_.reserve(kMost);
    touched_.reserve(kMostTouched);
  }
  void add(const Entry& entry) {
    ++count_;
    if (entries_.size() < kMost) entries_.push_back(entry);
    if (entry.is_touched) touch(entry);
  }
  /// A guard that was touched and not passed, which is no event.
  void touch(const Entry& entry) {
    if (touched_.size() < kMostTouched) touched_.push_back(entry);
  }

  const std::vector<Entry>& entries() const { return entries_; }
  /// The first ones whose guards were only touched.
  const std::vector<Entry>& touched() const { return touched_; }
  std::int64_t count() const { return count_; }

 private:
  static constexpr std::size_t kMostTouched = 20;

  std::vector<Entry> entries_, touched_;
  std::int64_t count_ = 0;
};

}  // namespace codesign
