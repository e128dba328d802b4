// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/measured_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "math/arrays.h"
#include "recordings/recording_check.h"
#include "recordings/zero_phase_filter.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// The slope at sample k of the parabola through it and its neighbours; at an end, of the parabola
/// through the last three samples.
double slope_at(const std::vector<double>& t, const std::vector<double>& x, std::size_t k) {
  const std::size_t middle = std::clamp<std::size_t>(k, 1, t.size() - 2);
  const double h0 = t[middle] - t[middle - 1], h1 = t[middle + 1] - t[middle];
  const double d0 = (x[middle] - x[middle - 1]) / h0, d1 = (x[middle + 1] - x[middle]) / h1;
  if (k < middle) return d0 - h0 * (d1 - d0) / (h0 + h1);
  if (k > middle) return d1 + h1 * (d1 - d0) / (h0 + h1);
  return (h1 * d0 + h0 * d1) / (h0 + h1);
}

/// The value in the interval that begins with sample k, at the fraction `u` of it.
double value_in(const std::vector<double>& t, const std::vector<double>& x, std::size_t k, double u,
                Resampling between) {
  const double rise = x[k + 1] - x[k];
  if (between == Resampling::kLinear) return x[k] + u * rise;
  const double h = t[k + 1] - t[k], from = h * slope_at(t, x, k) - rise,
               to = rise - h * slope_at(t, x, k + 1);
  return x[k] + u * rise + u * (1.0 - u) * ((1.0 - u) * from + u * to);
}

// Weights of the samples at distances 1, 2, 3, 4; Fornberg, Math. Comput. 51, 699-706 (1988),
// table 1.
constexpr std::array<std::array<double, 4>, 4> kCentral{
    {{1.0 / 2.0, 0.0, 0.0, 0.0},
     {2.0 / 3.0, -1.0 / 12.0, 0.0, 0.0},
     {3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0, 0.0},
     {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0}}};

void require_below_half_rate(const std::string& key, double cutoff, const FilterOptions& filter,
                             const JointRecording& recording, double rate) {
  if (cutoff < 0.5 * rate) return;
  throw InputError({filter.where, "identify.filter." + key,
                    "a recording of " + readable(rate, 6) +
                        " samples per second holds no frequency that high: " + recording.file,
                    readable(cutoff),
                    "less than " + readable(0.5 * rate, 6) + " Hz, or 0 for no filter"});
}

/// Sets the range of the samples to fit. @return whether the filter can run
bool choose_samples(const FilterOptions& filter, MeasuredMotion* motion) {
  constexpr double kDifferences = 4.0, kSettling = 2.0;
  const double rate = motion->times.rate();
  double edge = kDifferences;
  for (const double cutoff : {filter.cutoff, filter.residual_cutoff})
    if (cutoff > 0.0) edge += kSettling * rate / cutoff;
  // A very low cutoff would leave out more samples than an index counts.
  motion->first = static_cast<Eigen::Index>(
      std::ceil(std::min(edge, static_cast<double>(motion->times.count))));
  motion->end = motion->times.count - motion->first;
  motion->every = filter.decimate;
  const Eigen::Index padding = 3 * (filter.order + 1) + 1;
  return motion->times.count >= padding;
}

void require_samples(const JointRecording& recording, const FilterOptions& filter,
                     MeasuredMotion* motion) {
  if (choose_samples(filter, motion) && motion->fitted() >= to_signed(kLeastSamples)) return;
  throw InputError(
      {recording.where, recording.element,
       std::to_string(motion->times.count) + " samples leave " + std::to_string(motion->fitted()) +
           " to fit, without the ends where filters know one side only: " + recording.file,
       "",
       "at least " + std::to_string(kLeastSamples) +
           " to fit; a longer recording, a higher cutoff, or a smaller decimate"});
}

void warn_of_samples(const JointRecording& recording, const FilterOptions& filter,
                     const MeasuredMotion& motion, Warnings* warnings) {
  const double rate = motion.times.rate(), fitted_rate = rate / filter.decimate;
  const auto warn_of = [&](const std::string& code, const std::string& message,
                           const std::string& allowed) {
    warnings->push_back(warn(
        code, {recording.where, recording.element, message + ": " + recording.file, "", allowed}));
  };
  if (!motion.times.exact)
    warn_of("recording_resampled",
            "the times are not equally spaced; values were interpolated at " + readable(rate, 6) +
                " Hz",
            "");
  if (filter.cutoff <= 0.0)
    warn_of(
        "recording_not_filtered",
        "accelerations are differences of samples that no filter smoothed, which makes noise large",
        "identify.filter.cutoff above the fastest motion, such as " + readable(0.1 * rate, 4) +
            " Hz");
  if (filter.decimate > 1 &&
      (filter.residual_cutoff <= 0.0 || filter.residual_cutoff > 0.5 * fitted_rate))
    warn_of("recording_aliased",
            "every " + std::to_string(filter.decimate) +
                "th sample is fitted, which folds noise above " + readable(0.5 * fitted_rate, 6) +
                " Hz into the rest",
            "identify.filter.residual_cutoff below that, or a smaller decimate");
}

