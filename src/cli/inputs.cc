// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/inputs.h"

#include <utility>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "jobs/job_files.h"
#include "jobs/saved_result.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"
#include "reading/urdf/floating_base.h"
#include "reading/urdf/urdf_reader.h"

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

Problem load(const Arguments& arguments, const Console* console) {
  Inputs inputs;
  inputs.urdf = read_source(arguments.model);
  for (const std::string& path : arguments.overlays) inputs.overlays.push_back(read_source(path));
  if (arguments.floating_base) {
    const RobotDescription robot = read_urdf(inputs.urdf, inputs.overlays);
    inputs.overlays = with_floating_base(robot, std::move(inputs.overlays));
  }
  if (!arguments.study.empty()) inputs.study = read_source(arguments.study);
  if (!arguments.result.empty()) inputs.design = read_design(read_source(arguments.result));
  inputs.settings = arguments.settings;
  if (arguments.fill) {
    inputs.urdf = write_filled_urdf(inputs.urdf, inputs.overlays);
    inputs.overlays.clear();
  }
  Problem problem = codesign::load(inputs);
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
