// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "reading/study/entry_keys.h"
#include "reading/study/study_options.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

constexpr const char* kColumnForms = "a name, a number from 1, or {column, scale, offset}";
constexpr const char* kTime = "time";

void read_column_place(const YamlValue& value, ColumnDescription* column) {
  const std::string text = value.text();
  const std::optional<double> number = number_in(text);
  if (!number) {
    column->name = text;
    return;
  }
  column->number = value.integer();
  if (column->number < 1) value.fail("columns are numbered from 1", kColumnForms);
}

ColumnDescription read_column(const YamlValue& value) {
  ColumnDescription column;
  column.where = value.where();
  column.element = value.path();
  if (value.is_list()) value.fail("not a column", kColumnForms);
  if (!value.is_map()) {
    read_column_place(value, &column);
    return column;
  }
  value.require_keys({"column"}, {"scale", "offset"});
  read_column_place(value.at("column"), &column);
  if (const auto scale = value.find("scale")) {
    column.scale = scale->number();
    if (column.scale == 0.0)
      scale->fail("a scale of zero leaves nothing of the measurement", "any other number");
  }
  if (const auto offset = value.find("offset")) column.offset = offset->number();
  return column;
}

/// `JOINT/position`, as signals are spelled. The name of a joint may contain slashes.
MeasuredColumn read_measured(const std::string& key, const YamlValue& value,
                             const RobotDescription& robot) {
  constexpr const char* kAllowed = "time, JOINT/position, JOINT/velocity or JOINT/effort";
  const std::size_t slash = key.rfind('/');
  const std::vector<std::string> names(kMeasuredQuantityNames.begin(),
                                       kMeasuredQuantityNames.end());
  if (slash == std::string::npos)
    value.fail("not a measured quantity" + did_you_mean(nearest_name(key, {kTime})), kAllowed);
  MeasuredColumn measured;
  const std::string quantity = key.substr(slash + 1);
  const auto found = std::find(names.begin(), names.end(), quantity);
  if (found == names.end())
    value.fail("not a measured quantity" + did_you_mean(nearest_name(quantity, names)), kAllowed);
  measured.quantity = static_cast<MeasuredQuantity>(found - names.begin());
  measured.joint = scalar_joint(key.substr(0, slash), robot, value).name;
  measured.column = read_column(value);
  return measured;
}

void read_columns(const YamlValue& columns, const RobotDescription& robot,
                  RecordingDescription* recording) {
  for (const auto& [key, value] : columns.entries()) {
    if (key == kTime)
      recording->time = read_column(value);
    else
      recording->columns.push_back(read_measured(key, value, robot));
  }
  if (!recording->time)
    columns.fail("the column of the time is missing", "time: COLUMN beside the quantities");
  if (recording->columns.empty())
    columns.fail("no column of a joint", "JOINT/position: COLUMN, JOINT/velocity or JOINT/effort");
}

/// What recordings are read with.
struct RecordingContext {
  const RobotDescription& robot;
  const Study& study;
};
using RecordingKeys = EntryKeys<RecordingDescription, RecordingContext>;
using RecordingKey = EntryKey<RecordingDescription, RecordingContext>;

RecordingKey text_key(const char* name, bool is_required,
                      std::string RecordingDescription::*member) {
  return {name, is_required,
          [member](const YamlValue& value, const RecordingContext&,
                   RecordingDescription* recording) { recording->*member = value.text(); }};
}
RecordingKey number_key(const char* name, double RecordingDescription::*member) {
  return {name, false,
          [member](const YamlValue& value, const RecordingContext&,
                   RecordingDescription* recording) { recording->*member = value.number(); }};
}
template <class Option, std::size_t N>
RecordingKey choice_key(const char* name, const std::array<const char*, N>& names,
                        Option RecordingDescription::*member) {
  return {name, false,
          [name, &names, member](const YamlValue& value, const RecordingContext&,
                                 RecordingDescription* recording) {
            recording->*member = read_choice(value, name, names, recording->*member);
          }};
}

void read_start_positions(const YamlValue& starts, const RecordingContext& in,
                          RecordingDescription* recording) {
  for (const auto& [name, value] : starts.entries()) {
    StartPosition start;
    start.joint = scalar_joint(name, in.robot, value).name;
    read_fitted(value, -std::numeric_limits<double>::infinity(), &start.position);
    recording->starts.push_back(start);
  }
}

