// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/tradeoff_records.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "jobs/json_records.h"
#include "jobs/record_json.h"
#include "jobs/result_fields.h"
#include "math/arrays.h"
#include "text/number_text.h"
#include "text/table.h"

namespace codesign {
namespace {

constexpr int kShownDigits = 6;

const char* kind_of(const TradeoffPoint& point) {
  return kTradeoffKindNames[to_index(static_cast<int>(point.kind))];
}

bool is_found(const TradeoffPoint& point) { return point.kind != TradeoffKind::kFailed; }

std::string evaluations_of(int evaluations) {
  return std::to_string(evaluations) + (evaluations == 1 ? " evaluation" : " evaluations");
}

}  // namespace

Json point_json(const Problem& problem, const std::vector<std::string>& names,
                const TradeoffPoint& point) {
  Json object = record_json(point);
  if (is_found(point)) {
    object["objectives"] = by_name(names, point.objectives);
    object["parameters"] = parameters_json(problem, problem.parameters(point.rho));
  }
  add_fields(point.cost, &object);
  return object;
}

Json tradeoff_json(const Problem& problem, const TradeoffResult& result) {
  Json object;
  object["objectives"] = result.names;
  object["tuned"] = problem.tuned_names();
  Json points = Json::array();
  for (const TradeoffPoint& point : result.points)
    points.push_back(point_json(problem, result.names, point));
  object["points"] = std::move(points);
  if (result.ideal.size() > 0) {
    object["ideal"] = by_name(result.names, result.ideal);
    object["nadir"] = by_name(result.names, result.nadir);
  }
  add_fields(result, &object);
  add_fields(result.cost, &object);
  add_statistics(result.cost.statistics, &object);
  return object;
}

std::string tradeoff_report(const Problem& problem, const TradeoffResult& result) {
  Json object = tradeoff_json(problem, result);
  add_outcome(problem, result.warnings, result.status, &object);
  return to_text(object);
}

std::vector<std::string> tradeoff_columns(const Problem& problem, const TradeoffResult& result) {
  std::vector<std::string> columns{"kind"};
  for (const std::string& name : result.names) columns.push_back("objective_" + name);
  for (const std::string& name : problem.tuned_names()) columns.push_back(name);
  for (const char* name : {"status", "termination", "stationarity", "evaluations"})
    columns.emplace_back(name);
  return columns;
}

std::vector<std::vector<std::string>> tradeoff_rows(const TradeoffResult& result) {
  std::vector<std::vector<std::string>> rows;
  for (const TradeoffPoint& point : result.points) {
    std::vector<std::string>& row = rows.emplace_back();
    row.emplace_back(kind_of(point));
    const auto cell = [&](double value) { return is_found(point) ? to_decimal(value) : ""; };
    for (const double value : point.objectives) row.push_back(cell(value));
    for (const double value : point.rho) row.push_back(cell(value));
    row.emplace_back(name_of(point.status.code));
    row.push_back(point.termination);
    row.push_back(std::isfinite(point.stationarity) ? to_decimal(point.stationarity) : "");
    row.push_back(std::to_string(point.cost.evaluations));
  }
  return rows;
}

std::string tradeoff_line(const std::vector<std::string>& names, const TradeoffPoint& point,
                          int done, int of) {
  std::string line = "point " + std::to_string(done) + " of " + std::to_string(of) + ": ";
  for (std::size_t k = 0; is_found(point) && k < names.size(); ++k)
    line += names[k] + " " + readable(point.objectives[to_signed(k)], kShownDigits) + ", ";
  line += is_found(point) ? std::string(point.is_anchor ? "an end of the curve" : kind_of(point))
                          : "failed: " + point.status.cause;
  return line + " (" + evaluations_of(point.cost.evaluations) + ")";
}

std::string tradeoff_text(const Problem& problem, const TradeoffResult& result) {
  std::ostringstream out;
  Table table;
  std::vector<std::string> head{"point"};
  head.insert(head.end(), result.names.begin(), result.names.end());
  const std::vector<std::string> tuned = problem.tuned_names();
  head.insert(head.end(), tuned.begin(), tuned.end());
  table.add(head);
  for (const TradeoffPoint& point : result.points) {
    std::vector<std::string> row{kind_of(point)};
    const auto cell = [&](double value) {
      return is_found(point) ? readable(value, kShownDigits) : std::string("-");
    };
    for (const double value : point.objectives) row.push_back(cell(value));
    for (const double value : point.rho) row.push_back(cell(value));
    table.add(row);
  }
  table.print(out);
  for (const TradeoffPoint& point : result.points)
    if (!point.status.ok()) out << "a search ended with " << describe(point.status) << '\n';
  if (std::isfinite(result.largest_gap))
    out << "neighbours on the curve are " << readable(result.smallest_gap, 3) << " to "
        << readable(result.largest_gap, 3) << " apart, of the distance between the best and the "
        << "worst values\n";
  out << result.points.size() << " points, " << evaluations_of(result.cost.evaluations) << " ("
      << result.cost.failed_evaluations << " failed), "
      << readable(result.cost.statistics.cpu_seconds, 3) << " s of processor time\n";
  return out.str();
}

}  // namespace codesign
