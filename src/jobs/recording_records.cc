// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/recording_records.h"

#include <cmath>
#include <utility>

#include "description/study.h"
#include "equations/equations.h"
#include "excitation/excitation_result.h"
#include "jobs/fit_fields.h"
#include "jobs/identification_records.h"
#include "jobs/json.h"
#include "jobs/record_json.h"
#include "math/arrays.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kFactorDigits = 3;  // of a predicted factor

Json trajectory_json(const ExcitationDescription& description, const ExcitationResult& result) {
  Json object;
  object["kind"] = kTrajectoryNames[to_index(description.trajectory)];
  object["period"] = description.period;
  object["periods"] = description.periods;
  object["sample_rate"] = description.sample_rate;
  if (description.trajectory == TrajectoryKind::kFourier)
    object["harmonics"] = description.harmonics;
  else
    object["knots"] = description.knots;
  for (std::size_t joint = 0; joint < result.points.joints.size(); ++joint) {
    const auto column = to_signed(joint);
    const Eigen::VectorXd coefficients = result.coefficients.col(column);
    object["joints"][result.points.joints[joint]] = {
        {"rest", result.rest[column]},
        {"coefficients", std::vector<double>(coefficients.begin(), coefficients.end())}};
  }
  return object;
}

Json compared_json(const ExcitationResult& result) {
  const ComparedTrajectory& compared = *result.compared;
  Json object = record_json(compared);
  if (!compared.status.ok()) {
    object["error"] = to_json(compared.status);
    return object;
  }
  object["volume_factor"] = std::exp(0.5 * (result.criterion_before - compared.criterion));
  for (std::size_t k = 0; k < result.numbers.size(); ++k)
    object["deviations"][result.numbers[k].name] = compared.deviations[to_signed(k)];
  for (std::size_t k = 0; k < result.base.size(); ++k)
    object["base"][result.base[k].expression] = compared.base[to_signed(k)];
  for (const KeptLimit& limit : compared.limits)
    object["limits"][limit.limits.name] = record_json(limit);
  return object;
}

}  // namespace

RecordingSummary summary_of(const JointRecording& recording, const MeasuredMotion& motion) {
  RecordingSummary summary;
  summary.element = recording.element;
  summary.file = recording.file;
  summary.samples = recording.times.size();
  summary.fitted = motion.fitted();
  summary.from = recording.times.front();
  summary.to = recording.times.back();
  summary.rate = motion.times.rate();
  for (const JointSamples& samples : recording.joints)
    for (std::size_t k = 0; k < kMeasuredQuantityNames.size(); ++k)
      if (!samples.of(static_cast<MeasuredQuantity>(k)).empty())
        summary.measured.push_back(samples.joint + "/" + kMeasuredQuantityNames[k]);
  return summary;
}

Json to_json(const std::vector<RecordingSummary>& recordings) { return records_json(recordings); }

Json excitation_json(const Problem& problem, const ExcitationResult& result) {
  Json object = record_json(result);
  if (result.numbers.empty()) return object;
  object["parameters"] = parameters_json(problem, problem.parameters());
  for (const PredictedNumber& number : result.numbers)
    object["predicted"][number.name] = record_json(number);
  object["level"] = study_of(problem).identification->intervals.level;
  for (const PredictedBase& base : result.base)
    object["base"][base.expression] =
        record_json(BeforeAfter{base.deviation_before, base.deviation});
  if (result.compared) object["compared"] = compared_json(result);
  if (result.points.joints.empty()) return object;
  for (const KeptLimit& limit : result.limits)
    object["limits"][limit.limits.name] = record_json(limit);
  object["trajectory"] = trajectory_json(*study_of(problem).excitation, result);
  object["starts"] = records_json(result.starts);
  return object;
}

std::vector<std::string> excitation_sentences(const ExcitationResult& result) {
  std::vector<std::string> sentences;
  if (result.status.ok() && !result.undetermined.empty())
    sentences.push_back("trajectories determine " + std::to_string(result.counted) +
                        " numbers or combinations of " + std::to_string(result.numbers.size()) +
                        " numbers; the prior decides the other " +
                        std::to_string(result.numbers.size() - to_index(result.counted)));
  else
    append_first("not identifiable by any trajectory: ", result.undetermined,
                 "excitation.json has all", &sentences);
  if (result.points.joints.empty()) return sentences;
  if (!std::isfinite(result.criterion))
    sentences.push_back("no single trajectory was found that determines all numbers");
  else if (!std::isfinite(result.criterion_before))
    sentences.push_back(
        "the plain trajectory does not determine all identifiable numbers; the trajectory found "
        "does");
  else
    sentences.push_back(
        "predicted volume of the intervals: " + readable(result.volume_factor(), kFactorDigits) +
        " times smaller than with the plain trajectory, each interval on average " +
        readable(mean_factor(result), kFactorDigits) + " times");
  return sentences;
}

std::vector<std::string> trajectory_columns(const TrajectoryPoints& points) {
  std::vector<std::string> columns = {"time"};
  for (const std::string& joint : points.joints)
    for (const char* quantity : {"/position", "/velocity", "/acceleration", "/effort"})
      columns.push_back(joint + quantity);
  return columns;
}

std::vector<std::vector<std::string>> trajectory_rows(const TrajectoryPoints& points) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(points.times.size());
  for (std::size_t k = 0; k < points.times.size(); ++k) {
    const auto column = to_signed(k);
    std::vector<std::string> cells = {to_decimal(points.times[k])};
    for (Eigen::Index joint = 0; joint < points.position.rows(); ++joint)
      for (const Eigen::MatrixXd* part :
           {&points.position, &points.velocity, &points.acceleration, &points.effort})
        cells.push_back(to_decimal((*part)(joint, column)));
    rows.push_back(std::move(cells));
  }
  return rows;
}

}  // namespace codesign
