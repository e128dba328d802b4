// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/identification.h"

namespace codesign {

/// A simulation passes through rest, whatever is compared there.
/// @throws InputError for a mask if motions are compared
void refuse_masks_in_motion(const RecordingDescription& recording, ResidualKind residual);

}  // namespace codesign
