// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "description/formula.h"
#include "reading/study/entry_keys.h"
#include "reading/study/study_options.h"
#include "reading/study/study_values.h"
#include "recordings/number_table.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// What functions of time are read with.
struct ReferenceContext {
  const ParameterTable& table;
};
using FunctionKeys = EntryKeys<ReferenceDescription, ReferenceContext>;

EntryKey<ReferenceDescription, ReferenceContext> sine_key(const char* name, bool is_required,
                                                          Quantity SineDescription::*member) {
  return {name, is_required,
          [member](const YamlValue& value, const ReferenceContext& in, ReferenceDescription* of) {
            of->sine.*member = read_quantity(value, in.table);
          }};
}

const FunctionKeys& sine_keys() {
  static const FunctionKeys kKeys{required_key<ReferenceDescription, ReferenceContext>("type"),
                                  sine_key("amplitude", true, &SineDescription::amplitude),
                                  sine_key("frequency", false, &SineDescription::frequency),
                                  sine_key("period", false, &SineDescription::frequency),
                                  sine_key("phase", false, &SineDescription::phase),
                                  sine_key("offset", false, &SineDescription::offset)};
  return kKeys;
}

ReferenceDescription read_sine(const YamlValue& value, const ParameterTable& table) {
  ReferenceDescription reference;
  reference.kind = ReferenceDescription::Kind::kSine;
  read_entry(value, sine_keys(), ReferenceContext{table}, &reference);
  SineDescription& sine = reference.sine;
  const auto frequency = value.find("frequency"), period = value.find("period");
  if (frequency.has_value() == period.has_value())
    value.fail("a sine has either a frequency or a period", "frequency [Hz] or period [s]");
  sine.is_period = period.has_value();
  const YamlValue& pace = frequency ? *frequency : *period;
  if (!(sine.frequency.nominal() > 0.0))
    pace.fail("not above zero", frequency ? "more than 0 Hz" : "more than 0 s");
  return reference;
}

Interpolation read_interpolation(const YamlValue& value) {
  const auto interpolation = value.find("interpolation");
  if (!interpolation) return Interpolation::kMonotone;
  const std::string name =
      interpolation->choice("interpolation", {"monotone", "quintic", "cubic", "linear"});
  return name == "linear"    ? Interpolation::kLinear
         : name == "cubic"   ? Interpolation::kCubic
         : name == "quintic" ? Interpolation::kQuintic
                             : Interpolation::kMonotone;
}

void check_times(const std::vector<double>& times, const YamlValue& value) {
  if (times.size() < 2)
    value.fail("a trajectory needs at least two way-points, found " + std::to_string(times.size()),
               "times: [0, ...] with as many positions");
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k - 1] < times[k]))
      value.fail(
          "the times must ascend, and way-point " + std::to_string(k) + " does not come later",
          "each time above the one before it");
}

/// A list with one value for each time.
EntryKey<ReferenceDescription, ReferenceContext> list_key(
    const char* name, bool is_required, std::vector<Quantity> WaypointsDescription::*member) {
  return {name, is_required,
          [member](const YamlValue& value, const ReferenceContext& in, ReferenceDescription* of) {
            std::vector<Quantity>& list = of->waypoints.*member;
            for (const YamlValue& item : value.items())
              list.push_back(read_quantity(item, in.table));
            if (list.size() != of->waypoints.times.size())
              value.fail("found " + std::to_string(list.size()) + " values for " +
                             std::to_string(of->waypoints.times.size()) + " times",
                         "one per time");
          }};
}

bool is_of_fifth_degree(Interpolation interpolation) {
  return interpolation == Interpolation::kQuintic || interpolation == Interpolation::kMonotone;
}

/// Velocities or accelerations that the interpolation does not use are an error.
void refuse_unused(const YamlValue& value, Interpolation interpolation) {
  const auto velocities = value.find("velocities"), accelerations = value.find("accelerations");
  if (velocities && interpolation == Interpolation::kLinear)
    velocities->fail("linear interpolation does not use velocities", "monotone, quintic, cubic");
  if (accelerations && !is_of_fifth_degree(interpolation))
    accelerations->fail("only monotone and quintic interpolation use accelerations",
                        "monotone, quintic");
}

const FunctionKeys& waypoint_keys() {
  using Of = WaypointsDescription;
  static const FunctionKeys kKeys{
      required_key<ReferenceDescription, ReferenceContext>("type"),
      optional_key<ReferenceDescription, ReferenceContext>("interpolation"),
      required_key<ReferenceDescription, ReferenceContext>(
          "times",
          [](const YamlValue& value, const ReferenceContext&, ReferenceDescription* of) {
            for (const YamlValue& item : value.items())
              of->waypoints.times.push_back(item.number());
            check_times(of->waypoints.times, value);
          }),
      list_key("positions", true, &Of::positions),
      list_key("velocities", false, &Of::velocities),
      list_key("accelerations", false, &Of::accelerations)};
  return kKeys;
}

ReferenceDescription read_waypoints(const YamlValue& value, const ParameterTable& table) {
  ReferenceDescription reference;
  reference.kind = ReferenceDescription::Kind::kWaypoints;
  read_entry(value, waypoint_keys(), ReferenceContext{table}, &reference);
  reference.waypoints.interpolation = read_interpolation(value);
  refuse_unused(value, reference.waypoints.interpolation);
  return reference;
}

