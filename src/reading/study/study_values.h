// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_STUDY_STUDY_VALUES_H_
#define MECHANISM_CODESIGN_READING_STUDY_STUDY_VALUES_H_

#include <string>
#include <vector>

#include "description/robot.h"
#include "description/study.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

std::vector<std::string> names_of(const std::vector<Parameter>& parameters);

/// For expressions; it must not outlive `parameters`.
ExpressionScope scope_of(const std::vector<Parameter>& parameters);

/// A number, or `${expression}` of all named parameters, finite at their start.
Quantity read_quantity(const YamlValue& value, const std::vector<Parameter>& parameters);

/// Three of them.
QuantityVector read_vector(const YamlValue& value, const std::vector<Parameter>& parameters);

/// The joint or loop called `name`, which must have one coordinate.
/// @param at the place to report.
const JointDescription& scalar_joint(const std::string& name, const RobotDescription& robot, const YamlValue& at);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_STUDY_STUDY_VALUES_H_
