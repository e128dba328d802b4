// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/inputs.h"

#include <filesystem>
#include <system_error>

#include "description/named_file.h"
#include "description/tuned_parameters.h"
#include "jobs/job_files.h"
#include "jobs/saved_result.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/error.h"
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

void require_no_input(const std::string& path, const std::string& option, const std::string& what,
                      const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code error;
    if (std::filesystem::is_regular_file(input, error) &&
        std::filesystem::equivalent(path, input, error))
      throw InputError({{input, 0},
                        option,
                        what + " would replace this file, which is read",
                        path,
                        "the path of another file"});
  }
}

void make_folder(const std::string& path, const std::string& option) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path))
    throw InputError({{path, 0},
                      option,
                      "the folder cannot be created",
                      path,
                      "a folder that exists or can be created"});
}

Problem load(const Arguments& arguments, const Console* console) {
  Inputs inputs;
  inputs.urdf = read_source(arguments.model);
  for (const std::string& path : arguments.overlays) inputs.overlays.push_back(read_source(path));
  if (!arguments.study.empty()) inputs.study = read_source(arguments.study);
  if (!arguments.result.empty()) inputs.design = read_design(read_source(arguments.result));
  inputs.settings = arguments.settings;
  if (arguments.fill) {
    inputs.urdf.text = write_filled_urdf(inputs.urdf, inputs.overlays);
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
  require_tuned(problem.study());
  return problem;
}

std::vector<std::string> input_files(const Problem& problem) {
  std::vector<std::string> paths = {problem.urdf().name, problem.study_text().name};
  for (const SourceText& overlay : problem.overlays()) paths.push_back(overlay.name);
  for (const LoadedFile& file : problem.contents().files) paths.push_back(file.source.name);
  const std::filesystem::path folder =
      std::filesystem::absolute(problem.study_text().name).parent_path();
  for (const LoadedTrajectory& trajectory : problem.contents().trajectories)
    paths.push_back(folder / trajectory.bag);
  if (const auto& identification = problem.study().identification)
    for (const auto* recordings : {&identification->data, &identification->holdout})
      for (const RecordingDescription& recording : *recordings)
        paths.push_back(folder / recording.file);
  return paths;
}

std::vector<SignalDescription> select_signals(const Arguments& arguments, const Problem& problem) {
  const std::vector<ControllerDescription>& controllers = problem.study().controllers;
  return select_signals(arguments, problem, controllers,
                        default_signals(problem.robot(), controllers));
}

std::vector<SignalDescription> select_signals(const Arguments& arguments, const Problem& problem,
                                              const std::vector<ControllerDescription>& controllers,
                                              const std::vector<std::string>& standard) {
  std::vector<SignalDescription> signals;
  for (const std::string& text : arguments.signals.empty() ? standard : arguments.signals) {
    signals.push_back(parse_signal(text, {"command line", 0}, "--signals"));
    check_signal(signals.back(), problem.robot(), controllers, "--signals");
  }
  return signals;
}

}  // namespace codesign::cli
