// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/linear_tables.h"
#include "cli/report.h"
#include "description/study.h"
#include "jobs/csv_writer.h"
#include "jobs/json.h"
#include "jobs/linear_records.h"
#include "problem/load_problem.h"
#include "statics/linearize.h"

namespace codesign::cli {
namespace {

/// One table of all loops: `loop` is the number of the controller's loop, from 0.
void write_response(const LinearModel& model, std::ofstream* file) {
  CsvWriter csv(*file, {"loop", "frequency", "real", "imaginary"});
  for (std::size_t k = 0; k < model.loops.size(); ++k)
    for (std::size_t at = 0; at < model.loops[k].frequencies.size(); ++at)
      csv.write({static_cast<double>(k), model.loops[k].frequencies[at],
                 model.loops[k].response[at].real(), model.loops[k].response[at].imag()});
}

}  // namespace

int linearize(const Arguments& arguments, const Console& console) {
  const Problem problem = load(arguments, &console);
  const std::vector<SignalDescription> signals =
      select_signals(arguments, problem, study_of(problem).controllers, {});
  std::ofstream file;
  if (!arguments.csv.empty()) open_output(arguments.csv, "--csv", &file);
  const LinearQuestion question{signals, arguments.friction, true};
  const LinearModel model =
      arguments.time < 0.0
          ? linearize_at_rest(*system_of(problem), problem.parameters(), question, &console.cancel)
          : linearize_in_motion(*system_of(problem), problem.parameters(), question, arguments.time,
                                &console.cancel);
  if (model.status.ok() && !arguments.json) {
    print_stability(model, console.out);
    print_margins(model, console.out);
  }
  if (model.status.ok() && !arguments.csv.empty()) write_response(model, &file);
  Json object;
  if (arguments.json) {
    object["parameters"] = parameters_json(problem, problem.parameters());
    if (model.status.ok()) {
      add_stability(model, &object);
      add_matrices(model.system, &object);
      object["measured"] = measured_json(study_of(problem).controllers);
      object["loops"] = loops_json(model);
    }
  }
  add_warnings(arguments, problem, {}, &object, console);
  return finish(arguments, model.status, std::move(object), console);
}

}  // namespace codesign::cli
