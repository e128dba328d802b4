// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/study.h"

#include <algorithm>

#include "description/parameter_switches.h"

namespace codesign {

MotionStudy::MotionStudy() = default;
MotionStudy::MotionStudy(const MotionStudy&) = default;
MotionStudy::MotionStudy(MotionStudy&&) noexcept = default;
MotionStudy& MotionStudy::operator=(const MotionStudy&) = default;
MotionStudy& MotionStudy::operator=(MotionStudy&&) noexcept = default;
MotionStudy::~MotionStudy() = default;
Study::Study() = default;
Study::Study(const Study&) = default;
Study::Study(Study&&) noexcept = default;
Study& Study::operator=(const Study&) = default;
Study& Study::operator=(Study&&) noexcept = default;
Study::~Study() = default;

bool has_moving_end(const MotionStudy& study) { return study.duration_of_design || study.until; }

double duration_at(const MotionStudy& study, const std::vector<double>& parameters) {
  return study.duration_of_design ? study.duration_of_design->value(parameters) : study.duration;
}

bool has_given_motion(const MotionStudy& study, const std::string& joint) {
  return std::any_of(study.motion.begin(), study.motion.end(),
                     [&](const GivenMotion& motion) { return motion.joint == joint; });
}

}  // namespace codesign
