// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/recording_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/arrays.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

[[noreturn]] void fail_at(const JointRecording& recording, std::size_t k,
                          const std::string& message, const std::string& value,
                          const std::string& allowed) {
  throw InputError({recording.location_of(k), recording.element,
                    message + " (" + recording.place_of(k) + ")", value, allowed});
}

void require_finite(const JointRecording& recording) {
  for (const JointSamples& samples : recording.joints)
    for (std::size_t q = 0; q < kMeasuredQuantityNames.size(); ++q) {
      const std::vector<double>& column = samples.of(static_cast<MeasuredQuantity>(q));
      const auto bad = std::find_if(column.begin(), column.end(),
                                    [](double value) { return !std::isfinite(value); });
      if (bad != column.end())
        fail_at(recording, to_index(bad - column.begin()),
                "the " + std::string(kMeasuredQuantityNames[q]) + " of " + samples.joint +
                    " is not a finite number",
                to_decimal(*bad), "finite numbers; `from` and `to` choose a part of the recording");
    }
  for (const SignalSamples& samples : recording.signals) {
    const auto bad = std::find_if(samples.values.begin(), samples.values.end(),
                                  [](double value) { return !std::isfinite(value); });
    if (bad != samples.values.end())
      fail_at(recording, to_index(bad - samples.values.begin()),
              samples.signal.text + " is not a finite number", to_decimal(*bad),
              "finite numbers; `from` and `to` choose a part of the recording");
  }
}

void require_ascending(const JointRecording& recording) {
  for (std::size_t k = 1; k < recording.times.size(); ++k) {
    const double step = recording.times[k] - recording.times[k - 1];
    if (step == 0.0)
      fail_at(recording, k, "the time equals the time of the previous sample",
              readable(recording.times[k]), "ascending times");
    if (!(step > 0.0))
      fail_at(recording, k,
              "the time jumps back by " + readable(-step, 6) +
                  " s: the clock was set, or two recordings were joined",
              readable(recording.times[k]),
              "ascending times; `from` and `to` choose a part of the recording");
  }
}

/// ` from 7 s to 37 s`, without ends that the study does not choose.
std::string range_text(double from, double to) {
  return (std::isfinite(from) ? " from " + readable(from) + " s" : "") +
         (std::isfinite(to) ? " to " + readable(to) + " s" : "");
}

[[noreturn]] void refuse_length(const JointRecording& recording, std::size_t count, double from,
                                double to) {
  const auto [first, last] = std::minmax_element(recording.times.begin(), recording.times.end());
  const std::string reach =
      recording.times.empty()
          ? "the recording is empty"
          : "the recording reaches from " + readable(*first) + " s to " + readable(*last) + " s";
  throw InputError({recording.where, recording.element,
                    std::to_string(count) + " samples" + range_text(from, to) + "; " + reach, "",
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
      warn("recording_samples_missing",
           {recording.location_of(first), recording.element,
            std::to_string(count) + " pauses are longer than " + readable(kMissing) +
                " periods of " + readable(period, 4) +
                " s and are interpolated, the first before " + recording.place_of(first),
            "", ""}));
}

constexpr std::size_t kReach = 5,
                      kLongest = 3;  // samples beside one that its median takes; samples of a spike
constexpr double kSteps = 20.0;      // usual steps between neighbours by which a spike leaves them

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + to_signed(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The median of the steps between neighbours that are not zero; 0 if there are none.
double usual_step(const std::vector<double>& column) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < column.size(); ++k)
    if (column[k] != column[k - 1]) steps.push_back(std::abs(column[k] - column[k - 1]));
  return steps.empty() ? 0.0 : median_of(std::move(steps));
}

/// Samples that leave the median of their neighbours, which follows ramps and jumps, by many usual
/// steps.
std::vector<bool> suspects_of(const std::vector<double>& column) {
  const double most = kSteps * usual_step(column);
  std::vector<bool> suspects(column.size(), false);
  for (std::size_t k = 0; k < column.size(); ++k) {
    const std::size_t begin = k < kReach ? 0 : k - kReach,
                      end = std::min(column.size(), k + kReach + 1);
    const auto at = [&column](std::size_t i) { return column.begin() + to_signed(i); };
    suspects[k] = std::abs(column[k] - median_of({at(begin), at(end)})) > most;
  }
  return suspects;
}

/// The samples of spikes: short runs of suspects that leave the range of all other samples by more
/// than this range.
std::vector<std::size_t> spikes_of(const std::vector<double>& column) {
  const std::vector<bool> suspects = suspects_of(column);
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t k = 0; k < column.size(); ++k)
    if (!suspects[k]) {
      least = std::min(least, column[k]);
      most = std::max(most, column[k]);
    }
  std::vector<std::size_t> spikes;
  for (std::size_t begin = 0; begin < column.size(); ++begin) {
    std::size_t end = begin;
    while (end < column.size() && suspects[end]) ++end;
    const bool is_short = end - begin <= kLongest;
    for (std::size_t k = begin; k < end; ++k)
      if (is_short && std::max(column[k] - most, least - column[k]) > most - least)
        spikes.push_back(k);
    begin = end;
  }
  return spikes;
}

