// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "description/robot.h"
#include "reading/urdf/twin.h"

namespace codesign {

/// Checks that the written values agree with the values of the shapes to 1e-6 (relative). @throws InputError
void check_agreement(const XmlElement& element, const InertialDescription& written, const InertialDescription& from_shapes,
                     const ParameterTable& table);

/// Throws InputError; its allowed value is the computed inertial as XML, ready to be pasted.
[[noreturn]] void fail_with_computed(const XmlElement& element, const InertialDescription& from_shapes, const ParameterTable& table,
                                     const std::string& message);

}  // namespace codesign
