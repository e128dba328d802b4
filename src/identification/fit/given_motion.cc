// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/given_motion.h"

#include <algorithm>

#include "control/reference.h"
#include "identification/fit/fit_variables.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

bool is_of_tree(const RobotDescription& robot, const std::string& name) {
  return std::any_of(robot.joints.begin(), robot.joints.end(), [&](const JointDescription& joint) {
    return joint.name == name && !joint.is_loop;
  });
}

void refuse_tuned(const Study& study, const GivenMotion& motion, const JointRecording& recording) {
  for (const int used : dependencies(motion.position))
    if (std::count(study.tuned.begin(), study.tuned.end(), used) > 0)
      throw InputError(
          {motion.where, "motion." + motion.joint,
           "the study tunes a number of a motion that " + recording.element + " does not have",
           study.parameters[to_index(used)].name,
           "a motion without tuned parameters, or recordings with this joint"});
}

JointSamples samples_of(const GivenMotion& motion, const std::vector<double>& times,
                        const std::vector<double>& parameters) {
  const Reference<double> function(motion.position, parameters);
  JointSamples samples;
  samples.joint = motion.joint;
  samples.is_prescribed = true;
  for (const double time : times) {
    const ReferenceMotion<double> at = function.at(time);
    samples.position.push_back(at.value);
    samples.velocity.push_back(at.rate);
  }
  return samples;
}

}  // namespace

std::optional<StudyRecordings> with_given_motions(const Problem& problem,
                                                  const StudyRecordings& recordings) {
  const Study& study = study_of(problem);
  std::optional<StudyRecordings> completed;
  for (const auto list : {&StudyRecordings::data, &StudyRecordings::holdout})
    for (std::size_t r = 0; r < (recordings.*list).size(); ++r)
      for (const GivenMotion& motion : study.motion) {
        const JointRecording& recording = (recordings.*list)[r];
        if (recording.find(motion.joint) || !is_of_tree(robot_of(problem), motion.joint)) continue;
        refuse_tuned(study, motion, recording);
        if (!completed) completed = recordings;
        const FitVariables variables(study, nullptr, recording.settings);
        (completed.value().*list)[r].joints.push_back(
            samples_of(motion, recording.times, variables.parameters(variables.start())));
      }
  return completed;
}

}  // namespace codesign