JointMotion motion_of(const JointSamples& samples, const std::vector<double>& times,
                      const UniformTimes& uniform, const std::optional<ZeroPhaseFilter>& filter,
                      ZeroPhaseFilter::Workspace* workspace) {
  JointMotion motion;
  motion.joint = samples.joint;
  const auto smooth = [&](const std::vector<double>& column) {
    Eigen::VectorXd values = resample(times, column, uniform, Resampling::kCubic);
    if (filter) filter->apply(values, workspace);
    return values;
  };
  if (!samples.position.empty()) motion.position = smooth(samples.position);
  motion.velocity_measured = !samples.velocity.empty();
  if (motion.velocity_measured)
    motion.velocity = smooth(samples.velocity);
  else if (!samples.position.empty())
    motion.velocity = derivative(motion.position, uniform.step);
  motion.position_measured = !samples.position.empty();
  if (!motion.position_measured && motion.velocity_measured && samples.start)
    motion.position = integral(motion.velocity, uniform.step).array() + samples.start->value;
  if (motion.velocity.size() > 0) motion.acceleration = derivative(motion.velocity, uniform.step);
  if (!samples.effort.empty())
    motion.effort = resample(times, samples.effort, uniform, Resampling::kLinear);
  motion.least_speed = samples.least_speed;
  motion.has_bounds = samples.has_bounds;
  return motion;
}

}  // namespace

UniformTimes uniform_times(const std::vector<double>& times) {
  const double period = median_period(times);
  double periods = 0.0;
  for (std::size_t k = 1; k < times.size(); ++k)
    periods += std::max(1.0, std::round((times[k] - times[k - 1]) / period));
  UniformTimes uniform;
  uniform.start = times.front();
  uniform.step = (times.back() - times.front()) / periods;
  uniform.count = static_cast<std::ptrdiff_t>(periods) + 1;
  double off = 0.0;
  for (std::size_t k = 0; k < times.size(); ++k)
    off = std::max(off, std::abs(times[k] - uniform.at(to_signed(k))));
  constexpr double kJitter = 1e-3;
  uniform.exact = uniform.count == to_signed(times.size()) && off < kJitter * uniform.step;
  return uniform;
}

Eigen::VectorXd resample(const std::vector<double>& times, const std::vector<double>& values,
                         const UniformTimes& uniform, Resampling between) {
  if (uniform.exact) return Eigen::Map<const Eigen::VectorXd>(values.data(), uniform.count);
  Eigen::VectorXd result(uniform.count);
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < uniform.count; ++i) {
    const double t = uniform.at(i);
    while (k + 2 < times.size() && times[k + 1] <= t) ++k;
    const double u = std::clamp((t - times[k]) / (times[k + 1] - times[k]), 0.0, 1.0);
    result[i] = value_in(times, values, k, u, between);
  }
  return result;
}

Eigen::VectorXd derivative(const Eigen::VectorXd& samples, double step) {
  const Eigen::Index n = samples.size();
  Eigen::VectorXd result(n);
  for (Eigen::Index k = 1; k + 1 < n; ++k) {
    const Eigen::Index reach = std::min<Eigen::Index>({4, k, n - 1 - k});
    double sum = 0.0;
    for (Eigen::Index j = 1; j <= reach; ++j)
      sum += kCentral[to_index(reach - 1)][to_index(j - 1)] * (samples[k + j] - samples[k - j]);
    result[k] = sum / step;
  }
  result[0] = (-1.5 * samples[0] + 2.0 * samples[1] - 0.5 * samples[2]) / step;
  result[n - 1] = (1.5 * samples[n - 1] - 2.0 * samples[n - 2] + 0.5 * samples[n - 3]) / step;
  return result;
}

Eigen::VectorXd integral(const Eigen::VectorXd& samples, double step) {
  const Eigen::Index n = samples.size();
  const auto at = [&samples](Eigen::Index k) { return samples[k]; };
  Eigen::VectorXd result = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    double mean = 0.0;
    if (k >= 2 && k + 3 < n)
      mean = (802.0 * (at(k) + at(k + 1)) - 93.0 * (at(k - 1) + at(k + 2)) +
              11.0 * (at(k - 2) + at(k + 3))) /
             1440.0;
    else if (k >= 1 && k + 2 < n)
      mean = (13.0 * (at(k) + at(k + 1)) - at(k - 1) - at(k + 2)) / 24.0;
    else if (k == 0)
      mean = (9.0 * at(0) + 19.0 * at(1) - 5.0 * at(2) + at(3)) / 24.0;
    else
      mean = (9.0 * at(n - 1) + 19.0 * at(n - 2) - 5.0 * at(n - 3) + at(n - 4)) / 24.0;
    result[k + 1] = result[k] + step * mean;
  }
  return result;
}

Eigen::Index samples_to_fit(const JointRecording& recording, const FilterOptions& filter) {
  MeasuredMotion motion;
  motion.times = uniform_times(recording.times);
  return choose_samples(filter, &motion) ? motion.fitted() : 0;
}

MeasuredMotion measured_motion(const JointRecording& recording, const FilterOptions& filter,
                               Warnings* warnings) {
  MeasuredMotion motion;
  motion.element = recording.element;
  motion.where = recording.where;
  motion.times = uniform_times(recording.times);
  require_below_half_rate("cutoff", filter.cutoff, filter, recording, motion.times.rate());
  require_below_half_rate("residual_cutoff", filter.residual_cutoff, filter, recording,
                          motion.times.rate());
  require_samples(recording, filter, &motion);
  warn_of_samples(recording, filter, motion, warnings);
  std::optional<ZeroPhaseFilter> smoothing;
  if (filter.cutoff > 0.0) smoothing.emplace(filter.order, filter.cutoff, motion.times.rate());
  ZeroPhaseFilter::Workspace workspace;
  for (const JointSamples& samples : recording.joints)
    motion.joints.push_back(
        motion_of(samples, recording.times, motion.times, smoothing, &workspace));
  for (const SignalSamples& samples : recording.signals)
    motion.signals.push_back(
        resample(recording.times, samples.values, motion.times, Resampling::kLinear));
  return motion;
}

}  // namespace codesign