// Difference quotients are taken over this many samples on each side, so that the steps of an
// encoder do not hide the motion.
constexpr std::size_t kSpan = 5;
constexpr double kProportional = 0.9;

/// The relation of a measured velocity to the difference quotients of the position: factor of
/// proportion and correlation.
struct Proportion {
  double factor = 1.0, correlation = 0.0;
};

double quotient(const std::vector<double>& times, const std::vector<double>& position,
                std::size_t k) {
  return (position[k + kSpan] - position[k - kSpan]) / (times[k + kSpan] - times[k - kSpan]);
}

Proportion by_differences(const std::vector<double>& times, const std::vector<double>& position,
                          const std::vector<double>& velocity) {
  double dd = 0.0, vd = 0.0, vv = 0.0;
  for (std::size_t k = kSpan; k + kSpan < times.size(); ++k) {
    const double d = quotient(times, position, k), v = velocity[k];
    dd += d * d;
    vd += v * d;
    vv += v * v;
  }
  if (!(dd > 0.0 && vv > 0.0)) return {};
  return {vd / dd, vd / std::sqrt(dd * vv)};
}

void warn_of(const std::string& code, const JointRecording& recording, const std::string& message,
             const std::string& allowed, Warnings* warnings) {
  warnings->push_back(warn(
      code, {recording.where, recording.element, message + ": " + recording.file, "", allowed}));
}

/// Whether the position moves by more than its noise: difference quotients over separate samples
/// agree.
bool moves(const std::vector<double>& times, const std::vector<double>& position) {
  constexpr double kAlike = 0.5;
  constexpr std::size_t kApart = 2 * kSpan + 1;
  double products = 0.0, squares = 0.0;
  for (std::size_t k = kSpan; k + kSpan + kApart < times.size(); ++k) {
    const double d = quotient(times, position, k);
    products += d * quotient(times, position, k + kApart);
    squares += d * d;
  }
  return products > kAlike * squares;
}

/// Whether one column is the derivative of the other one, in the same units.
bool is_derivative(const std::vector<double>& times, const std::vector<double>& position,
                   const std::vector<double>& velocity) {
  constexpr double kTolerated = 0.2;
  if (position.empty() || velocity.empty()) return false;
  const Proportion found = by_differences(times, position, velocity);
  return found.correlation > kProportional && std::abs(found.factor - 1.0) < kTolerated;
}

/// What the velocity column holds instead, if a simple mistake tells.
std::string mistaken_velocity(const JointRecording& recording, const JointSamples& samples) {
  if (is_derivative(recording.times, samples.velocity, samples.position))
    return "it is the other way round: the two columns are exchanged";
  for (const JointSamples& other : recording.joints)
    if (other.joint != samples.joint &&
        is_derivative(recording.times, samples.position, other.velocity))
      return "the velocity of " + other.joint + " is: columns are exchanged";
  return "";
}

void check_velocity(const JointRecording& recording, const JointSamples& samples,
                    Warnings* warnings) {
  constexpr double kUnlike = 0.5;
  if (samples.position.empty() || samples.velocity.empty() ||
      is_derivative(recording.times, samples.position, samples.velocity))
    return;
  const Proportion found = by_differences(recording.times, samples.position, samples.velocity);
  const std::string mistake = mistaken_velocity(recording, samples);
  // Noise may hide a slow motion, and is no mistake.
  const bool both_move =
      moves(recording.times, samples.position) && moves(recording.times, samples.velocity);
  if (!mistake.empty() || (std::abs(found.correlation) < kUnlike && both_move))
    warn_of("recording_velocity", recording,
            "the velocity of " + samples.joint +
                " is not the derivative of its position (correlation " +
                readable(found.correlation, 2) + ")" + (mistake.empty() ? "" : "; " + mistake),
            "columns of the same joint; without a velocity, the derivative of the position is used",
            warnings);
  else if (std::abs(found.correlation) > kProportional)
    warn_of("recording_units", recording,
            "the velocity of " + samples.joint + " is " + readable(found.factor, 4) +
                " times the derivative of its position",
            "the same unit of angle or length, the same sign, and seconds; `scale` of a column "
            "converts",
            warnings);
}

