// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/recording_check.h"

#include <algorithm>
#include <cmath>

#include "text/decimal.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

[[noreturn]] void fail_at(const JointRecording& recording, std::size_t k, const std::string& message, const std::string& value,
                          const std::string& allowed) {
  throw InputError({recording.location_of(k), recording.element, message + " (" + recording.place_of(k) + ")", value, allowed});
}

void require_finite(const JointRecording& recording) {
  for (const JointSamples& samples : recording.joints)
    for (std::size_t q = 0; q < kMeasuredQuantityNames.size(); ++q) {
      const std::vector<double>& column = samples.of(static_cast<MeasuredQuantity>(q));
      const auto bad = std::find_if(column.begin(), column.end(), [](double value) { return !std::isfinite(value); });
      if (bad != column.end())
        fail_at(recording, static_cast<std::size_t>(bad - column.begin()),
                "the " + std::string(kMeasuredQuantityNames[q]) + " of " + samples.joint + " is not a finite number", to_decimal(*bad),
                "finite numbers; `from` and `to` choose a part of the recording");
    }
}

void require_ascending(const JointRecording& recording) {
  for (std::size_t k = 1; k < recording.times.size(); ++k) {
    const double step = recording.times[k] - recording.times[k - 1];
    if (step == 0.0)
      fail_at(recording, k, "the time equals the time of the previous sample", readable(recording.times[k]), "ascending times");
    if (!(step > 0.0))
      fail_at(recording, k, "the time jumps back by " + readable(-step, 6) + " s: the clock was set, or two recordings were joined",
              readable(recording.times[k]), "ascending times; `from` and `to` choose a part of the recording");
  }
}

/// ` from 7 s to 37 s`, without ends that the study does not choose.
std::string range_text(double from, double to) {
  return (std::isfinite(from) ? " from " + readable(from) + " s" : "") + (std::isfinite(to) ? " to " + readable(to) + " s" : "");
}

[[noreturn]] void refuse_length(const JointRecording& recording, std::size_t count, double from, double to) {
  const auto [first, last] = std::minmax_element(recording.times.begin(), recording.times.end());
  const std::string reach = recording.times.empty() ? "the recording is empty"
                                                    : "the recording reaches from " + readable(*first) + " s to " + readable(*last) + " s";
  throw InputError({recording.where, recording.element, std::to_string(count) + " samples" + range_text(from, to) + "; " + reach, "",
                    "at least " + std::to_string(kLeastSamples) + " samples"});
}

/// The indices at which pieces begin, and the end of the last piece.
std::vector<std::size_t> piece_ends(const std::vector<double>& times, double longest) {
  std::vector<std::size_t> ends = {0};
  for (std::size_t k = 1; k < times.size(); ++k)
    if (times[k] - times[k - 1] > longest) ends.push_back(k);
  ends.push_back(times.size());
  return ends;
}

void warn_of_missing(const JointRecording& recording, double period, Warnings* warnings) {
  constexpr double kMissing = 1.5;
  std::size_t count = 0, first = 0;
  for (std::size_t k = 1; k < recording.times.size(); ++k)
    if (recording.times[k] - recording.times[k - 1] > kMissing * period && count++ == 0) first = k;
  if (count == 0) return;
  warnings->push_back(
      warn("recording_samples_missing", {recording.location_of(first), recording.element,
                                         std::to_string(count) + " pauses are longer than " + readable(kMissing) + " periods of " +
                                             readable(period, 4) + " s and are interpolated, the first before " + recording.place_of(first),
                                         "", ""}));
}

}  // namespace

double median_period(const std::vector<double>& times) {
  std::vector<double> periods;
  periods.reserve(times.size() - 1);
  for (std::size_t k = 1; k < times.size(); ++k) periods.push_back(times[k] - times[k - 1]);
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

JointRecording checked_part(const JointRecording& recording, double from, double to) {
  for (std::size_t k = 0; k < recording.times.size(); ++k)
    if (!std::isfinite(recording.times[k])) fail_at(recording, k, "the time is not a finite number", to_decimal(recording.times[k]), "");
  const auto inside = [from, to](double time) { return from <= time && time <= to; };
  const auto first = std::find_if(recording.times.begin(), recording.times.end(), inside);
  const auto last = std::find_if(recording.times.rbegin(), recording.times.rend(), inside).base();
  if (last - first < static_cast<std::ptrdiff_t>(kLeastSamples))
    refuse_length(recording, static_cast<std::size_t>(std::max<std::ptrdiff_t>(last - first, 0)), from, to);
  JointRecording part = part_of(recording, static_cast<std::size_t>(first - recording.times.begin()),
                                static_cast<std::size_t>(last - recording.times.begin()));
  require_ascending(part);
  require_finite(part);
  return part;
}

std::vector<JointRecording> without_gaps(const JointRecording& recording, GapRule rule, Warnings* warnings) {
  const double period = median_period(recording.times);
  const std::vector<std::size_t> ends = piece_ends(recording.times, kGapPeriods * period);
  std::vector<JointRecording> pieces;
  for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece) {
    const std::size_t begin = ends[piece], end = ends[piece + 1];
    if (begin > 0 && rule == GapRule::kRefuse)
      fail_at(recording, begin,
              "a gap of " + readable(recording.times[begin] - recording.times[begin - 1], 6) + " s, where the period is " +
                  readable(period, 4) + " s: the recording paused, samples were lost, or the clock was set",
              "", "pauses of at most " + readable(kGapPeriods) + " periods; `gaps: split` uses the pieces as recordings of their own");
    if (end - begin >= kLeastSamples)
      pieces.push_back(part_of(recording, begin, end));
    else
      warnings->push_back(warn("recording_piece_dropped", {recording.location_of(begin), recording.element,
                                                           "a piece of " + std::to_string(end - begin) +
                                                               " samples between gaps is left out (" + recording.place_of(begin) + ")",
                                                           "", "at least " + std::to_string(kLeastSamples)}));
  }
  if (pieces.empty()) refuse_length(recording, 0, recording.times.front(), recording.times.back());
  for (const JointRecording& piece : pieces) warn_of_missing(piece, period, warnings);
  return pieces;
}

void unwrap_turns(const RobotDescription& robot, JointRecording* recording, Warnings* warnings) {
  for (const JointDescription& joint : robot.joints) {
    const auto found = std::find_if(recording->joints.begin(), recording->joints.end(),
                                    [&joint](const JointSamples& samples) { return samples.joint == joint.name; });
    if (!is_turn(joint.type) || found == recording->joints.end()) continue;
    std::vector<double>& position = found->position;
    double turns = 0.0;
    std::size_t jumps = 0, first = 0;
    for (std::size_t k = 1; k < position.size(); ++k) {
      const double step = position[k] + turns - position[k - 1];
      if (std::abs(step) > kHalfTurn) {
        turns -= 2.0 * kHalfTurn * std::round(step / (2.0 * kHalfTurn));
        if (jumps++ == 0) first = k;
      }
      position[k] += turns;
    }
    if (jumps > 0)
      warnings->push_back(
          warn("recording_unwrapped", {recording->location_of(first), recording->element,
                                       "the position of " + joint.name + " jumps by more than half a turn " + std::to_string(jumps) +
                                           " times, first at " + recording->place_of(first) + "; whole turns were added",
                                       "", ""}));
  }
}

}  // namespace codesign
