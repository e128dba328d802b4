// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "reading/urdf/read_context.h"

namespace codesign {

/// Reads one `<codesign:friction>`. @param axis of the joint; the transverse axis must not be parallel to it. @throws InputError
FrictionDescription read_friction(const XmlElement& element, const QuantityVector& axis, const ReadContext& context);

}  // namespace codesign
