// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/progress_line.h"
#include "cli/report.h"
#include "description/study.h"
#include "excitation/excite.h"
#include "jobs/csv_writer.h"
#include "jobs/files.h"
#include "jobs/job_files.h"
#include "jobs/json.h"
#include "jobs/recording_records.h"
#include "math/arrays.h"
#include "problem/load_problem.h"
#include "recordings/number_table.h"
#include "recordings/recording_check.h"
#include "text/number_text.h"
#include "text/table.h"

namespace codesign::cli {
namespace {

constexpr int kIntervalDigits = 4;  // digits of a predicted interval
constexpr const char* kResultFile = "excitation.json";
constexpr const char* kTrajectoryFile = "trajectory.csv";
constexpr const char* kPlainFile = "plain.csv";
constexpr const char* kBagFile = "trajectory.bag";

void print_excitation_trial(const ExcitationTrial& trial, std::ostream& err) {
  err << "start " << trial.start << ", evaluation " << trial.evaluation << ": ";
  if (trial.status.ok())
    err << "criterion " << readable(trial.criterion) << ", " << readable(100.0 * trial.worst)
        << " % of the limits" << std::endl;
  else
    err << "failed, " << describe(trial.status) << std::endl;
}

/// A line of a table of predictions: the values with the plain trajectory and with that found, and
/// with a given one if there is one.
std::vector<std::string> prediction_line(std::vector<std::string> cells, double before,
                                         double after, const ComparedTrajectory* compared,
                                         const Eigen::VectorXd ComparedTrajectory::*values,
                                         std::size_t k) {
  cells.push_back(readable(before, kIntervalDigits));
  if (compared) cells.push_back(readable((compared->*values)[to_signed(k)], kIntervalDigits));
  cells.push_back(readable(after, kIntervalDigits));
  return cells;
}

const ComparedTrajectory* judged(const ExcitationResult& result) {
  return result.compared && result.compared->status.ok() ? &*result.compared : nullptr;
}

void print_predictions(const ExcitationResult& result, double level, std::ostream& out) {
  const ComparedTrajectory* compared = judged(result);
  Table table;
  std::vector<std::string> head{"number", "nominal", readable(100.0 * level) + " % +-, plain"};
  if (compared) head.emplace_back("+-, compared");
  head.insert(head.end(), {"+-, found", "note"});
  table.add(head);
  for (std::size_t k = 0; k < result.numbers.size(); ++k) {
    const PredictedNumber& number = result.numbers[k];
    std::vector<std::string> line =
        prediction_line({number.name, readable(number.nominal)}, number.half_before, number.half,
                        compared, &ComparedTrajectory::halves, k);
    line.emplace_back(number.is_determined ? "" : "not identifiable");
    table.add(line);
  }
  table.print(out);
}

/// A trajectory that breaks limits may seem better than any that keeps them.
void print_compared_limits(const ComparedTrajectory& compared, std::ostream& out) {
  const KeptLimit* broken = compared.broken();
  if (!broken) {
    out << "the compared trajectory keeps all limits at its samples\n";
    return;
  }
  const LimitedSignal& limits = broken->limits;
  const ScannedSignal& reached = broken->reached;
  const bool is_above = limits.relative(reached.highest) > -limits.relative(reached.lowest);
  out << "the compared trajectory breaks limits, the worst: " << limits.name << " reaches "
      << readable(is_above ? reached.highest : reached.lowest) << ", the limit is "
      << readable(is_above ? limits.upper : limits.lower) << '\n';
}

/// Expressions that are longer than a line stand in the JSON.
void print_base(const ExcitationResult& result, std::ostream& out) {
  constexpr std::size_t kLongest = 80;
  if (result.base.empty()) return;
  const ComparedTrajectory* compared = judged(result);
  Table table;
  std::vector<std::string> head{"deviation, plain"};
  if (compared) head.emplace_back("compared");
  head.insert(head.end(), {"found", "base parameter"});
  table.add(head);
  for (std::size_t k = 0; k < result.base.size(); ++k) {
    const PredictedBase& base = result.base[k];
    std::vector<std::string> line = prediction_line({}, base.deviation_before, base.deviation,
                                                    compared, &ComparedTrajectory::base, k);
    line.push_back(base.expression.size() <= kLongest
                       ? base.expression
                       : base.expression.substr(0, kLongest - 4) + " ...");
    table.add(line);
  }
  table.print(out);
}

void print_condition(const ExcitationResult& result, std::ostream& out) {
  out << "condition number: plain " << readable(result.condition_before, kIntervalDigits);
  if (const ComparedTrajectory* compared = judged(result))
    out << ", compared " << readable(compared->condition, kIntervalDigits) << " ("
        << compared->samples << " samples at " << readable(compared->rate) << " Hz)";
  out << ", found " << readable(result.condition, kIntervalDigits) << '\n';
  if (result.compared && !result.compared->status.ok())
    out << "the compared trajectory cannot be followed: " << describe(result.compared->status)
        << '\n';
  if (const ComparedTrajectory* compared = judged(result)) print_compared_limits(*compared, out);
}

void print_limits(const ExcitationResult& result, std::ostream& out) {
  Table table;
  table.add({"limit", "lower", "lowest", "highest", "upper"});
  for (const KeptLimit& limit : result.limits)
    table.add({limit.limits.name, readable(limit.limits.lower), readable(limit.reached.lowest),
               readable(limit.reached.highest), readable(limit.limits.upper)});
  table.print(out);
}

void print_excitation(const Problem& problem, const ExcitationResult& result, std::ostream& out) {
  for (const std::string& sentence : excitation_sentences(result)) out << sentence << '\n';
  print_condition(result, out);
  print_predictions(result, study_of(problem).identification->intervals.level, out);
  print_base(result, out);
  print_limits(result, out);
  out << result.termination << " after " << result.starts.size() << " searches, "
      << result.evaluations << " evaluations, " << readable(result.cpu_seconds)
      << " s of processor time\n";
}

Problem load_excitable(const Arguments& arguments, const Console& console) {
  Problem problem = load(arguments, &console);
  if (!study_of(problem).excitation)
    throw InputError(
        {{arguments.study, 1}, "excite", "the study has no joints to move", "", "a block excite"});
  return problem;
}

/// The trajectory of --compare, looked at as recordings are. @throws InputError
std::optional<JointRecording> read_compared(const Arguments& arguments, const Problem& problem,
                                            Warnings* warnings) {
  if (arguments.compare.empty()) return std::nullopt;
  RecordingDescription description;
  description.file = arguments.compare;
  description.element = "--compare";
  description.where = {arguments.compare, 0};
  std::vector<std::string> joints;
  for (const JointDescription& joint : robot_of(problem).joints)
    if (joint.has_one_coordinate()) joints.push_back(joint.name);
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  JointRecording part =
      checked_part(read_table_recording(description, arguments.compare, joints, "--compare"),
                   -kInfinite, kInfinite);
  check_part(robot_of(problem), &part, warnings);
  return without_gaps(part, GapRule::kRefuse, warnings, false).front();
}

std::string trajectory_text(const TrajectoryPoints& points) {
  std::ostringstream text;
  CsvWriter csv(text, trajectory_columns(points), "trajectory.csv");
  for (const std::vector<std::string>& row : trajectory_rows(points)) csv.write(row);
  return text.str();
}

/// Runs an action; reports a failure, which does not affect other actions.
template <class Action>
void attempt(const Action& action, std::vector<Failure>* failures) {
  try {
    action();
  } catch (const std::exception& error) {
    failures->push_back({"output_failed", error.what()});
  }
}

std::vector<Failure> write_excitation(const std::string& folder, const ExcitationResult& result,
                                      const Json& object, const Console& console) {
  const auto in_folder = [&](const char* name) {
    return (std::filesystem::path(folder) / name).string();
  };
  std::vector<Failure> failures;
  attempt([&] { write_whole_file(in_folder(kResultFile), to_text(object)); }, &failures);
  attempt([&] { write_whole_file(in_folder(kTrajectoryFile), trajectory_text(result.points)); },
          &failures);
  attempt([&] { write_whole_file(in_folder(kPlainFile), trajectory_text(result.before)); },
          &failures);
  if (console.trajectories)
    attempt([&] { console.trajectories(in_folder(kBagFile), result.points); }, &failures);
  return failures;
}

}  // namespace

int excite(const Arguments& arguments, const Console& console) {
  const Problem problem = load_excitable(arguments, console);
  if (!arguments.output.empty()) {
    make_folder(arguments.output, "--output");
    require_other_files(arguments.output, {kResultFile, kTrajectoryFile, kPlainFile, kBagFile},
                        "--output", problem);
  }
  Warnings warnings;
  const std::optional<JointRecording> compared = read_compared(arguments, problem, &warnings);
  LinePace pace;
  const auto observer = [&](const ExcitationTrial& trial) {
    if (pace.admits_now()) print_excitation_trial(trial, progress_of(arguments, console));
    return !console.cancel;
  };
  const ExcitationResult result =
      codesign::excite(problem, observer, &console.cancel, compared ? &*compared : nullptr);
  const bool is_found = !result.points.joints.empty();
  if (!arguments.json && is_found) print_excitation(problem, result, console.out);
  Json object = excitation_json(problem, result);
  append(result.warnings, &warnings);
  add_warnings(arguments, problem, warnings, &object, console);
  if (!result.status.ok()) object["error"] = to_json(result.status);
  std::vector<Failure> failures;
  if (!arguments.output.empty() && is_found)
    failures = write_excitation(arguments.output, result, object, console);
  return finish(arguments, result.status, std::move(object), console, failures);
}

}  // namespace codesign::cli
