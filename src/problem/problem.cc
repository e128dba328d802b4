// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/problem.h"

#include <algorithm>
#include <cmath>

#include "assembly/make_system.h"
#include "description/parameter_switches.h"
#include "description/study.h"
#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "linear/initial_gains.h"
#include "math/arrays.h"
#include "math/cpu_timer.h"
#include "mechanism/motor_sides.h"
#include "problem/load_problem.h"
#include "problem/margins.h"
#include "problem/problem_warnings.h"
#include "problem/variants.h"
#include "reading/study/study_reader.h"
#include "reading/study/study_values.h"
#include "reading/urdf/floating_base.h"
#include "reading/urdf/urdf_reader.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kSettings = "parameter settings";

/// The index of a parameter.
std::size_t find_parameter(const Study& study, const std::string& name) {
  const std::vector<Parameter>& parameters = study.parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    if (parameters[k].name == name) return k;
  throw unknown_name({kSettings, 0}, name, "parameter", name, names_of(parameters));
}

/// The index of a parameter that may have this value.
std::size_t find_settable(const Study& study, const std::string& name, double value) {
  const std::size_t index = find_parameter(study, name);
  require_within_bounds(value, study.parameters[index], {kSettings, 0}, name);
  return index;
}

void apply_settings(const ParameterSettings& settings, Study* study) {
  for (const auto& [name, value] : settings)
    study->parameters[find_settable(*study, name, value)].value = value;
}

/// Why the value of a saved design is not for this study; empty if it is. Sets the parameter in
/// this case.
std::string set_saved(const std::string& name, double value, Study* study) {
  const auto found = std::find_if(study->parameters.begin(), study->parameters.end(),
                                  [&](const Parameter& p) { return p.name == name; });
  if (found == study->parameters.end()) return name + " is no parameter here";
  if (!std::isfinite(value) || value < found->lower || value > found->upper)
    return name + " = " + to_decimal(value) + " is outside its bounds " + range_of(*found);
  found->value = value;
  return "";
}

/// Sets what fits of a saved design, and warns of all that does not.
void apply_design(const SavedDesign& design, Study* study, Warnings* warnings) {
  std::string misfits;
  const auto note = [&misfits](const std::string& misfit) {
    misfits += (misfits.empty() ? "" : "; ") + misfit;
  };
  std::size_t fitting = 0;
  for (const auto& [name, value] : design.values) {
    const std::string misfit = set_saved(name, value, study);
    misfit.empty() ? static_cast<void>(++fitting) : note(misfit);
  }
  if (fitting == 0 && !(design.values.empty() && study->tuned.empty()))
    throw InputError({{design.file, 1},
                      "result",
                      "no value of this result fits the model and the study: " +
                          (misfits.empty() ? "it has no values of parameters" : misfits),
                      "",
                      "the result of this study, or of one with some of its parameters"});
  for (const std::string& tuned : tuned_names(*study))
    if (std::none_of(design.values.begin(), design.values.end(),
                     [&](const auto& setting) { return setting.first == tuned; }))
      note(tuned +
           ", which is tuned here, keeps its start value, since the result does not have it");
  if (misfits.empty()) return;
  append({warn("result_of_another_study",
               {{design.file, 0},
                "result",
                "the result is of another model or study; " + std::to_string(fitting) + " of its " +
                    std::to_string(design.values.size()) + " values are used: " + misfits,
                "",
                "the result of this study"})},
         warnings);
}

/// `loader`, extended to keep all trajectories that it reads in `loaded`; an empty loader stays
/// empty.
TrajectoryLoader keeping(const TrajectoryLoader& loader, std::vector<LoadedTrajectory>* loaded) {
  if (!loader) return {};
  return [&loader, loaded](const TrajectoryAddress& address) {
    loaded->push_back({address.bag, address.topic, address.joint, loader(address)});
    return loaded->back().trajectory;
  };
}

/// The same for files.
FileLoader keeping(const FileLoader& files, std::vector<LoadedFile>* loaded) {
  return [&files, loaded](const FileAddress& address) {
    loaded->push_back({address.file, files(address)});
    return loaded->back().source;
  };
}

/// Begins gains by lqr and by poles where they are those of the present start, unless a saved
/// design or settings have given them.
void start_gains(const RobotDescription& robot, const SavedDesign& design,
                 const ParameterSettings& settings, Study* study) {
  const auto is_given = [&](const std::string& name) {
    const auto is_it = [&name](const auto& setting) { return setting.first == name; };
    return std::any_of(settings.begin(), settings.end(), is_it) ||
           std::any_of(design.values.begin(), design.values.end(), is_it);
  };
  for (const InitialGains& of : study->initial_gains) {
    if (std::all_of(of.parameters.begin(), of.parameters.end(), [&](int parameter) {
          return is_given(study->parameters[to_index(parameter)].name);
        }))
      continue;
    const std::vector<double> gains = find_initial_gains(robot, *study, of);
    for (std::size_t k = 0; k < gains.size(); ++k) {
      Parameter& parameter = study->parameters[to_index(of.parameters[k])];
      if (is_given(parameter.name)) continue;
      if (gains[k] < parameter.lower || gains[k] > parameter.upper)
        throw InputError({of.where,
                          "controllers." + study->controllers[of.controller].name + ".gains",
                          "the start of " + parameter.name + " lies outside its bounds",
                          to_decimal(gains[k]), range_of(parameter)});
      parameter.value = gains[k];
    }
  }
  study->initial_gains.clear();
}

