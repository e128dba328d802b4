// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <sstream>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output_file.h"
#include "cli/recordings_table.h"
#include "cli/report.h"
#include "cli/table.h"
#include "identification/identify.h"
#include "jobs/csv_writer.h"
#include "jobs/identification_records.h"
#include "jobs/whole_file.h"
#include "reading/urdf/urdf_reader.h"
#include "text/number_text.h"

namespace codesign::cli {
namespace {

void print_trial(const FitTrial& trial, std::ostream& err) {
  err << "evaluation " << trial.evaluation << ": ";
  if (!trial.status.ok()) {
    err << "failed, " << describe(trial.status) << std::endl;
    return;
  }
  err << "cost " << readable(trial.cost) << ", root mean squares";
  for (const double rms : trial.rms) err << ' ' << readable(rms);
  err << std::endl;
}

void print_numbers(const IdentificationResult& result, double level, std::ostream& out) {
  Table table;
  table.add({"number", "start", "identified", "deviation", readable(100.0 * level) + " % from", "to", "note"});
  for (const IdentifiedNumber& number : result.numbers) {
    const bool known = number.is_determined && !number.is_on_bound;
    table.add({number.name, readable(number.start), readable(number.value), known ? readable(number.deviation) : "",
               known ? readable(number.low) : "", known ? readable(number.high) : "",
               number.is_on_bound     ? "on its bound"
               : number.is_determined ? ""
                                      : "not identifiable"});
  }
  table.print(out);
}

void print_result(const Problem& problem, const IdentificationResult& result, std::ostream& out) {
  for (const std::string& sentence : identification_sentences(result)) out << sentence << '\n';
  print_numbers(result, problem.study().identification->intervals.level, out);
  out << result.termination << " after " << result.iterations << " iterations, " << result.evaluations << " evaluations ("
      << result.failed_evaluations << " failed), " << readable(result.cpu_seconds) << " s of processor time\n";
}

Problem load_identifiable(const Arguments& arguments, const Console& console) {
  Problem problem = load(arguments, &console);
  if (!problem.study().identification)
    throw InputError({{arguments.study, 1}, "identify", "the study has no recordings to identify from", "", "a block identify"});
  return problem;
}

std::string residuals_text(const IdentificationResult& result) {
  std::ostringstream text;
  CsvWriter csv(text, residual_columns(result), "residuals.csv");
  for (const std::vector<std::string>& row : residual_rows(result)) csv.write(row);
  return text.str();
}

/// Writes one file of the folder; a failure is reported and does not affect the others.
template <class Text>
void write_in(const std::string& folder, const std::string& name, Text text, std::vector<Failure>* failures) {
  try {
    write_whole_file((std::filesystem::path(folder) / name).string(), text());
  } catch (const std::exception& error) {
    failures->push_back({"output_failed", error.what()});
  }
}

}  // namespace

int identify(const Arguments& arguments, const Console& console) {
  const Problem problem = load_identifiable(arguments, console);
  if (!arguments.output.empty()) make_folder(arguments.output, "--output");
  Warnings warnings;
  const StudyRecordings recordings = read_recordings(problem, console, &warnings);
  const auto observer = [&console](const FitTrial& trial) {
    print_trial(trial, console.err);
    return !console.cancel;
  };
  IdentificationResult result = codesign::identify(problem, recordings, observer, &console.cancel);
  append(warnings, &result.warnings);
  const bool known = !result.numbers.empty();
  if (!arguments.json && known) print_result(problem, result, console.out);
  Json object = identification_json(problem, result);
  add_warnings(arguments, problem, result.warnings, &object, console);
  if (!result.status.ok()) object["error"] = to_json(result.status);
  std::vector<Failure> failures;
  if (!arguments.output.empty() && known) {
    write_in(
        arguments.output, "identification.json", [&] { return to_text(object); }, &failures);
    write_in(
        arguments.output, "identified.urdf", [&] { return write_tuned_urdf(problem.urdf(), problem.overlays(), result.parameters); },
        &failures);
    write_in(
        arguments.output, "residuals.csv", [&] { return residuals_text(result); }, &failures);
  }
  return finish(arguments, result.status, std::move(object), console, failures);
}

}  // namespace codesign::cli
