// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

namespace codesign {

struct MotionStudy;

/// The indices of the extreme values of the watched signals of a study; doc/theory.md (21a).
///
/// The interval of a signal is divided into windows by instants that do not depend on the design.
/// The numbers of a signal are its values at the instants, then the largest value in each window,
/// then the smallest, and its measure if it has one. Their count therefore does not depend on the
/// design, in contrast to the number of local extrema, and each is a continuous function of the
/// design.
///
/// A signal may jump at the break times of functions of time. If there are few break times, they
/// are instants, so that windows end there. Many break times would give too many numbers; they then
/// lie within windows, which count the values on both sides of a jump.
class WatchLayout {
 public:
  /// The numbers of one watched signal.
  struct Entry {
    int first = 0;  ///< place of the value at the first instant
    /// [s], ascending; one for the end of the study, else at least two
    std::vector<double> instants;
    bool is_measured = false;  ///< whether the last number is a measure
    /// of postures, and of numbers of a linearization: there are no windows between them
    bool is_list = false;

    int windows() const { return is_list ? 0 : static_cast<int>(instants.size()) - 1; }
    int at_instant(int k) const { return first + k; }
    int largest(int window) const { return first + static_cast<int>(instants.size()) + window; }
    int smallest(int window) const { return largest(window) + windows(); }
    int measure() const { return smallest(windows()); }
    int size() const { return measure() + (is_measured ? 1 : 0) - first; }
  };

  explicit WatchLayout(const MotionStudy& study);

  /// One entry per watched signal.
  const std::vector<Entry>& entries() const { return entries_; }
  int size() const { return size_; }
  /// The break time within `slack` of `time`, if there is one; all in [s].
  std::optional<double> break_near(double time, double slack) const;

 private:
  std::vector<Entry> entries_;
  std::vector<double> breaks_;  ///< [s], ascending
  int size_ = 0;
};

}  // namespace codesign