/// Compiles the equations of motion of a model and a study with design and settings applied, and
/// completes `contents`: system, warnings, time.
Problem compile(const RobotDescription& robot, Study study, const SavedDesign& design,
                const ParameterSettings& settings, ProblemContents contents) {
  if (!design.file.empty()) apply_design(design, &study, &contents.warnings);
  apply_settings(settings, &study);
  const CpuTimer timer;
  start_gains(robot, design, settings, &study);
  require_numbers_at_start(study, start_parameters(study));
  require_ordered_bounds(study);
  for (const WatchedSignal& watched : study.watched)
    require_ordered_bounds(watched, start_parameters(study));
  require_compatible(study);
  append(unused_parameters(study), &contents.warnings);
  append(differing_nominals(study), &contents.warnings);
  if (!contents.study_text.text.empty()) append(fixed_base(robot, study), &contents.warnings);
  append(waypoint_overshoots(study), &contents.warnings);
  if (!study.tuned.empty()) append(unsatisfiable_constraints(study), &contents.warnings);
  for (RunDescription& run : study.ensemble.runs)
    if (run.study) {
      // Settings and requests change values and choice of the tuned parameters, for all runs alike.
      auto changed = std::make_shared<Study>(*run.study);
      changed->parameters = study.parameters;
      changed->tuned = study.tuned;
      run.study = std::move(changed);
    }
  contents.system = make_system(robot, study, &contents.warnings);
  if (contents.system->robot().joints.size() > 0 && contents.system->robot().joints.back().is_motor)
    contents.as_described =
        std::make_shared<const RobotDescription>(without_motor_sides(contents.system->robot()));
  contents.variants = make_variants(robot, study, contents.system, &contents.warnings);
  contents.setup_seconds += timer.seconds();
  return ProblemContents::make(std::move(contents));
}

}  // namespace

const SourceText& Problem::urdf() const { return contents_->urdf; }
const std::vector<SourceText>& Problem::overlays() const { return contents_->overlays; }
const SourceText& Problem::study_text() const { return contents_->study_text; }
const Warnings& Problem::warnings() const { return contents_->warnings; }
double Problem::setup_seconds() const { return contents_->setup_seconds; }
double Problem::duration() const { return study_of(*this).duration; }
const std::vector<Parameter>& Problem::all_parameters() const { return study_of(*this).parameters; }
std::vector<double> Problem::parameters() const { return start_parameters(study_of(*this)); }
std::vector<double> Problem::parameters(const Eigen::VectorXd& rho) const {
  return parameters_at(study_of(*this), rho);
}
std::vector<double> Problem::parameters(const ParameterSettings& settings) const {
  std::vector<double> values = parameters();
  for (const auto& [name, value] : settings)
    values[find_settable(study_of(*this), name, value)] = value;
  return values;
}
std::vector<std::string> Problem::tuned_names() const {
  return codesign::tuned_names(study_of(*this));
}
Eigen::VectorXd Problem::start() const { return start_of(study_of(*this)); }
const OptimizerOptions& Problem::optimizer_options() const { return study_of(*this).optimizer; }
const RobotDescription& robot_of(const Problem& problem) {
  const ProblemContents& contents = contents_of(problem);
  return contents.as_described ? *contents.as_described : contents.system->robot();
}
const Study& study_of(const Problem& problem) { return system_of(problem)->whole_study(); }

Problem load_problem(const SourceText& urdf, const std::vector<SourceText>& overlays,
                     const SourceText& study, const ParameterSettings& settings) {
  return load_problem(urdf, overlays, study, settings, TrajectoryLoader());
}

Problem load_problem(const SourceText& urdf, const std::vector<SourceText>& overlays,
                     const SourceText& study, const ParameterSettings& settings,
                     const TrajectoryLoader& loader, const FileLoader& files, const Laws& laws) {
  return load_problem_at(SavedDesign(), urdf, overlays, study, settings, loader, files, laws);
}

Problem load_problem_at(const SavedDesign& design, const SourceText& urdf,
                        const std::vector<SourceText>& overlays, const SourceText& study,
                        const ParameterSettings& settings, const TrajectoryLoader& loader,
                        const FileLoader& files, const Laws& laws) {
  const CpuTimer timer;
  RobotDescription robot = read_urdf(urdf, overlays, laws);
  std::vector<SourceText> merged = overlays;
  if (has_floating_base(study)) merged = with_floating_base(robot, std::move(merged));
  if (merged.size() > overlays.size()) robot = read_urdf(urdf, merged, laws);
  std::vector<LoadedTrajectory> loaded;
  std::vector<LoadedFile> loaded_files;
  const FileLoader read_file = files ? files : files_beside(study.name);
  Study read =
      read_study(study, robot, keeping(loader, &loaded), keeping(read_file, &loaded_files));
  return compile(robot, std::move(read), design, settings,
                 {urdf,
                  merged,
                  study,
                  nullptr,
                  {},
                  timer.seconds(),
                  robot.warnings,
                  std::move(loaded),
                  std::move(loaded_files)});
}

