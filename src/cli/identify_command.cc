// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/progress_line.h"
#include "cli/recordings.h"
#include "cli/report.h"
#include "description/study.h"
#include "identification/fit/fit_variables.h"
#include "identification/identify.h"
#include "jobs/files.h"
#include "jobs/identification_records.h"
#include "jobs/job_files.h"
#include "jobs/json.h"
#include "jobs/judged_fits.h"
#include "jobs/trial_lines.h"
#include "problem/load_problem.h"
#include "text/number_text.h"
#include "text/table.h"

namespace codesign::cli {
namespace {

/// Whether the base parameters tell of a number, and its own line would tell nothing: one of a free
/// inertia that the data do not determine.
std::vector<bool> told_by_combinations(const IdentificationResult& result) {
  std::vector<bool> told(result.numbers.size(), false);
  if (result.combinations.empty()) return told;
  std::vector<std::string> names;
  for (const IdentifiedNumber& number : result.numbers) names.push_back(number.name);
  for (const auto& [link, columns] : free_inertias(names))
    for (const int column : columns) {
      const auto k = static_cast<std::size_t>(column);
      told[k] = !result.numbers[k].is_determined;
    }
  return told;
}

void print_numbers(const IdentificationResult& result, double level, std::ostream& out) {
  const std::vector<bool> told = told_by_combinations(result);
  Table table;
  table.add({"number", "start", "identified", "deviation", readable(100.0 * level) + " % from",
             "to", "note"});
  for (std::size_t k = 0; k < result.numbers.size(); ++k) {
    if (told[k]) continue;
    const IdentifiedNumber& number = result.numbers[k];
    const bool known = number.is_determined && !number.is_on_bound;
    table.add({number.name, readable(number.start), readable(number.value),
               known ? readable(number.deviation) : "", known ? readable(number.low) : "",
               known ? readable(number.high) : "",
               number.is_on_bound     ? "on its bound"
               : number.is_determined ? ""
                                      : "not identifiable"});
  }
  table.print(out);
}

/// What is known of numbers that are not identifiable each, one line for each combination.
/// Expressions that are longer than a line stand in the JSON.
void print_combinations(const IdentificationResult& result, double level, std::ostream& out) {
  constexpr std::size_t kLongest = 80;
  if (result.combinations.empty()) return;
  Table table;
  table.add({"value", "deviation", readable(100.0 * level) + " % from", "to", "known combination"});
  for (const BaseParameter& known : result.combinations)
    table.add({readable(known.value), readable(known.deviation), readable(known.low),
               readable(known.high),
               known.expression.size() <= kLongest
                   ? known.expression
                   : known.expression.substr(0, kLongest - 4) + " ..."});
  table.print(out);
}

void print_result(const Problem& problem, const IdentificationResult& result, std::ostream& out) {
  for (const std::string& sentence : identification_sentences(result)) out << sentence << '\n';
  if (result.termination == kEvaluated) return;
  const double level = study_of(problem).identification->intervals.level;
  print_numbers(result, level, out);
  print_combinations(result, level, out);
  out << result.termination << " after " << result.iterations << " iterations, "
      << result.evaluations << " evaluations (" << result.failed_evaluations << " failed), "
      << readable(result.cpu_seconds) << " s of processor time\n";
}

Problem load_identifiable(const Arguments& arguments) {
  Problem problem = load(arguments);
  if (arguments.evaluate)
    require_recordings_named(problem);
  else
    require_identification(problem);
  return problem;
}

/// Creates the folder, and checks that no result replaces an input file. @throws InputError
void make_room(const std::string& folder, const Problem& problem) {
  make_folder(folder, "--output");
  std::vector<std::string> names;
  for (const IdentificationFile& file : identification_files(problem, {}, {}))
    names.push_back(file.name);
  require_other_files(folder, names, "--output", problem);
}

/// A failure to write one file is reported and does not affect the others.
template <class Write>
void try_to(Write write, std::vector<Failure>* failures) {
  try {
    write();
  } catch (const std::exception& error) {
    failures->push_back({"output_failed", error.what()});
  }
}

/// Replaces the bag of an earlier identification in this folder. An interrupt during this call ends
/// the bag early, which is a failure. After an earlier interrupt the bag is written in full, since
/// a second interrupt ends the program. If a motion cannot be shown, a warning says so; the
/// identification does not fail.
void write_show(const Arguments& arguments, const Problem& problem,
                const StudyRecordings& recordings, const IdentificationResult& result,
                const std::string& json, const std::string& path, const Console& console,
                std::vector<Failure>* failures) {
  const bool is_told_before = console.cancel;
  ComparedMotion motion = compare_motion(problem, recordings, result, kShownRate,
                                         [&] { return !is_told_before && console.cancel; });
  for (const ComparedRecording& recording : motion.recordings) {
    if (recording.status.ok()) continue;
    const std::string sentence =
        recording.element + " ends early in " + path + ": " + describe(recording.status);
    if (recording.status.is_interrupted())
      failures->push_back({name_of(recording.status.code), sentence});
    else
      console.err << "codesign " << arguments.command << ": warning: " << sentence << std::endl;
  }
  for (const std::string& earlier : {path, path + ".active"}) unlink(earlier.c_str());
  console.identification_bag(path, identification_show(problem, result, json, std::move(motion)));
}

std::vector<Failure> write_folder(const Arguments& arguments, const Problem& problem,
                                  const StudyRecordings& recordings,
                                  const IdentificationResult& result, const std::string& json,
                                  const Console& console) {
  std::vector<Failure> failures;
  const std::filesystem::path folder(arguments.output);
  for (const IdentificationFile& file : identification_files(problem, result, json))
    try_to([&] { write_whole_file((folder / file.name).string(), file.text()); }, &failures);
  const std::string bag = (folder / "identification.bag").string();
  if (console.identification_bag)
    try_to(
        [&] { write_show(arguments, problem, recordings, result, json, bag, console, &failures); },
        &failures);
  return failures;
}

/// The file of --against, read before the fit, so that a wrong one costs no time. @throws
/// InputError
std::optional<SourceText> read_other(const Arguments& arguments) {
  if (arguments.against.empty()) return std::nullopt;
  SourceText other = read_source(arguments.against);
  read_judged_model(other);
  return other;
}

void compare(const Arguments& arguments, const SourceText& other, Json* object, std::ostream& out) {
  Json comparison = comparison_json(other, {"this result", to_text(*object)});
  if (!arguments.json)
    for (const std::string& sentence : comparison_sentences(comparison))
      out << "against " << other.name << ": " << sentence << '\n';
  (*object)["against"] = std::move(comparison);
}

IdentificationResult judged_or_fitted(const Arguments& arguments, const Problem& problem,
                                      const StudyRecordings& recordings, const Console& console) {
  if (arguments.evaluate) return evaluate_model(problem, recordings, &console.cancel);
  LinePace pace;
  FitLines lines(problem.optimizer_options().max_evaluations);
  const auto observer = [&](const FitTrial& trial) {
    const std::string line = lines.line(trial);
    if (!line.empty() && pace.admits_now()) progress_of(arguments, console) << line << std::endl;
    return !console.cancel;
  };
  return codesign::identify(problem, recordings, observer, &console.cancel);
}

}  // namespace

int identify(const Arguments& arguments, const Console& console) {
  const Problem problem = load_identifiable(arguments);
  const std::optional<SourceText> other = read_other(arguments);
  if (!arguments.output.empty()) make_room(arguments.output, problem);
  Warnings warnings;
  const StudyRecordings recordings = read_recordings(problem, console, &warnings);
  // Until here there are no results to lose, and an interrupt ends the program at once.
  if (console.loaded) console.loaded();
  IdentificationResult result = judged_or_fitted(arguments, problem, recordings, console);
  append(warnings, &result.warnings);
  const bool known = !result.outputs().empty();
  if (!arguments.json && known) print_result(problem, result, console.out);
  Json object = identification_json(problem, result);
  if (other && known) compare(arguments, *other, &object, console.out);
  add_warnings(arguments, problem, result.warnings, &object, console);
  if (!result.status.ok()) object["error"] = to_json(result.status);
  std::vector<Failure> failures;
  if (!arguments.output.empty() && known)
    failures = write_folder(arguments, problem, recordings, result, to_text(object), console);
  return finish(arguments, result.status, std::move(object), console, failures);
}

}  // namespace codesign::cli