TrajectoryAddress read_address(const YamlValue& value) {
  TrajectoryAddress address{"", "", "", value.where(), value.path()};
  if (!value.find("csv")) {
    value.require_keys({"type", "bag", "topic", "joint"}, {"interpolation"});
    address.bag = value.at("bag").text();
    address.topic = value.at("topic").text();
    address.joint = value.at("joint").text();
    return address;
  }
  value.require_keys({"type", "csv", "column"}, {"time", "delimiter", "interpolation"});
  OptionReader{value}("delimiter", kCellDelimiterNames, address.delimiter);
  address.csv = value.at("csv").text();
  address.column = value.at("column").text();
  const auto time = value.find("time");
  address.time = time ? time->text() : "time";
  return address;
}

/// Times that a trajectory can have, or the line of the table that has another one.
void check_times(const NumberTable::Columns& cells, const NumberTable& table,
                 const std::string& column) {
  const std::vector<double>& times = cells.values[0];
  if (times.size() < 2)
    throw InputError(
        {{table.file(), table.first_line()},
         "column \"" + column + "\"",
         "a trajectory needs at least two way-points, found " + std::to_string(times.size()),
         "",
         "a row per way-point"});
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k - 1] < times[k]))
      throw InputError({{table.file(), static_cast<int>(cells.lines[k])},
                        "column \"" + column + "\"",
                        "the times must ascend, and this one does not come later than that of the "
                        "row before",
                        to_decimal(times[k]),
                        "more than " + to_decimal(times[k - 1])});
}

/// A column of a table over its column of times.
RecordedTrajectory read_column(const TrajectoryAddress& address, const FileLoader& files) {
  if (!files)
    throw InputError({address.where, address.element, "no file can be read here", address.csv,
                      "{type: waypoints, ...}"});
  const SourceText source = files({address.csv, address.where, address.element});
  const NumberTable table(source.name, source.text, address.delimiter);
  std::vector<int> columns;
  for (const std::string& name : {address.time, address.column})
    columns.push_back(
        index_of({name, 0, 1.0, 0.0, {source.name, table.first_line()}, address.element}, table));
  NumberTable::Columns cells = table.read(columns);
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (std::size_t row = 0; row < cells.lines.size(); ++row)
      if (!std::isfinite(cells.values[k][row]))
        throw InputError({{source.name, static_cast<int>(cells.lines[row])},
                          "column \"" + (k == 0 ? address.time : address.column) + "\"",
                          "not finite",
                          to_decimal(cells.values[k][row]),
                          "finite numbers"});
  check_times(cells, table, address.time);
  return {std::move(cells.values[0]), std::move(cells.values[1]), {}, {}};
}

ReferenceDescription read_trajectory(const YamlValue& value, const TrajectoryLoader& loader) {
  const RecordedTrajectory recorded = loader(read_address(value));
  ReferenceDescription reference;
  reference.kind = ReferenceDescription::Kind::kWaypoints;
  WaypointsDescription& points = reference.waypoints;
  points.interpolation = read_interpolation(value);
  points.times = recorded.times;
  check_times(points.times, value);
  points.positions.assign(recorded.positions.begin(), recorded.positions.end());
  if (points.interpolation != Interpolation::kLinear)
    points.velocities.assign(recorded.velocities.begin(), recorded.velocities.end());
  if (is_of_fifth_degree(points.interpolation))
    points.accelerations.assign(recorded.accelerations.begin(), recorded.accelerations.end());
  return reference;
}

/// An expression of the time t; nothing if the text is no expression or does not contain t.
std::optional<ReferenceDescription> read_expression(const YamlValue& value,
                                                    const ParameterTable& table) {
  constexpr const char* kAllowed = "\"${expression}\" of the parameters and of the time t";
  const std::string text = value.text();
  if (!is_expression(text)) return std::nullopt;
  ReferenceDescription reference;
  reference.kind = ReferenceDescription::Kind::kExpression;
  TimeExpression& expression = reference.expression;
  expression.time = table.time_index();
  try {
    expression.formula = table.parse_with_time(expression_in(text));
  } catch (const std::invalid_argument& error) {
    value.fail(error.what(), kAllowed);
  }
  const std::vector<int>& used = expression.formula->dependencies();
  if (std::find(used.begin(), used.end(), expression.time) == used.end()) return std::nullopt;
  std::vector<double> at_start = table.values;
  at_start.push_back(0.0);
  if (!std::isfinite(expression.formula->value(at_start)))
    value.fail("not finite at t = 0 and the parameters' start", kAllowed);
  if (has_switches(expression.formula->steps()))
    for (const int k : used)
      expression.parameters.push_back(
          k == expression.time
              ? nullptr
              : std::make_shared<const Expression>(table.names[to_index(k)], table.names));
  return reference;
}

}  // namespace

TrajectoryLoader trajectories_of(const TrajectoryLoader& bags, const FileLoader& files) {
  return [&bags, &files](const TrajectoryAddress& address) {
    if (!address.csv.empty()) return read_column(address, files);
    if (!bags)
      throw InputError(
          {address.where, address.element,
           "a bag is read by the ROS nodes only; `rosrun mechanism_codesign trajectory_from_bag " +
               address.bag + " " + address.topic + " " + address.joint +
               "` prints the same trajectory as way-points",
           "", "{type: waypoints, ...}"});
    return bags(address);
  };
}

ReferenceDescription read_reference(const YamlValue& value, const ParameterTable& table,
                                    const TrajectoryLoader& loader) {
  if (!value.is_map())
    if (auto expression = read_expression(value, table)) return *std::move(expression);
  if (!value.is_map()) return read_quantity(value, table);
  const std::string type =
      value.at("type").choice("type of reference", {"sine", "waypoints", "trajectory"});
  if (type == "sine") return read_sine(value, table);
  return type == "waypoints" ? read_waypoints(value, table) : read_trajectory(value, loader);
}

}  // namespace codesign
