// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/entry_keys.h"
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <limits>
#include <string>

#include "description/recording_masks.h"
#include "math/arrays.h"
#include "reading/study/study_options.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

FilterOptions read_filter(const YamlValue& filter) {
  FilterOptions options;
  options.where = filter.where();
  read_options(filter, &options);
  if (!filter.find("residual_cutoff")) options.residual_cutoff = options.cutoff;
  return options;
}

using CalibrationKeys = EntryKeys<JointCalibration, RobotDescription>;

const CalibrationKeys& calibration_keys() {
  constexpr double kAny = -std::numeric_limits<double>::infinity();
  static const auto fitted_key = [](const char* name, double lower,
                                    FittedNumber JointCalibration::*member) {
    return optional_key<JointCalibration, RobotDescription>(
        name, [lower, member](const YamlValue& value, const RobotDescription&,
                              JointCalibration* of) { read_fitted(value, lower, &(of->*member)); });
  };
  static const CalibrationKeys kKeys{
      fitted_key("effort_scale", kAny, &JointCalibration::effort_scale),
      fitted_key("delay", 0.0, &JointCalibration::delay),
      fitted_key("offset", kAny, &JointCalibration::offset)};
  return kKeys;
}

JointCalibration read_calibration(const std::string& name, const YamlValue& value,
                                  const RobotDescription& robot) {
  JointCalibration calibration;
  calibration.joint = scalar_joint(name, robot, value).name;
  calibration.where = value.where();
  read_entry(value, calibration_keys(), robot, &calibration);
  if (calibration.effort_scale.value == 0.0)
    value.at("effort_scale")
        .fail("a scale of zero leaves nothing of the measurement", "any other number");
  return calibration;
}

/// A holdout is never fitted, so that its starts must be known numbers.
void refuse_fitted_starts(const std::vector<RecordingDescription>& holdout) {
  for (const RecordingDescription& recording : holdout)
    for (const StartPosition& start : recording.starts)
      if (start.position.is_fitted)
        throw InputError({start.position.where, recording.element + ".start." + start.joint,
                          "a holdout is never fitted, so that its start must be known", "a map",
                          "a number in rad or m"});
}

LossOptions read_loss(const YamlValue& loss) {
  LossOptions options;
  read_options(loss, &options, {"type"});
  if (const auto scale = loss.find("scale"); scale && options.kind == LossKind::kSquare)
    scale->fail("without a loss there is nothing to scale", "type: huber or soft_l1");
  return options;
}

IntervalOptions read_intervals(const YamlValue& intervals) {
  IntervalOptions options;
  read_options(intervals, &options);
  if (const auto lag = intervals.find("lag"); lag && options.noise == NoiseModel::kWhite)
    lag->fail("white noise has no lag", "noise: correlated or bootstrap");
  return options;
}

/// `prior: {payload: 0.3, mass: 0.5}`: relative deviations of tuned parameters, and of what a free
/// inertia is made of.
std::vector<PriorDescription> read_priors(const YamlValue& prior, const Study& study) {
  std::vector<std::string> known(kFreeInertiaParts.begin(), kFreeInertiaParts.end());
  for (const int index : study.tuned) known.push_back(study.parameters[to_index(index)].name);
  std::vector<PriorDescription> priors;
  for (const auto& [name, value] : prior.entries()) {
    const auto place = std::find(known.begin(), known.end(), name) - known.begin();
    if (place == to_signed(known.size()))
      throw unknown_name(value.where(), value.path(), "tuned parameter", name, known);
    const double deviation = read_above_zero(value, ", relative to the start of the fit");
    const std::size_t tuned = to_index(place) - std::min(to_index(place), kFreeInertiaParts.size());
    const bool is_named = place >= to_signed(kFreeInertiaParts.size());
    if (is_named && study.parameters[to_index(study.tuned[tuned])].value == 0.0)
      value.fail("a deviation relative to a start of zero is zero",
                 "a parameter whose start is not 0, or bounds instead");
    priors.push_back({name, deviation, value.where()});
  }
  return priors;
}

}  // namespace

double segment_of(const YamlValue& identify) {
  const auto segment = identify.find("segment");
  return segment ? read_above_zero(*segment, " s") : IdentificationDescription().segment;
}

std::vector<EntryForm> forms_of_calibrations() {
  return {{"identify.joints.JOINT", calibration_keys()}};
}

IdentificationDescription read_identification(const YamlValue& identify,
                                              const RobotDescription& robot, const Study& study) {
  identify.require_keys({}, {"data", "holdout", "residual", "segment", "filter", "joints", "loss",
                             "intervals", "prior"});
  IdentificationDescription description;
  description.where = identify.where();
  if (const auto data = identify.find("data"))
    description.data = read_recording_list(*data, robot, study);
  if (const auto holdout = identify.find("holdout")) {
    description.holdout = read_recording_list(*holdout, robot, study);
    refuse_fitted_starts(description.holdout);
  }
  OptionReader{identify}("residual", kResidualNames, description.residual);
  for (const auto* list : {&description.data, &description.holdout})
    for (const RecordingDescription& recording : *list)
      refuse_masks_in_motion(recording, description.residual);
  description.segment = segment_of(identify);
  if (const auto filter = identify.find("filter")) description.filter = read_filter(*filter);
  if (const auto joints = identify.find("joints"))
    for (const auto& [name, value] : joints->entries())
      description.joints.push_back(read_calibration(name, value, robot));
  if (const auto loss = identify.find("loss")) description.loss = read_loss(*loss);
  if (const auto intervals = identify.find("intervals"))
    description.intervals = read_intervals(*intervals);
  if (const auto prior = identify.find("prior")) description.priors = read_priors(*prior, study);
  return description;
}

}  // namespace codesign
