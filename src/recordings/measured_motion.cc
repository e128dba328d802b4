// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/measured_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "recordings/recording_check.h"
#include "recordings/zero_phase_filter.h"
#include "text/number_text.h"

namespace codesign {
namespace {

void require_below_half_rate(const std::string& key, double cutoff, const FilterOptions& filter, const JointRecording& recording,
                             double rate) {
  if (cutoff < 0.5 * rate) return;
  throw InputError({filter.where, "identify.filter." + key,
                    "a recording of " + readable(rate, 6) + " samples per second holds no frequency that high: " + recording.file,
                    readable(cutoff), "less than " + readable(0.5 * rate, 6) + " Hz, or 0 for no filter"});
}

/// Sets the range of the samples to fit. @return whether the filter can run
bool choose_samples(const FilterOptions& filter, MeasuredMotion* motion) {
  constexpr double kDifferences = 4.0, kSettling = 2.0;
  const double rate = motion->times.rate();
  double edge = kDifferences;
  for (const double cutoff : {filter.cutoff, filter.residual_cutoff})
    if (cutoff > 0.0) edge += kSettling * rate / cutoff;
  // A very low cutoff would leave out more samples than an index counts.
  motion->first = static_cast<Eigen::Index>(std::ceil(std::min(edge, static_cast<double>(motion->times.count))));
  motion->end = motion->times.count - motion->first;
  motion->every = filter.decimate;
  const Eigen::Index padding = 3 * (filter.order + 1) + 1;
  return motion->times.count >= padding;
}

void require_samples(const JointRecording& recording, const FilterOptions& filter, MeasuredMotion* motion) {
  if (choose_samples(filter, motion) && motion->fitted() >= static_cast<Eigen::Index>(kLeastSamples)) return;
  throw InputError({recording.where, recording.element,
                    std::to_string(motion->times.count) + " samples leave " + std::to_string(motion->fitted()) +
                        " to fit, without the ends where filters know one side only: " + recording.file,
                    "",
                    "at least " + std::to_string(kLeastSamples) + " to fit; a longer recording, a higher cutoff, or a smaller decimate"});
}

void warn_of_samples(const JointRecording& recording, const FilterOptions& filter, const MeasuredMotion& motion, Warnings* warnings) {
  const double rate = motion.times.rate(), fitted_rate = rate / filter.decimate;
  const auto warn_of = [&](const std::string& code, const std::string& message, const std::string& allowed) {
    warnings->push_back(warn(code, {recording.where, recording.element, message + ": " + recording.file, "", allowed}));
  };
  if (!motion.times.exact)
    warn_of("recording_resampled", "the times are not equally spaced; values were interpolated at " + readable(rate, 6) + " Hz", "");
  if (filter.cutoff <= 0.0)
    warn_of("recording_not_filtered", "accelerations are differences of samples that no filter smoothed, which makes noise large",
            "identify.filter.cutoff above the fastest motion, such as " + readable(0.1 * rate, 4) + " Hz");
  if (filter.decimate > 1 && (filter.residual_cutoff <= 0.0 || filter.residual_cutoff > 0.5 * fitted_rate))
    warn_of("recording_aliased",
            "every " + std::to_string(filter.decimate) + "th sample is fitted, which folds noise above " + readable(0.5 * fitted_rate, 6) +
                " Hz into the rest",
            "identify.filter.residual_cutoff below that, or a smaller decimate");
}

JointMotion motion_of(const JointSamples& samples, const std::vector<double>& times, const UniformTimes& uniform,
                      const std::optional<ZeroPhaseFilter>& filter, ZeroPhaseFilter::Workspace* workspace) {
  JointMotion motion;
  motion.joint = samples.joint;
  const auto smooth = [&](const std::vector<double>& column) {
    Eigen::VectorXd values = resample(times, column, uniform, Between::kCubic);
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
  if (!samples.effort.empty()) motion.effort = resample(times, samples.effort, uniform, Between::kLinear);
  return motion;
}

}  // namespace

Eigen::Index samples_to_fit(const JointRecording& recording, const FilterOptions& filter) {
  MeasuredMotion motion;
  motion.times = uniform_times(recording.times);
  return choose_samples(filter, &motion) ? motion.fitted() : 0;
}

MeasuredMotion measured_motion(const JointRecording& recording, const FilterOptions& filter, Warnings* warnings) {
  MeasuredMotion motion;
  motion.element = recording.element;
  motion.times = uniform_times(recording.times);
  require_below_half_rate("cutoff", filter.cutoff, filter, recording, motion.times.rate());
  require_below_half_rate("residual_cutoff", filter.residual_cutoff, filter, recording, motion.times.rate());
  require_samples(recording, filter, &motion);
  warn_of_samples(recording, filter, motion, warnings);
  std::optional<ZeroPhaseFilter> smoothing;
  if (filter.cutoff > 0.0) smoothing.emplace(filter.order, filter.cutoff, motion.times.rate());
  ZeroPhaseFilter::Workspace workspace;
  for (const JointSamples& samples : recording.joints)
    motion.joints.push_back(motion_of(samples, recording.times, motion.times, smoothing, &workspace));
  return motion;
}

}  // namespace codesign
