// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <memory>

#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "reading/study/study_blocks.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// The durations that the bounds of the parameters allow.
ValueRange durations_of(const Expression& duration, const Study& study) {
  std::vector<ValueRange> ranges;
  ranges.reserve(study.parameters.size());
  for (const Parameter& parameter : study.parameters)
    ranges.push_back({parameter.lower, parameter.upper});
  return duration.range(ranges);
}

void read_duration_of_design(const YamlValue& value, const ParameterTable& table, Study* study) {
  const Quantity duration = read_quantity(value, table);
  study->duration_of_design =
      std::make_shared<const Expression>(duration.expression()->text(), table.names);
  const ValueRange range = durations_of(*study->duration_of_design, *study);
  study->duration = range.upper;
  if (range.lower > 0.0 && std::isfinite(range.upper)) return;
  const auto in_words = [](double x) {
    return std::isfinite(x) ? to_decimal(x) + " s" : std::string(x < 0.0 ? "-" : "") + "infinity";
  };
  value.fail("the bounds of its parameters allow a duration from " + in_words(range.lower) +
                 " to " + in_words(range.upper),
             "parameters with bounds that keep the duration above 0 s and finite, such as T: "
             "{initial: 2.0, lower: 0.5, upper: 5.0}");
}

/// What has no use for runs whose end depends on the design.
void refuse_moving_end(const YamlValue& root, const std::string& key) {
  const YamlValue value = root.at(key);
  const std::string allowed = key == "until" ? "no until" : "a number [s]";
  if (root.find("identify"))
    value.fail("a fit compares segments of recordings, whose ends the recordings determine",
               allowed + " beside identify");
  if (root.find("excite"))
    value.fail("the trajectory that `excite` seeks lasts as long as the study says",
               allowed + " beside excite");
}

}  // namespace

// A study that only identifies has no run of its own that could have a duration.
void read_duration(const YamlValue& root, const ParameterTable& table, Study* study) {
  const auto identify = root.find("identify");
  if (identify && !root.find("duration")) {
    study->duration = segment_of(*identify);
    return;
  }
  const YamlValue value = root.at("duration");
  if (value.is_scalar() && is_expression(value.text())) {
    refuse_moving_end(root, "duration");
    return read_duration_of_design(value, table, study);
  }
  study->duration = value.number();
  if (study->duration <= 0.0) value.fail("the duration must be positive", "more than 0 s");
}

void read_until(const YamlValue& root, const RobotDescription& robot, const ParameterTable& table,
                Study* study) {
  const auto value = root.find("until");
  if (!value) return;
  refuse_moving_end(root, "until");
  SignalDescription until = parse_condition(value->text(), value->where(), value->path());
  require_known(until, table.names, value->where(), value->path());
  check_signal(until, robot, study->controllers, value->path());
  use_parameters(until, table);
  study->until = std::make_shared<const SignalDescription>(std::move(until));
}

void check_moving_end(const Study& study) {
  if (!has_moving_end(study)) return;
  for (const WatchedSignal& watched : study.watched)
    if (has_band(watched))
      throw InputError({watched.where, watched.element,
                        "arrival and dwell have no derivative by an end that depends on the design",
                        watched.signal.text,
                        "stroke, maximum, minimum, peak, of the end of a run end_time; or "
                        "a duration that is a number, without until"});
}

}  // namespace codesign