void check_range(const JointRecording& recording, const JointSamples& samples,
                 const JointDescription& joint, Warnings* warnings) {
  if (samples.position.empty() || !has_stops(joint)) return;
  const double lower = joint.limit->lower.nominal(), upper = joint.limit->upper.nominal();
  const auto [least, most] = std::minmax_element(samples.position.begin(), samples.position.end());
  const double beyond = std::max(lower - *least, *most - upper);
  if (!(beyond > 0.5 * (upper - lower))) return;
  warn_of("recording_beyond_limits", recording,
          "the position of " + samples.joint + " goes from " + readable(*least, 6) + " to " +
              readable(*most, 6) + ", far beyond the limits of the joint",
          "[" + readable(lower, 6) + ", " + readable(upper, 6) +
              "] in rad or m; `scale: 0.017453292519943295` converts degrees",
          warnings);
}

}  // namespace

double median_period(const std::vector<double>& times) {
  std::vector<double> periods;
  periods.reserve(times.size() - 1);
  for (std::size_t k = 1; k < times.size(); ++k) periods.push_back(times[k] - times[k - 1]);
  const auto middle = periods.begin() + to_signed(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

JointRecording checked_part(const JointRecording& recording, double from, double to) {
  for (std::size_t k = 0; k < recording.times.size(); ++k)
    if (!std::isfinite(recording.times[k]))
      fail_at(recording, k, "the time is not a finite number", to_decimal(recording.times[k]),
              "seconds that ascend");
  const auto inside = [from, to](double time) { return from <= time && time <= to; };
  const auto first = std::find_if(recording.times.begin(), recording.times.end(), inside);
  const auto last = std::find_if(recording.times.rbegin(), recording.times.rend(), inside).base();
  if (last - first < to_signed(kLeastSamples))
    refuse_length(recording, to_index(std::max<std::ptrdiff_t>(last - first, 0)), from, to);
  JointRecording part = part_of(recording, to_index(first - recording.times.begin()),
                                to_index(last - recording.times.begin()));
  require_ascending(part);
  require_finite(part);
  return part;
}

std::vector<JointRecording> without_gaps(const JointRecording& recording, GapRule rule,
                                         Warnings* warnings, bool has_rule) {
  const double period = median_period(recording.times);
  const std::vector<std::size_t> ends = piece_ends(recording.times, kGapPeriods * period);
  std::vector<JointRecording> pieces;
  for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece) {
    const std::size_t begin = ends[piece], end = ends[piece + 1];
    if (begin > 0 && rule == GapRule::kRefuse)
      fail_at(recording, begin,
              "a gap of " + readable(recording.times[begin] - recording.times[begin - 1], 6) +
                  " s, where the period is " + readable(period, 4) +
                  " s: the recording paused, samples were lost, or the clock was set",
              "",
              "pauses of at most " + readable(kGapPeriods) + " periods" +
                  (has_rule ? "; `gaps: split` uses the pieces as recordings of their own" : ""));
    if (end - begin >= kLeastSamples)
      pieces.push_back(part_of(recording, begin, end));
    else
      warnings->push_back(
          warn("recording_piece_dropped",
               {recording.location_of(begin), recording.element,
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
    const auto found =
        std::find_if(recording->joints.begin(), recording->joints.end(),
                     [&joint](const JointSamples& samples) { return samples.joint == joint.name; });
    if (!joint.is_turn() || found == recording->joints.end()) continue;
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
          warn("recording_unwrapped",
               {recording->location_of(first), recording->element,
                "the position of " + joint.name + " jumps by more than half a turn " +
                    std::to_string(jumps) + " times, first at " + recording->place_of(first) +
                    "; whole turns were added",
                "", ""}));
  }
}

void check_spikes(const JointRecording& recording, Warnings* warnings,
                  const std::atomic<bool>* cancel) {
  for (const JointSamples& samples : recording.joints)
    for (std::size_t q = 0; q < kMeasuredQuantityNames.size(); ++q) {
      const std::vector<double>& column = samples.of(static_cast<MeasuredQuantity>(q));
      if (is_set(cancel)) return;
      const std::vector<std::size_t> spikes = spikes_of(column);
      if (spikes.empty()) continue;
      const std::size_t first = spikes.front();
      warnings->push_back(warn(
          "recording_spike",
          {recording.location_of(first), recording.element,
           "the " + std::string(kMeasuredQuantityNames[q]) + " of " + samples.joint + " jumps to " +
               readable(column[first], 6) + " and back (" + recording.place_of(first) + ")" +
               (spikes.size() > 1 ? ", one of " + std::to_string(spikes.size()) + " such samples"
                                  : ""),
           "",
           "a recording without it: `from` and `to`; or `loss: {type: huber}`, which lets it count "
           "less"}));
    }
}

void check_units(const RobotDescription& robot, const JointRecording& recording,
                 Warnings* warnings) {
  for (const JointDescription& joint : robot.joints) {
    const JointSamples* samples = recording.find(joint.name);
    if (samples == nullptr) continue;
    check_velocity(recording, *samples, warnings);
    check_range(recording, *samples, joint, warnings);
  }
}

}  // namespace codesign
