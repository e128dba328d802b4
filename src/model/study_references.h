// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MODEL_STUDY_REFERENCES_H_
#define MECHANISM_CODESIGN_MODEL_STUDY_REFERENCES_H_

#include <vector>

#include "mechanism_codesign/model/parameter.h"
#include "mechanism_codesign/model/reference.h"
#include "yaml_reader.h"

namespace codesign {

/// A quantity, or a map whose `type` is sine, waypoints or trajectory.
ReferenceDescription read_reference(const YamlValue& value, const std::vector<Parameter>& parameters, const TrajectoryLoader& loader);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MODEL_STUDY_REFERENCES_H_
