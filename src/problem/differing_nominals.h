// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/study.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// A warning `nominal_differs` if parameters whose distribution an identification has found have other values in the model: samples lie
/// around the identified values, but nominal runs do not.
Warnings differing_nominals(const Study& study);

}  // namespace codesign
