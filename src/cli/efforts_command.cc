// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "assembly/reaction_advice.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/report.h"
#include "cli/series.h"
#include "description/study.h"
#include "jobs/effort_recorder.h"
#include "mechanism/signal_catalog.h"
#include "problem/load_problem.h"
#include "text/number_text.h"
#include "text/table.h"

namespace codesign::cli {
namespace {

constexpr int kNeedDigits = 6;

std::string place_text(const std::vector<double>& at) {
  std::string text;
  for (const double value : at) text += (text.empty() ? "" : ", ") + readable(value, kNeedDigits);
  return text;
}

void print_needs(const EffortSummary& summary, bool is_motion, std::ostream& out) {
  if (summary.drives.empty()) return;
  Table table;
  std::vector<std::string> head{"largest, of joint"};
  for (const auto& [name, extreme] : summary.drives.front().extremes)
    head.insert(head.end(), {name, is_motion ? "at [s]" : "in posture"});
  for (const auto& [name, total] : summary.drives.front().totals) head.push_back(name);
  table.add(head);
  for (const DriveNeeds& drive : summary.drives) {
    std::vector<std::string> row{drive.joint};
    for (const auto& [name, extreme] : drive.extremes)
      row.insert(row.end(), {readable(extreme.value, kNeedDigits), place_text(extreme.at)});
    for (const auto& [name, total] : drive.totals) row.push_back(readable(total, kNeedDigits));
    table.add(row);
  }
  table.print(out);
  for (const LimitCrossing& crossing : summary.crossings) out << describe(crossing) << '\n';
  if (summary.unreachable > 0)
    out << summary.unreachable << " of " << summary.rows
        << " postures cannot be reached: the loops do not close there\n";
  out.flush();
}

/// Along a motion default_signals() that are not among the columns; in postures nothing slides.
std::vector<std::string> standard_signals(const Problem& problem) {
  std::vector<std::string> signals;
  if (!study_of(problem).grid.empty()) return signals;
  const std::vector<std::string> columns = effort_columns(problem, {});
  for (const std::string& signal : default_signals(robot_of(problem), {}))
    if (std::find(columns.begin(), columns.end(), signal) == columns.end())
      signals.push_back(signal);
  return signals;
}

}  // namespace

int efforts(const Arguments& arguments, const Console& console) {
  const Problem problem = load(arguments, &console);
  const std::vector<SignalDescription> signals =
      select_signals(arguments, problem, {}, standard_signals(problem));
  SeriesOutput output(arguments, problem, effort_columns(problem, signals), "the table of efforts",
                      console);
  const EffortSummary summary = record_efforts(
      problem, problem.parameters(), signals, arguments.samples,
      [&](const std::vector<double>& row) { output.add(row); }, &console.cancel);
  if (summary.status.ok())
    print_needs(summary, study_of(problem).grid.empty(), progress_of(arguments, console));
  Json object;
  if (arguments.json) {
    object["parameters"] = parameters_json(problem, problem.parameters());
    object["joints"] = to_json(summary.drives);
    object["limits_exceeded"] = to_json(summary.crossings);
    object["unreachable"] = summary.unreachable;
    object["series"] = output.json();
  }
  Warnings warnings = summary.warnings;
  append(warn_of_open_reactions(*system_of(problem), signals), &warnings);
  add_warnings(arguments, problem, warnings, &object, console);
  return finish(arguments, summary.status, std::move(object), console);
}

}  // namespace codesign::cli
