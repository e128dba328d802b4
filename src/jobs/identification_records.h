// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "identification/comparison/compared_motion.h"
#include "identification/fit/identification_result.h"
#include "jobs/json.h"
#include "mechanism_codesign/problem.h"
#include "mechanism_codesign/warning.h"
#include "problem/load_problem.h"

namespace codesign {

/// identification.json, doc/study.md: `identified` (by name: value, start, deviation, interval,
/// ...), `undetermined`, `covariance`, `correlation`, `data` and `holdout` (residuals by joint),
/// `parameters`, `termination` and counts. Infinite and unknown numbers are null.
Json identification_json(const Problem& problem, const IdentificationResult& result);

/// The same as text, with the outcome that add_outcome() adds.
std::string identification_report(const Problem& problem, const IdentificationResult& result,
                                  const Warnings& of_run);

/// A summary for people, one sentence per line: whether the holdout is explained, which numbers the
/// data do not determine, residuals by joint.
std::vector<std::string> identification_sentences(const IdentificationResult& result);

/// Appends the first few of sentences that the JSON has whole, each shortened, with `what` before
/// it and a line that counts the others. @param rest where they stand
void append_first(const std::string& what, const std::vector<std::string>& whole,
                  const std::string& rest, std::vector<std::string>* sentences);

/// Columns and rows of residuals.csv: set (data or holdout), recording (from 1), time [s], then per
/// joint JOINT/recorded and JOINT/computed.
std::vector<std::string> residual_columns(const IdentificationResult& result);
std::vector<std::vector<std::string>> residual_rows(const IdentificationResult& result);

/// A file of an identification, with the function that makes its text.
struct IdentificationFile {
  std::string name;  ///< `identification.json`
  std::function<std::string()> text;
};

/// The text files of an identification with numbers: identification.json, identified_overlay.urdf,
/// identified.urdf (both only of a fit), residuals.csv, and the study as job_study.yaml;
/// doc/study.md. The texts may
/// throw. @param json the text of identification_json() with all additions of the front end. All
/// three arguments must outlive the texts.
std::vector<IdentificationFile> identification_files(const Problem& problem,
                                                     const IdentificationResult& result,
                                                     const std::string& json);

/// The contents of the bag of an identification; doc/ros_api.md.
struct IdentificationShow {
  std::string study, json, urdf;  ///< texts: the study, identification.json, the identified model
  ComparedMotion motion;
  FittedSeries data, holdout;
  std::vector<std::string> joints;  ///< names of the columns of both series
};

/// @param json as above. @param motion compare_motion()
IdentificationShow identification_show(const Problem& problem, const IdentificationResult& result,
                                       const std::string& json, ComparedMotion motion);

/// Callback that writes an identification into a bag, for replay in rviz. The caller provides it,
/// since this library does not depend on ROS.
/// @param path must not exist. @throws OutputError
using IdentificationBagWriter =
    std::function<void(const std::string& path, const IdentificationShow& show)>;

/// Default rate of the instants in a bag [Hz].
constexpr double kShownRate = 50.0;

/// identified_overlay.urdf, doc/study.md: sets every parameter of the model to the value of the
/// fit, with intervals as comments. Merged after the problem's own overlays, it turns the model
/// into identified.urdf. Numbers that do not belong to the model are in a comment at the end, in
/// the form in which a study takes them.
/// @param result of a fit with a best point
std::string identified_overlay(const Problem& problem, const IdentificationResult& result);

}  // namespace codesign
