// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/even_stamps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "recordings/recording_check.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// Stamps beside the line of equal steps that fits them best: stamp k = at(k) + off[k].
struct StampLine {
  std::vector<double> number;  // of the step at which a sample was taken; more than the one before
  double start = 0.0, step = 0.0;
  std::vector<double> off;
  double largest = 0.0, spread = 0.0;  // of |off|: the most, and the root mean square [s]

  double at(std::size_t k) const { return start + number[k] * step; }
};

/// The mean of the usual periods: of stamps that are rounded, such as 3, 7 and 10 ms, the median is
/// another one.
double usual_period(const std::vector<double>& times) {
  const double median = median_period(times);
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 1; k < times.size(); ++k)
    if (const double period = times[k] - times[k - 1];
        0.5 * median < period && period < 1.5 * median) {
      sum += period;
      count += 1.0;
    }
  return sum / count;
}

/// Numbers of steps. The expected time follows the stamps slowly, so that one that is late does not
/// move those behind it.
std::vector<double> step_numbers(const std::vector<double>& times) {
  constexpr double kFollow = 0.1;
  const double period = usual_period(times);
  std::vector<double> numbers{0.0};
  double expected = times.front();
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double steps = std::max(1.0, std::round((times[k] - expected) / period));
    numbers.push_back(numbers.back() + steps);
    expected += steps * period;
    expected += kFollow * (times[k] - expected);
  }
  return numbers;
}

StampLine line_through(const std::vector<double>& times, std::vector<double> numbers) {
  StampLine line;
  line.number = std::move(numbers);
  const auto count = static_cast<double>(times.size());
  double mean_number = 0.0, mean_time = 0.0, nn = 0.0, nt = 0.0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    mean_number += line.number[k] / count;
    mean_time += (times[k] - times.front()) / count;
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    nn += (line.number[k] - mean_number) * (line.number[k] - mean_number);
    nt += (line.number[k] - mean_number) * (times[k] - times.front() - mean_time);
  }
  line.step = nt / nn;
  line.start = times.front() + mean_time - line.step * mean_number;
  for (std::size_t k = 0; k < times.size(); ++k) {
    line.off.push_back(times[k] - line.at(k));
    line.largest = std::max(line.largest, std::abs(line.off.back()));
    line.spread += line.off.back() * line.off.back() / count;
  }
  line.spread = std::sqrt(line.spread);
  return line;
}

/// A pause may be a sample that is missing, or a stamp that is late: what leaves the smaller jitter
/// counts.
StampLine stamp_line(const std::vector<double>& times) {
  std::vector<double> whole(times.size());
  std::iota(whole.begin(), whole.end(), 0.0);
  StampLine with_missing = line_through(times, step_numbers(times)),
            without = line_through(times, std::move(whole));
  return with_missing.spread < without.spread ? with_missing : without;
}

/// What a column tells of `share` in x_k = x(at(k) + share off[k]): its estimate times its
/// information, and its information.
struct Evidence {
  double weighted = 0.0, information = 0.0;
};

/// Fourth differences of five neighbours take the smooth motion away and leave what jitter and
/// noise do.
Evidence evidence_of(const StampLine& line, const std::vector<double>& column) {
  const auto fourth = [](const auto& x) {
    return x(0) - 4.0 * x(1) + 6.0 * x(2) - 4.0 * x(3) + x(4);
  };
  double yy = 0.0, yz = 0.0, zz = 0.0, count = 0.0;
  for (std::size_t k = 0; k + 4 < column.size(); ++k) {
    if (line.number[k + 4] - line.number[k] != 4.0) continue;
    const double rate = (column[k + 4] - column[k]) / (4.0 * line.step);
    const double y = fourth([&](std::size_t j) { return column[k + j]; });
    const double z = rate * fourth([&](std::size_t j) { return line.off[k + j]; });
    yy += y * y;
    yz += y * z;
    zz += z * z;
    count += 1.0;
  }
  if (!(zz > 0.0) || count < static_cast<double>(kLeastSamples)) return {};
  const double variance = std::max((yy - yz * yz / zz) / count, 1e-12 * yy / count);
  return variance > 0.0 ? Evidence{yz / variance, zz / variance} : Evidence{};
}

}  // namespace

void even_stamps(JointRecording* recording, Warnings* warnings) {
  constexpr double kExact = 1e-3, kMost = 2.0,
                   kMostSpread = 0.2;  // of a step; beyond, nothing tells which samples are missing
  constexpr double kHalf = 0.5, kDeviations = 5.0;
  const StampLine line = stamp_line(recording->times);
  if (line.largest < kExact * line.step || line.largest > kMost * line.step ||
      line.spread > kMostSpread * line.step)
    return;
  Evidence all;
  for (const JointSamples& samples : recording->joints) {
    const Evidence one =
        evidence_of(line, samples.position.empty() ? samples.velocity : samples.position);
    all.weighted += one.weighted;
    all.information += one.information;
  }
  if (!(all.information > 0.0)) return;
  const double share = all.weighted / all.information;
  if (!(kHalf - share > kDeviations / std::sqrt(all.information))) return;
  for (std::size_t k = 0; k < recording->times.size(); ++k) recording->times[k] = line.at(k);
  warnings->push_back(
      warn("recording_even_stamps",
           {recording->where, recording->element,
            "the times jitter by up to " + readable(line.largest, 3) +
                " s, but the motion does not: the samples are taken at equal steps of " +
                readable(line.step, 6) + " s: " + recording->file,
            "", ""}));
}

}  // namespace codesign
