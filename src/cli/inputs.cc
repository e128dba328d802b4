// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/inputs.h"

#include <map>
#include <utility>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "jobs/job_files.h"
#include "jobs/saved_result.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"
#include "reading/urdf/filled_urdf.h"

namespace codesign::cli {

void open_output(const std::string& path, const std::string& option, std::ofstream* file) {
  file->open(path, std::ios::binary);
  if (!*file)
    throw InputError({{path, 0},
                      option,
                      "the file cannot be written",
                      path,
                      "a path in a folder that exists and may be written to"});
}

namespace {

/// The places of elements in the files, by their lines in the filled text.
struct FilledPlaces {
  std::string file;
  std::map<int, SourceLocation> of_lines;

  const SourceLocation* find(const SourceLocation& where) const {
    const auto found = where.file == file ? of_lines.find(where.line) : of_lines.end();
    return found == of_lines.end() ? nullptr : &found->second;
  }
};

std::string text_of(const SourceLocation& where) {
  return where.file + ":" + std::to_string(where.line) + ": ";
}

/// Loads a text that the user does not see; messages have the lines of the files.
Problem load_filled(Inputs inputs) {
  FilledPlaces places{inputs.urdf.name, {}};
  inputs.urdf.text = write_filled_urdf(inputs.urdf, inputs.overlays, &places.of_lines);
  inputs.overlays.clear();
  try {
    ProblemContents contents = contents_of(codesign::load(inputs));
    for (Warning& warning : contents.warnings)
      if (const SourceLocation* place = places.find(warning.where);
          place != nullptr && warning.message.rfind(text_of(warning.where), 0) == 0) {
        warning.message.replace(0, text_of(warning.where).size(), text_of(*place));
        warning.where = *place;
      }
    return ProblemContents::make(std::move(contents));
  } catch (const InputError& error) {
    InputFault fault = error.fault();
    if (const SourceLocation* place = places.find(fault.where)) fault.where = *place;
    throw InputError(fault);
  }
}

}  // namespace

Problem load(const Arguments& arguments, const Console* console) {
  Inputs inputs;
  inputs.urdf = read_source(arguments.model);
  for (const std::string& path : arguments.overlays) inputs.overlays.push_back(read_source(path));
  if (!arguments.study.empty()) inputs.study = read_source(arguments.study);
  if (!arguments.result.empty()) inputs.design = read_design(read_source(arguments.result));
  inputs.settings = arguments.settings;
  Problem problem = arguments.fill ? load_filled(std::move(inputs)) : codesign::load(inputs);
  if (!arguments.run.empty()) problem = run_of(problem, arguments.run);
  if (console != nullptr && console->loaded != nullptr) console->loaded();
  return problem;
}

Problem load_tunable(const Arguments& arguments, const Console* console) {
  Problem problem = load(arguments, console);
  require_objective(problem);
  require_tuned(study_of(problem));
  return problem;
}

std::vector<SignalDescription> select_signals(const Arguments& arguments, const Problem& problem) {
  const std::vector<ControllerDescription>& controllers = study_of(problem).controllers;
  return select_signals(arguments, problem, controllers,
                        default_signals(robot_of(problem), controllers));
}

std::vector<SignalDescription> select_signals(const Arguments& arguments, const Problem& problem,
                                              const std::vector<ControllerDescription>& controllers,
                                              const std::vector<std::string>& standard) {
  std::vector<SignalDescription> signals;
  for (const std::string& text : arguments.signals.empty() ? standard : arguments.signals) {
    signals.push_back(parse_signal(text, {"command line", 0}, "--signals"));
    check_signal(signals.back(), robot_of(problem), controllers, "--signals");
  }
  return signals;
}

}  // namespace codesign::cli
