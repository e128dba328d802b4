// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/residuals_of_recordings.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "description/study.h"
#include "engine/thread_engine.h"
#include "identification/effort/effort_residuals.h"
#include "identification/motion/motion_residuals.h"
#include "problem/load_problem.h"
#include "text/cancel.h"

namespace codesign {
namespace {

/// Null once `cancel` is set.
std::unique_ptr<RecordingResiduals> residuals_alike(const Problem& problem,
                                                    const FitVariables& variables,
                                                    const std::vector<MeasuredJoint>& joints,
                                                    const std::vector<JointRecording>& recordings,
                                                    const std::atomic<bool>* cancel,
                                                    Warnings* warnings) {
  const IdentificationDescription& options = *study_of(problem).identification;
  const int threads = worker_threads(study_of(problem).ensemble.engine);
  if (options.residual == ResidualKind::kMotion)
    return std::make_unique<MotionResiduals>(*system_of(problem), variables, options, joints,
                                             recordings, threads, warnings);
  require_efforts(joints, recordings);
  const FilterOptions& filter = options.filter;
  std::vector<MeasuredMotion> motions;
  motions.reserve(recordings.size());
  for (const JointRecording& recording : recordings)
    if (!is_set(cancel)) motions.push_back(measured_motion(recording, filter, warnings));
  if (is_set(cancel)) return nullptr;
  return std::make_unique<EffortResiduals>(*system_of(problem), variables, joints,
                                           std::move(motions), filter, threads,
                                           require_same_signals(recordings));
}

/// As make_residuals(), whatever a mask leaves.
std::unique_ptr<RecordingResiduals> residuals_of(const Problem& problem,
                                                 const FitVariables& variables,
                                                 const std::vector<MeasuredJoint>& joints,
                                                 const std::vector<JointRecording>& recordings,
                                                 const std::atomic<bool>* cancel,
                                                 Warnings* warnings) {
  const auto has_settings = [](const JointRecording& recording) {
    return !recording.settings.empty();
  };
  if (std::none_of(recordings.begin(), recordings.end(), has_settings))
    return residuals_alike(problem, variables, joints, recordings, cancel, warnings);
  std::vector<StackedResiduals::Part> parts;
  for (auto begin = recordings.begin(); begin != recordings.end();) {
    const auto end = std::find_if(begin, recordings.end(), [&](const JointRecording& other) {
      return !has_same_settings(other, *begin);
    });
    auto variables_of =
        std::make_unique<FitVariables>(study_of(problem), &robot_of(problem), begin->settings);
    auto residuals =
        residuals_alike(problem, *variables_of, joints, {begin, end}, cancel, warnings);
    if (!residuals) return nullptr;
    parts.push_back({std::move(variables_of), std::move(residuals)});
    begin = end;
  }
  return std::make_unique<StackedResiduals>(std::move(parts));
}

}  // namespace

std::unique_ptr<RecordingResiduals> make_residuals(const Problem& problem,
                                                   const FitVariables& variables,
                                                   const std::vector<MeasuredJoint>& joints,
                                                   const std::vector<JointRecording>& recordings,
                                                   const std::atomic<bool>* cancel,
                                                   Warnings* warnings) {
  auto residuals = residuals_of(problem, variables, joints, recordings, cancel, warnings);
  if (residuals) require_counted(residuals->outputs(), residuals->counted(), recordings);
  return residuals;
}

FittedSeries series_of(const RecordingResiduals& source, const Eigen::MatrixXd& residuals) {
  FittedSeries series{source.lengths(), source.times(), source.recorded(),
                      source.recorded() + residuals};
  const Eigen::MatrixXd counted = source.counted();
  for (Eigen::Index k = 0; k < counted.size(); ++k)
    if (counted.reshaped()[k] == 0.0)
      series.computed.reshaped()[k] = std::numeric_limits<double>::quiet_NaN();
  return series;
}

}  // namespace codesign
