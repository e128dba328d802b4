// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "description/named_file.h"
#include "description/reference.h"
#include "description/robot.h"
#include "mechanism_codesign/problem.h"

namespace codesign {

class CompiledSystem;
struct Study;

/// A trajectory that a study names, as its loader has read it.
struct LoadedTrajectory {
  std::string bag, topic, joint;
  RecordedTrajectory trajectory;
};

/// A text that a study names, as its loader has read it.
struct LoadedFile {
  std::string file;  ///< the name in the study
  SourceText source;
};

/// The members of a Problem. Its model and study are in `system`, the model without the joints of
/// with_motor_sides() in `as_described` if there are any.
struct ProblemContents {
  SourceText urdf;
  std::vector<SourceText> overlays;
  SourceText study_text;
  std::shared_ptr<const CompiledSystem> system;
  /// the systems of variant_of(); empty if there is only the study's own
  std::vector<std::shared_ptr<const CompiledSystem>> variants;
  double setup_seconds = 0.0;  ///< processor time of reading and compiling [s]
  Warnings warnings;
  std::vector<LoadedTrajectory> trajectories;  ///< in the order in which the study names them
  std::vector<LoadedFile> files;               ///< likewise
  std::shared_ptr<const RobotDescription> as_described{};

  static Problem make(ProblemContents contents) {
    return Problem(std::make_shared<const ProblemContents>(std::move(contents)));
  }
  static const ProblemContents& of(const Problem& problem) { return *problem.contents_; }
};

inline const ProblemContents& contents_of(const Problem& problem) {
  return ProblemContents::of(problem);
}
/// The compiled equations of the study's own runs.
inline const std::shared_ptr<const CompiledSystem>& system_of(const Problem& problem) {
  return contents_of(problem).system;
}
/// The model as it is described, without the motors' sides of elastic gears.
const RobotDescription& robot_of(const Problem& problem);
const Study& study_of(const Problem& problem);

/// The design of a saved result, which may be of another study.
struct SavedDesign {
  std::string file;  ///< for messages; empty: there is no such design
  ParameterSettings values;
};

/// load_problem() from a saved design: the parameters that the model or the study has, within their
/// bounds, begin with its values, before `settings` apply. What does not fit is named in the
/// warning `result_of_another_study`. @throws InputError also if nothing fits.
Problem load_problem_at(const SavedDesign& design, const SourceText& urdf,
                        const std::vector<SourceText>& overlays, const SourceText& study,
                        const ParameterSettings& settings, const TrajectoryLoader& loader = {},
                        const FileLoader& files = {}, const Laws& laws = standard_laws());
/// The same without a study.
Problem load_mechanism_at(const SavedDesign& design, const SourceText& urdf,
                          const std::vector<SourceText>& overlays,
                          const ParameterSettings& settings);

/// load_problem() for studies that may read trajectories from bags. @param loader reads such a
/// trajectory; if it is empty, a study that names a bag is refused. @param files reads other files
/// that the study names; if it is empty, they are looked for in the study's folder.
/// @param laws that model and study may name. Other processes know standard_laws() only.
Problem load_problem(const SourceText& urdf, const std::vector<SourceText>& overlays,
                     const SourceText& study, const ParameterSettings& settings,
                     const TrajectoryLoader& loader, const FileLoader& files = {},
                     const Laws& laws = standard_laws());

/// The system compiled for one run of `Study::ensemble.runs` with one friction law for all joints.
/// @param run index of the run; 0 if the study has no runs. @param law index in `laws` of the
/// uncertain friction law; -1: the model's own.
std::shared_ptr<const CompiledSystem> variant_of(const Problem& problem, int run, int law);

/// Every system of the problem once: the study's own system first, then the systems of
/// variant_of(). The texts alone determine the order.
std::vector<std::shared_ptr<const CompiledSystem>> distinct_systems(const Problem& problem);

/// The problem compiled again with another study of the same model; the texts of `problem` stay.
/// @throws InputError as load_problem().
Problem with_study(const Problem& problem, Study study, const ParameterSettings& settings = {});

/// The problem of one of the study's runs: its study with the changes of the run, alone.
/// @throws InputError for an unknown name
Problem run_of(const Problem& problem, const std::string& name);

/// All data that another process needs to compile the same problem on a machine without its files.
struct PortableProblem {
  SourceText urdf;
  std::vector<SourceText> overlays;
  SourceText study;
  std::vector<LoadedTrajectory> trajectories;
  std::vector<LoadedFile> files;
  std::vector<double> values;      ///< start values of all named parameters
  std::vector<std::string> tuned;  ///< names of the tuned parameters
};

/// @param problem as loaded, or with other tuned parameters or start values; other changes of its
/// study are not included.
PortableProblem make_portable(const Problem& problem);

/// The same problem, with the same order of its systems. @throws InputError as load_problem().
Problem load_portable(const PortableProblem& portable);

}  // namespace codesign
