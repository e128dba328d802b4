// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/report.h"
#include "description/study.h"
#include "engine/dispatcher.h"
#include "jobs/csv_writer.h"
#include "jobs/json.h"
#include "jobs/tradeoff_records.h"
#include "optimization/tradeoff.h"
#include "problem/load_problem.h"

namespace codesign::cli {

int tradeoff(const Arguments& arguments, const Console& console) {
  const Problem problem = load(arguments, &console);
  if (console.ranks != nullptr && console.ranks->ranks() > 1)
    throw UsageError("\"tradeoff\" runs in one process, with its threads, and not under mpirun");
  std::ofstream file;
  if (!arguments.csv.empty()) open_output(arguments.csv, "--csv", &file);
  std::vector<std::string> names;
  for (const TradeoffObjective& objective : study_of(problem).tradeoff)
    names.push_back(objective.name);
  const TradeoffResult result = find_tradeoff(
      problem, arguments.points,
      [&](const TradeoffPoint& point, int done, int of) {
        progress_of(arguments, console) << tradeoff_line(names, point, done, of) << std::endl;
        return !console.cancel;
      },
      &console.cancel);
  if (!arguments.json && !result.points.empty()) console.out << tradeoff_text(problem, result);
  if (!arguments.csv.empty()) {
    CsvWriter csv(file, tradeoff_columns(problem, result), arguments.csv);
    for (const std::vector<std::string>& row : tradeoff_rows(result)) csv.write(row);
  }
  Json object = tradeoff_json(problem, result);
  add_warnings(arguments, problem, result.warnings, &object, console);
  return finish(arguments, result.status, std::move(object), console);
}

}  // namespace codesign::cli