/// Values of parameters in this recording, which the study does not tune.
void read_settings(const YamlValue& set, const RecordingContext& in,
                   RecordingDescription* recording) {
  for (const auto& [name, value] : set.entries()) {
    const int index = untuned_parameter(name, in.study, value);
    recording->settings.push_back(
        {index, read_within_bounds(value, in.study.parameters[to_index(index)])});
  }
}

/// `mask: {speed: 0.01, rest: bounds}`, or `mask: {speed: {JOINT: 0.01}}`.
void read_mask(const YamlValue& mask, const RecordingContext& in, RecordingDescription* recording) {
  mask.require_keys({"speed"}, {"rest"});
  if (const auto rest = mask.find("rest"))
    recording->rest = read_choice(*rest, "rest", kRestRuleNames, recording->rest);
  const YamlValue speed = mask.at("speed");
  const auto add = [recording](const std::string& joint, const YamlValue& value) {
    recording->masks.push_back({joint, read_above_zero(value, " rad/s or m/s"), value.where()});
  };
  if (!speed.is_map()) return add("", speed);
  for (const auto& [name, value] : speed.entries())
    add(scalar_joint(name, in.robot, value).name, value);
}

/// Signals of the model with their columns.
void read_signals(const YamlValue& signals, const RecordingContext& in,
                  RecordingDescription* recording) {
  for (const auto& [name, value] : signals.entries()) {
    SignalDescription signal = parse_signal(name, value.where(), value.path());
    check_signal(signal, in.robot, in.study.controllers, value.path());
    require_known(signal, names_of(in.study.parameters), value.where(), value.path());
    recording->signals.push_back({std::move(signal), read_column(value)});
  }
}

/// The keys of both kinds of files after those of one kind.
RecordingKeys with_common_keys(RecordingKeys keys) {
  return with(std::move(keys),
              RecordingKeys{number_key("from", &RecordingDescription::from),
                            number_key("to", &RecordingDescription::to),
                            choice_key("gaps", kGapRuleNames, &RecordingDescription::gaps),
                            {"mask", false, read_mask},
                            {"start", false, read_start_positions},
                            {"set", false, read_settings}});
}

const RecordingKeys& bag_keys() {
  static const RecordingKeys kKeys =
      with_common_keys({text_key("bag", true, &RecordingDescription::file),
                        text_key("topic", true, &RecordingDescription::topic),
                        choice_key("stamp", kStampNames, &RecordingDescription::stamp)});
  return kKeys;
}

const RecordingKeys& table_keys() {
  static const RecordingKeys kKeys = with_common_keys(
      {text_key("csv", true, &RecordingDescription::file),
       choice_key("delimiter", kCellDelimiterNames, &RecordingDescription::delimiter),
       {"columns", false,
        [](const YamlValue& value, const RecordingContext& in, RecordingDescription* of) {
          read_columns(value, in.robot, of);
        }},
       {"signals", false, read_signals}});
  return kKeys;
}

RecordingDescription read_recording(const YamlValue& value, const RecordingContext& in) {
  if (!value.is_map())
    value.fail("not a recording",
               "{bag: FILE, topic: NAME} or {csv: FILE, columns: {time: COLUMN, ...}}");
  RecordingDescription recording;
  recording.element = value.path();
  recording.where = value.where();
  recording.is_bag = value.find("bag").has_value();
  if (recording.is_bag == value.find("csv").has_value())
    value.fail("a recording is one file", "either bag: FILE with topic: NAME, or csv: FILE");
  read_entry(value, recording.is_bag ? bag_keys() : table_keys(), in, &recording);
  if (!(recording.from < recording.to))
    value.find("to")
        .value_or(value.find("from").value_or(value))
        .fail("the part to use ends before it begins", "from < to");
  return recording;
}

}  // namespace

std::vector<EntryForm> forms_of_recordings() {
  return {{"identify.data[]", bag_keys()}, {"identify.data[]", table_keys()}};
}

std::vector<RecordingDescription> read_recording_list(const YamlValue& list,
                                                      const RobotDescription& robot,
                                                      const Study& study) {
  std::vector<RecordingDescription> recordings;
  for (const YamlValue& item : list.items())
    recordings.push_back(read_recording(item, RecordingContext{robot, study}));
  if (recordings.empty())
    list.fail("no recording", "at least one {bag: FILE, topic: NAME} or {csv: FILE}");
  return recordings;
}

}  // namespace codesign
