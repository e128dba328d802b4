// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_URDF_READER_H_
#define MECHANISM_CODESIGN_READING_URDF_URDF_READER_H_

#include <string>
#include <vector>

#include "description/robot.h"
#include "mechanism_codesign/source_text.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// Reads an annotated URDF strictly, merged with overlays by element name (doc/annotations.md).
/// @throws InputError naming file, line, element, value and allowed range.
RobotDescription read_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays = {});

/// The same URDF with every twinned attribute, parameter default and shape-derived inertial set to its value at `parameters`
/// (all named parameters; those beyond the model's are ignored). Reading it back gives the design at its new defaults.
std::string write_tuned_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays, const std::vector<double>& parameters);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_URDF_READER_H_
