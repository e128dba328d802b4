// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOBS_IDENTIFICATION_FILES_H_
#define MECHANISM_CODESIGN_JOBS_IDENTIFICATION_FILES_H_

#include <functional>
#include <string>
#include <vector>

#include "identification/compared_motion.h"
#include "jobs/json.h"

namespace codesign {

/// A file of an identification, and what makes its text.
struct IdentificationFile {
  std::string name;  ///< `identification.json`
  std::function<std::string()> text;
};

/// The text files of an identification that has numbers: identification.json, identified_overlay.urdf,
/// identified.urdf, residuals.csv, and the study as job_study.yaml; doc/study.md. The texts may throw. @param json identification_json()
/// with all that the front end adds to it. All three must outlive the texts.
std::vector<IdentificationFile> identification_files(const Problem& problem, const IdentificationResult& result, const Json& json);

/// The contents of the bag of an identification; doc/ros_api.md.
struct IdentificationShow {
  std::string study, json, urdf;  ///< texts: the study, identification.json, the identified model
  ComparedMotion motion;
  FittedSeries data, holdout;
  std::vector<std::string> joints;  ///< columns of both series
};

/// @param json as above. @param motion compare_motion()
IdentificationShow identification_show(const Problem& problem, const IdentificationResult& result, const Json& json, ComparedMotion motion);

/// Callback that writes an identification into a bag, for replay in rviz. The caller provides it, since this library does not depend on
/// ROS.
/// @param path must not exist. @throws OutputError
using IdentificationBagWriter = std::function<void(const std::string& path, const IdentificationShow& show)>;

/// The writer that a program is linked with, like linked_bag_reader(); empty without ROS. Not in this library.
IdentificationBagWriter linked_identification_bag();

/// Instants per second in a bag where nobody asks for another rate [Hz].
constexpr double kShownRate = 50.0;

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOBS_IDENTIFICATION_FILES_H_