Problem load_mechanism(const SourceText& urdf, const std::vector<SourceText>& overlays,
                       const ParameterSettings& settings) {
  return load_mechanism_at(SavedDesign(), urdf, overlays, settings);
}

Problem load_mechanism_at(const SavedDesign& design, const SourceText& urdf,
                          const std::vector<SourceText>& overlays,
                          const ParameterSettings& settings) {
  const CpuTimer timer;
  const RobotDescription robot = read_urdf(urdf, overlays);
  Study study;
  study.parameters = robot.parameters;
  study.used_parameters = robot.used_parameters;
  study.switches = robot.switches;
  study.file = urdf.name;
  return compile(robot, std::move(study), design, settings,
                 {urdf, overlays, {}, nullptr, {}, timer.seconds(), robot.warnings, {}, {}});
}

Problem with_settings(const Problem& problem, const ParameterSettings& settings) {
  return with_study(problem, study_of(problem), settings);
}

Problem with_study(const Problem& problem, Study study, const ParameterSettings& settings) {
  return compile(robot_of(problem), std::move(study), {}, settings,
                 {problem.urdf(),
                  problem.overlays(),
                  problem.study_text(),
                  nullptr,
                  {},
                  problem.setup_seconds(),
                  problem.warnings(),
                  contents_of(problem).trajectories,
                  contents_of(problem).files});
}

Problem run_of(const Problem& problem, const std::string& name) {
  const Study& whole = study_of(problem);
  std::vector<std::string> names;
  for (const RunDescription& run : whole.ensemble.runs) {
    names.push_back(run.name);
    if (run.name != name) continue;
    Study study = run.study ? *run.study : whole;
    // A parameter of the study itself or of another run is no mistake in this one.
    study.used_parameters.insert(whole.used_parameters.begin(), whole.used_parameters.end());
    for (const RunDescription& other : whole.ensemble.runs)
      if (other.study)
        study.used_parameters.insert(other.study->used_parameters.begin(),
                                     other.study->used_parameters.end());
    study.ensemble = {};
    study.grid = whole.grid;
    return with_study(problem, std::move(study), run.set);
  }
  throw unknown_name({whole.file, 0}, "runs", "run", name, names);
}

PortableProblem make_portable(const Problem& problem) {
  const ProblemContents& contents = contents_of(problem);
  return {contents.urdf,  contents.overlays,    contents.study_text,  contents.trajectories,
          contents.files, problem.parameters(), problem.tuned_names()};
}

Problem load_portable(const PortableProblem& portable) {
  const CpuTimer timer;
  const RobotDescription robot = read_urdf(portable.urdf, portable.overlays);
  const auto loader = [&portable](const TrajectoryAddress& address) {
    for (const LoadedTrajectory& one : portable.trajectories)
      if (one.bag == address.bag && one.topic == address.topic && one.joint == address.joint)
        return one.trajectory;
    throw InputError({address.where, address.element,
                      "the trajectory was not sent with the problem", address.bag, ""});
  };
  const auto files = [&portable](const FileAddress& address) {
    for (const LoadedFile& one : portable.files)
      if (one.file == address.file) return one.source;
    throw InputError({address.where, address.element, "the file was not sent with the problem",
                      address.file, ""});
  };
  Study study = read_study(portable.study, robot, loader, files);
  if (study.parameters.size() != portable.values.size())
    throw InputError({{portable.study.name, 0},
                      "parameters",
                      "the problem was sent with other parameters",
                      "",
                      ""});
  // Not by settings, which check bounds: these values have passed that check already.
  for (std::size_t k = 0; k < portable.values.size(); ++k)
    study.parameters[k].value = portable.values[k];
  study.tuned.clear();
  for (const std::string& name : portable.tuned)
    study.tuned.push_back(static_cast<int>(find_parameter(study, name)));
  return compile(robot, std::move(study), {}, {},
                 {portable.urdf,
                  portable.overlays,
                  portable.study,
                  nullptr,
                  {},
                  timer.seconds(),
                  robot.warnings,
                  portable.trajectories,
                  portable.files});
}

void require_objective(const Problem& problem) {
  const Study& study = study_of(problem);
  if (!study.tradeoff.empty())
    throw InputError({study.tradeoff.front().where, "tradeoff",
                      "the study has several objectives, and this needs one: `codesign tradeoff` "
                      "computes the curve between them",
                      std::to_string(study.tradeoff.size()) + " objectives", "objective"});
  if (!has_objective(study))
    throw InputError(
        {{study.file, 1},
         "objective",
         "the study has no objective: it can be simulated and checked, but there is nothing to "
         "optimize",
         "",
         "at least one term under objective.integral, objective.terminal or objective.peak"});
}

}  // namespace codesign
